// Reading a case that may be a pipe, or take long.
#pragma once

#include <functional>

#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// As load_case(file, overrides), and ends when it is asked to.
/// @param stop_requested  asked several times a second, also while a pipe has nothing to read; empty:
///                        nobody
/// @throws CaseError with all mistakes of the stage at which it stopped
/// @throws continuation::Interrupted once stop_requested says so
Case load_case(const std::filesystem::path& file,
               const std::map<std::string, std::string>& overrides,
               const std::function<bool()>& stop_requested);

}  // namespace springfold::io
