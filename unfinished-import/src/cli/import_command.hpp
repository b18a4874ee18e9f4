// springfold import
#pragma once

#include "arguments.hpp"
#include "session.hpp"

namespace springfold::cli {

/// Writes the case that a model of another program becomes, to standard output or to a file that is not there
/// yet. Returns the exit code.
/// @throws io::CaseError for mistakes in the file
int import_command(const Arguments& arguments, const Session& session);

}  // namespace springfold::cli
