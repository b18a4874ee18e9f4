// Exit codes of the program: docs/results.md.
#pragma once

namespace springfold::cli {

enum ExitCode : int {
  all_done = 0,
  wrong_usage = 2,
  wrong_case_file = 3,
  no_start_point = 4,  ///< no trustworthy start point in at least one run
  partial = 5,         ///< stopped early, unresolved, or a compared value does not hold
  input_output = 6,
  out_of_memory = 7,  ///< what was finished before is written
  internal_error = 70,
};

/// The shell's convention for a program that a signal ended: 130 for SIGINT, 143 for SIGTERM.
constexpr int interrupted_by(int signal) { return 128 + signal; }

}  // namespace springfold::cli
