// Processor time of the calling thread. Private to analysis.
#pragma once

#include <ctime>

namespace springfold::analysis {

/// [s]; other threads of the program, which may be at other runs, do not count.
inline double thread_seconds() {
  timespec time{};
  if (::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time) != 0) return 0;
  constexpr double nano = 1e-9;
  return static_cast<double>(time.tv_sec) + nano * static_cast<double>(time.tv_nsec);
}

}  // namespace springfold::analysis
