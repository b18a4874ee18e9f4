// Summaries of studies of the kinds control, map and workspace.
#pragma once

#include <string>

#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// Lines below the heading of a run. @pre the study is of one of these kinds
std::string command_lines(const Case& the_case, const PlannedRun& planned,
                          const analysis::StudyResult& result);

}  // namespace springfold::io
