// Preloaded into a program: from main on its allocations are counted, and the k-th fails, or all from the k-th on.
//   FAIL_ALLOCATION=k or k+    which; 0: none
//   COUNT_ALLOCATIONS=file     gets how many there were, if main returns
// Needs glibc, whose own functions stand behind these.
#include <errno.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

extern void* __libc_malloc(size_t size);
extern void* __libc_calloc(size_t count, size_t size);
extern void* __libc_realloc(void* old, size_t size);
extern void* __libc_memalign(size_t alignment, size_t size);

static atomic_long count;
static atomic_int counts;
static long first = 0;
static int goes_on = 0;

static int fails(void) {
  if (!atomic_load(&counts)) return 0;
  const long number = atomic_fetch_add(&count, 1) + 1;
  if (first == 0 || number < first || (number > first && !goes_on)) return 0;
  errno = ENOMEM;
  return 1;
}

void* malloc(size_t size) { return fails() ? NULL : __libc_malloc(size); }
void* calloc(size_t number, size_t size) { return fails() ? NULL : __libc_calloc(number, size); }
void* realloc(void* old, size_t size) { return fails() ? NULL : __libc_realloc(old, size); }
void* memalign(size_t alignment, size_t size) { return fails() ? NULL : __libc_memalign(alignment, size); }
void* aligned_alloc(size_t alignment, size_t size) { return memalign(alignment, size); }
int posix_memalign(void** result, size_t alignment, size_t size) {
  if (fails()) return ENOMEM;
  *result = __libc_memalign(alignment, size);
  return *result == NULL ? ENOMEM : 0;
}

typedef int (*Main)(int, char**, char**);
static Main real_main;

static int counted_main(int argc, char** argv, char** variables) {
  const char* which = getenv("FAIL_ALLOCATION");
  if (which != NULL) {
    char* end = NULL;
    first = strtol(which, &end, 10);
    goes_on = *end == '+';
  }
  atomic_store(&counts, 1);
  const int code = real_main(argc, argv, variables);
  atomic_store(&counts, 0);
  const char* name = getenv("COUNT_ALLOCATIONS");
  FILE* file = name == NULL ? NULL : fopen(name, "w");
  if (file != NULL) {
    fprintf(file, "%ld\n", atomic_load(&count));
    fclose(file);
  }
  return code;
}

int __libc_start_main(Main program, int argc, char** argv, void (*init)(void), void (*fini)(void),
                      void (*loader_fini)(void), void* stack_end) {
  extern void* dlsym(void* handle, const char* name);
  void* const next = (void*)-1L;  // RTLD_NEXT
  int (*start)(Main, int, char**, void (*)(void), void (*)(void), void (*)(void), void*) =
      (int (*)(Main, int, char**, void (*)(void), void (*)(void), void (*)(void), void*))dlsym(next, "__libc_start_main");
  real_main = program;
  return start(counted_main, argc, argv, init, fini, loader_fini, stack_end);
}
