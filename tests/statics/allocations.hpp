// Counts the allocations of this test program, where that is possible: sanitizers need malloc for themselves.
#pragma once

#include <cstdlib>

#if defined(__GLIBC__) && !defined(SPRINGFOLD_SANITIZED)
#define SPRINGFOLD_COUNTS_ALLOCATIONS
extern long allocations;
#endif
