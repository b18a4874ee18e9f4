// In which ways a mechanism leaves a branch point. Private to analysis.
#pragma once

#include <vector>

#include "path_problem.hpp"
#include "springfold/continuation/curve.hpp"

namespace springfold::analysis {

/// Null vectors of dF/dy at a branch point: the modes in which it buckles there, at constant lambda. Each is of unit
/// length in the path's metric, its largest entry positive, and they are orthogonal; of several any other basis would
/// do. Those that move nothing but wrenches are left out.
/// @param count  how many eigenvalues vanish there
/// @returns fewer, or none, where dF/dy is not defined or has no such vectors that can be told
std::vector<Vector> null_modes(const PathProblem& problem, const continuation::CurvePoint& point,
                               Index count);

}  // namespace springfold::analysis
