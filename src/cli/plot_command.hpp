// springfold plot RESULTS: the figures of an earlier run drawn again.
#pragma once

#include "arguments.hpp"
#include "session.hpp"

namespace springfold::cli {

/// @returns the exit code
int plot_command(const Arguments& arguments, const Session& session);

}  // namespace springfold::cli
