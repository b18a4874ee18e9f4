// Ending cleanly when the user or the system asks for it.
#pragma once

#include <csignal>

namespace springfold::cli {

/// While it lives, SIGINT and SIGTERM are noted instead of ending the program (a second one of the
/// same kind ends it at once), and writing to a closed pipe or past a file size limit is an error of
/// that write. One at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  ~InterruptGuard();

  /// The signal that came, 0 if none did.
  static int signal();

 private:
  struct sigaction old_int_ {};
  struct sigaction old_term_ {};
  struct sigaction old_pipe_ {};
  struct sigaction old_size_ {};
};

}  // namespace springfold::cli
