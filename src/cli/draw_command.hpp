// springfold draw CASE: the mechanism as a picture.
#pragma once

#include "arguments.hpp"
#include "session.hpp"

namespace springfold::cli {

/// @returns the exit code
int draw_command(const Arguments& arguments, const Session& session);

/// Writes the picture of the case's first run as it is given, beside its results.
/// @returns the exit code: 0 or 6
int draw_guess(const Arguments& arguments, const io::Case& the_case, const Session& session);

}  // namespace springfold::cli
