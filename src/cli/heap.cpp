#include "heap.hpp"

#include <cstdlib>  // of glibc: says so

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace springfold::cli {

#ifdef __GLIBC__
void take_memory_in_large_parts(int threads) {
  constexpr int megabyte = 1 << 20;
  // A choice of the first ends glibc's own adjustment of the others: these are where that ends with large matrices.
  mallopt(M_TOP_PAD, 2 * megabyte);
  mallopt(M_MMAP_THRESHOLD, 32 * megabyte);
  mallopt(M_TRIM_THRESHOLD, 64 * megabyte);
  if (threads == 1) mallopt(M_ARENA_MAX, 1);
}
#else
void take_memory_in_large_parts(int) {}
#endif

}  // namespace springfold::cli
