// Points at which the closures of all chains together lose rank. Private to analysis.
#pragma once

#include <optional>
#include <string>

#include "path_problem.hpp"
#include "springfold/continuation/curve.hpp"

namespace springfold::analysis {

/// The closures as equations for everything that moves on the path, lambda included, have a lower rank
/// here than on both sides along the tangent (without one: beside it): a kinematic singularity. A part of the wrenches is then
/// not determined by statics, and equilibria with all its values form a line that no branch follows.
/// @returns what it is, in words; nothing where the rank is that of the surroundings
std::optional<std::string> kinematic_singularity(const PathProblem& problem,
                                                 const continuation::CurvePoint& point);

}  // namespace springfold::analysis
