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

/// Is a curve that ends at `end` about to meet such a point: has the closures' smallest singular value
/// fallen below a hundredth of what it is at `other`, a point far along the curve?
/// @returns so in words; nothing where it is not
std::optional<std::string> nears_kinematic_singularity(const PathProblem& problem,
                                                       const continuation::CurvePoint& end,
                                                       const continuation::CurvePoint& other);

}  // namespace springfold::analysis
