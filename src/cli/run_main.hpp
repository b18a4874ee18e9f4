// The whole program but for the standard streams.
#pragma once

#include <ostream>

namespace springfold::cli {

/// Runs the program and returns its exit code. Throws nothing.
/// @param shows_progress  `err` is a terminal
int run_main(int argc, const char* const* argv, std::ostream& out, std::ostream& err,
             bool shows_progress = false) noexcept;

}  // namespace springfold::cli
