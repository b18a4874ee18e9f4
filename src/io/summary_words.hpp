// What happened in words, as lines of the summary for people. Private to io.
#pragma once

#include <string>
#include <vector>

#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"
#include "sweep_tables.hpp"

namespace springfold::io {

/// Of one run.
std::string outline_lines(const Case& the_case, const analysis::StudyResult& result);

/// The results of the same study that follow each other, without those that are rows of a table.
std::vector<std::vector<const analysis::StudyResult*>> studies_of(
    const std::vector<analysis::StudyResult>& results);

/// Of all runs of a study, below its name.
std::string study_lines(const Case& the_case,
                        const std::vector<const analysis::StudyResult*>& runs);

/// Of the runs of a sweep, below its name; nothing of a study that was not chosen.
/// @param planned  how many runs it has
std::string sweep_lines(const Case& the_case, const SweepTable& sweep, int planned,
                        const std::vector<analysis::StudyResult>& results);

}  // namespace springfold::io
