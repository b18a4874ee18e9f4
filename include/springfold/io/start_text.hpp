// Starts in words, with the places of the case that they are about.
#pragma once

#include <string>

#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// Why a start was not found, or does not lie within the study's limits: "case.toml:40:9:
/// study[1].start.pose: the pose [2, 0] cannot be reached: chain leg is short by 0.5; a pose near it ...".
/// Empty where nothing is wrong.
/// @param planned  the run, or nullptr: without a place
std::string start_problem(const analysis::StartReport& start, const PlannedRun* planned);

/// A text that begins with a key of the study, "trace.spacing: ...", with the place of that key in the case
/// before it; other texts as they are. @param planned  of the run, or nullptr
std::string with_place(const std::string& text, const PlannedRun* planned);

}  // namespace springfold::io
