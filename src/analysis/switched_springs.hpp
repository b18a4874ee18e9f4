// Springs whose segment a jump changes. Private to analysis.
#pragma once

#include <string>
#include <vector>

#include "descent.hpp"
#include "frozen.hpp"

namespace springfold::analysis {

/// Springs that are in another segment at the landing than on the stable side of the point that was left. One that
/// rests at its threshold before carries nothing there: it counts if it stores energy at the landing.
/// @param before  a state on the stable side, reduced as the landscape's
std::vector<std::string> switched_springs(const PathProblem& traced, const Frozen& frozen,
                                          const Vector& before, const RestState& landing);

}  // namespace springfold::analysis
