// The end of a curve that goes to infinite forces. Private to analysis.
#pragma once

#include <optional>

#include "path_problem.hpp"
#include "springfold/continuation/curve.hpp"

namespace springfold::analysis {

/// Where chains lose rank wrenches grow as the inverse of the way that is left, w = c / (s_end - s): 1/w is linear in s, and its
/// zero is a pole, at which there is no equilibrium. Behind it the wrenches come back from the other infinity. From two points of
/// a curve before its pole, solved points are sought nearer and nearer to it.
/// @param earlier, last  of one piece, in their order
/// @returns the nearest one, on the side of `last`: as near to the pole as special points are placed, or as rounding lets it be
///          solved; nothing where the wrenches do not grow a hundredfold, or another piece begins before
std::optional<continuation::CurvePoint> beside_infinite_force(
    const PathProblem& problem, const continuation::CurvePoint& earlier,
    const continuation::CurvePoint& last);

/// Is it an equilibrium, with wrenches in the sense of those of `before`?
bool is_solved_on_side_of(const PathProblem& problem, const continuation::CurvePoint& point,
                          const continuation::CurvePoint& before);

}  // namespace springfold::analysis
