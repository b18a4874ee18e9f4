// Motions that nothing resists, over a way and not at a point alone. Private to analysis.
#pragma once

#include <optional>
#include <string>

#include "path_problem.hpp"
#include "springfold/continuation/curve.hpp"

namespace springfold::analysis {

/// Where a curve could not go on: do the unknowns move there without any force, lambda held, over a finite way in one
/// piece? (Two dead bands in series share their slack in any way.) Pieces beside the point are looked at too.
/// @returns the coordinates that move most, "rope.1, rope.2"; nothing where there is no such motion
std::optional<std::string> neutral_motion(const PathProblem& problem,
                                          const continuation::CurvePoint& end);

}  // namespace springfold::analysis
