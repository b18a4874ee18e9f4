// springfold run
#pragma once

#include "arguments.hpp"
#include "session.hpp"

namespace springfold::cli {

/// Reads the case, runs its studies, writes results, prints tables, draws figures. Returns the exit
/// code. @throws io::CaseError for mistakes in the case; nothing is written then
int run_command(const Arguments& arguments, const Session& session);

}  // namespace springfold::cli
