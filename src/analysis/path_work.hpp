// What a path of equilibria costs: the integral of dPi/dlambda over lambda. Private to analysis.
#pragma once

#include <optional>

#include "path_problem.hpp"

namespace springfold::analysis {

/// A state of equilibrium on a path; x are the unknowns of the path problem.
struct PathState {
  Vector x{};
  double lambda = 0;
};

/// Pi of the springs and loads at a state, dimensionless.
double path_energy(const PathProblem& problem, const PathState& state);

/// The state at this lambda between two neighbouring states of one smooth piece, also where lambda nearly turns back.
/// @returns nothing where the level does not lie between them or the curve is not found
std::optional<PathState> state_at_level(const PathProblem& problem, const PathState& from,
                                        const PathState& to, double target);

/// Integral between two neighbouring states of one smooth piece, by Gauss' rule of six points on the
/// curve between them. @returns nothing where the curve is not found
std::optional<double> path_work(const PathProblem& problem, const PathState& from,
                                const PathState& to);

}  // namespace springfold::analysis
