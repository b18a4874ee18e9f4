// Tables of sweeps, one row per run, as text.
#pragma once

#include <string>
#include <vector>

#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// "complete", or the first thing that is missing, in one line.
std::string run_status(const PlannedRun& planned, const analysis::StudyResult& result);

/// Columns: run, the parameters that vary, those of the study, status. Runs without a result have no row.
std::string sweep_csv(const Case& the_case, const SweepTable& sweep,
                      const std::vector<analysis::StudyResult>& results);

/// Per sweep of the case its file, "sweeps/<study>.csv". No two are equal.
std::vector<std::string> sweep_files(const Case& the_case);

/// How many runs of the sweep are planned, done and complete.
struct SweepCounts {
  int planned = 0, done = 0, complete = 0;
};
SweepCounts counts_of(const Case& the_case, const SweepTable& sweep,
                      const std::vector<analysis::StudyResult>& results);

/// What the first columns run through: "F from 0.0012 to 0.07, in 90 of 100 runs". Two sentences at most.
std::vector<std::string> sweep_words(const Case& the_case, const SweepTable& sweep,
                                     const std::vector<analysis::StudyResult>& results);

}  // namespace springfold::io
