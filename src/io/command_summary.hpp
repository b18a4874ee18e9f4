// Summaries of studies of the kinds control, map and workspace, and of those in a second parameter.
#pragma once

#include <string>

#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"
#include "springfold/io/shown_text.hpp"

namespace springfold::io {

/// Is its summary not that of a curve from its start?
constexpr bool has_summary_of_its_own(analysis::StudyKind kind) {
  return analysis::is_of_commands(kind) || analysis::is_of_critical_points(kind);
}

/// Lines below the heading of a run. @pre the study is of one of these kinds
std::string command_lines(const Case& the_case, const PlannedRun& planned,
                          const analysis::StudyResult& result);

}  // namespace springfold::io
