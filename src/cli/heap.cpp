#include "heap.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>  // of glibc: says so

#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace springfold::cli {

#ifdef __GLIBC__
namespace {

constexpr int megabyte = 1 << 20;

}  // namespace

void fill_first_pages() {
#ifdef MADV_POPULATE_WRITE
  constexpr std::size_t wanted = 3 * megabyte / 2;
  void* const part = std::malloc(wanted);
  if (part == nullptr) return;
  const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
  const auto begin = (reinterpret_cast<std::uintptr_t>(part) + page - 1) / page * page;
  const auto end = (reinterpret_cast<std::uintptr_t>(part) + wanted) / page * page;
  // Where the system knows nothing of it, pages come one by one.
  ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_POPULATE_WRITE);
  std::free(part);  // to the top of the heap
#endif
}

void take_memory_in_large_parts(int threads) {
  // A choice of the first ends glibc's own adjustment of the others: these are where that ends with large matrices.
  mallopt(M_TOP_PAD, 2 * megabyte);
  mallopt(M_MMAP_THRESHOLD, 32 * megabyte);
  mallopt(M_TRIM_THRESHOLD, 64 * megabyte);
  if (threads == 1) mallopt(M_ARENA_MAX, 1);
}
#else
void fill_first_pages() {}
void take_memory_in_large_parts(int) {}
#endif

}  // namespace springfold::cli
