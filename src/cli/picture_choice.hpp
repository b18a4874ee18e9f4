// What the commands that draw understand by their options.
#pragma once

#include <string>

#include "arguments.hpp"
#include "springfold/drawing/illustration.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::cli {

/// The run with this number. @param study  empty: of any study. @returns nullptr if there is none
const io::PlannedRun* run_of(const io::Case& the_case, const std::string& study, int number);

/// Title, units, --colour and --view.
drawing::IllustrationOptions options_of(const Arguments& arguments, const io::Case& the_case);

}  // namespace springfold::cli
