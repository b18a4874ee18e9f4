// springfold check
#pragma once

#include "arguments.hpp"
#include "session.hpp"

namespace springfold::cli {

/// What a case contains, as text: bodies, chains, degrees of freedom, studies.
std::string description_of(const io::Case& the_case);

/// Reads the case and prints what it contains. Returns the exit code.
/// @throws io::CaseError for mistakes in the case
int check_command(const Arguments& arguments, const Session& session);

}  // namespace springfold::cli
