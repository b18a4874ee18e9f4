// springfold import.
#pragma once

#include "arguments.hpp"
#include "session.hpp"

namespace springfold::cli {

/// Writes the case of a mesh, and says what was made of it and what was left out.
int import_command(const Arguments& arguments, const Session& session);

}  // namespace springfold::cli
