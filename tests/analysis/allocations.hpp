// Counts the allocations of this test program, where that is possible.
#pragma once

#include <cstdlib>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
#define SPRINGFOLD_COUNTS_ALLOCATIONS
extern long allocations;
#endif
