// The start of a run in the summary for people: how it was found, what it cannot say, its stiffness.
// Private to io.
#pragma once

#include <string>

#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// @param planned  the run, for places; may be nullptr
std::string start_lines(const analysis::StartReport& start, const PlannedRun* planned);

/// The line of loads that have no potential; empty: all have one.
std::string loads_without_potential(const analysis::StudyResult& result);

/// What symmetric theory cannot say here, and what closures say twice.
std::string caution_lines(const analysis::StudyResult& result);

/// The stiffness or compliance matrix and its eigenvalues.
std::string stiffness_lines(const analysis::StudyResult& result);

}  // namespace springfold::io
