// What acts throughout a study: constant loads and what is held.
#pragma once

#include <string>

#include "springfold/io/case_file.hpp"

namespace springfold::cli {

/// One line each: "load: [0.1, 0.2] on a, constant", "hold: a.x". Empty where a study has neither.
std::string study_details(const io::PlannedRun& planned);

}  // namespace springfold::cli
