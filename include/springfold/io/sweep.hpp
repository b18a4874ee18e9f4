// Runs of which only a row of a table is kept.
#pragma once

#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// The row of this run in its sweep's table, with what the case compares of the run.
analysis::SweepRow sweep_row(const Case& the_case, const PlannedRun& planned,
                             const analysis::StudyResult& result);

/// What is left of a result if its curves are not kept: name, start found or not, time, row.
analysis::StudyResult row_alone(const Case& the_case, const PlannedRun& planned,
                                const analysis::StudyResult& result);

}  // namespace springfold::io
