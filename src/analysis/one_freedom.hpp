// Mechanisms of one freedom whose configurations are closed curves. Private to analysis.
#pragma once

#include "path_problem.hpp"

namespace springfold::analysis {

/// Joints that turn, closures that leave one freedom: then all configurations are bounded, and curves.
bool has_one_bounded_freedom(const statics::System& system);

/// Walks along the configurations from this one, through those at which the closures keep their rank.
/// @returns whether it came back: they are one smooth closed curve
bool is_closed_curve(const PathProblem& problem, const Vector& z);

}  // namespace springfold::analysis
