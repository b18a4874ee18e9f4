// springfold verify PATH...: many cases against their expected values.
#pragma once

#include "arguments.hpp"
#include "session.hpp"

namespace springfold::cli {

/// Case files in the order of their names: files themselves, of a folder case*.toml in it and in
/// its sub-folders. Throws std::filesystem::filesystem_error if something cannot be read.
std::vector<std::filesystem::path> case_files_of(const std::vector<std::filesystem::path>& paths);

/// Prints the table, writes no files. @returns the exit code: 0 only if everything holds
int verify_command(const Arguments& arguments, const Session& session);

}  // namespace springfold::cli
