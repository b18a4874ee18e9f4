// Which studies of a case are run, and where results go.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "springfold/io/case_file.hpp"

namespace springfold::cli {

/// Names of the case's studies, each once, in order.
std::vector<std::string> study_names(const io::Case& the_case);

/// For the first name that no study has: what is wrong, the nearest name and all names. Empty if
/// all are known.
std::string unknown_study(const io::Case& the_case, const std::vector<std::string>& wanted);

/// Of every value given with --set what is said where a study does not use it, since it varies or sets that parameter
/// itself: one message per value.
std::vector<std::string> settings_without_effect(
    const io::Case& the_case, const std::map<std::string, std::string>& overrides);

/// The case with these studies only: their runs, figures and expected values. Empty: all.
io::Case with_studies(io::Case the_case, const std::vector<std::string>& wanted);

/// results/<name>: the name of the case file without its ending, or of its folder if the file is
/// called "case"; always below results.
std::filesystem::path default_folder(const std::filesystem::path& case_file);

/// Creates the folder and tries to write into it. Empty if that works, otherwise path and reason.
std::string problem_with_folder(const std::filesystem::path& folder);

}  // namespace springfold::cli
