// Stiffness on all sides of a start at which springs rest on their thresholds. Private to analysis.
#pragma once

#include "quantities.hpp"

namespace springfold::analysis {

/// One entry for every combination of sides of the springs that rest at the start, at most sixteen; empty
/// where none does.
std::vector<StartSide> sides_of_start(const Evaluator& evaluator,
                                      const continuation::CurvePoint& start);

}  // namespace springfold::analysis
