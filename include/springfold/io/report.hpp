// One HTML page of a run: curves, and the mechanism in the posture under the cursor.
#pragma once

#include <string>
#include <vector>

#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// Was the page built in? Not with -DSPRINGFOLD_REPORT=OFF.
bool has_report();

/// The page as text: nothing else is needed to show it. All texts of the case are data in it. Searches, maps and
/// jumps have their rows in it too; runs of a sweep whose curves are not kept have none.
/// @pre has_report()
std::string report_html(const Case& the_case, const std::vector<analysis::StudyResult>& results);

}  // namespace springfold::io
