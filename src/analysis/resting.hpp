// Springs that rest exactly at their threshold along a branch. Private to analysis.
#pragma once

#include <vector>

#include "path_problem.hpp"
#include "springfold/continuation/curve.hpp"

namespace springfold::analysis {

/// All pieces that meet at a point whose switches do not leave zero along its tangent (without a
/// tangent: are zero), the point's own among them. Empty if no switch rests, or more than six do.
std::vector<Piece> pieces_around(const PathProblem& problem, const continuation::CurvePoint& point);

}  // namespace springfold::analysis
