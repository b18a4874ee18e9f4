// springfold animate CASE: the mechanism moved along its curve.
#pragma once

#include "arguments.hpp"
#include "session.hpp"

namespace springfold::cli {

/// @returns the exit code
int animate_command(const Arguments& arguments, const Session& session);

}  // namespace springfold::cli
