// Summaries of studies of special points in a second parameter.
#pragma once

#include <string>

#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// Lines below the heading of a run. @pre the study is of one of these kinds
std::string critical_lines(const PlannedRun& planned, const analysis::StudyResult& result);

}  // namespace springfold::io
