// How much the summary for people says.
#pragma once

#include <string>
#include <vector>

#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// The same as summary_table(), where every run of a study of several has its own words (three lines at most)
/// instead of three lines about all of them.
std::string detailed_summary_table(const Case& the_case,
                                   const std::vector<analysis::StudyResult>& results);

}  // namespace springfold::io
