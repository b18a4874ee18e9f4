// First equilibria next to one that is known. Private to statics.
#pragma once

#include "start_equations.hpp"

namespace springfold::statics {

/// Residuals of a start, scaled.
constexpr double start_tolerance = 1e-12;

/// Newton without safeguards to the last digits. @returns the largest entry of the residual
double polish(StartEquations& equations, StartState& state, int& iterations);

/// Largest change of a coordinate or pose.
double farthest_coordinate(const System& system, const Vector& a, const Vector& b);

/// From the solution of a neighbouring problem by its factors, or by Newton's method; false where their steps do not
/// shrink as they do near one solution: what they end in may be another equilibrium.
bool solve_beside(const System& system, const StartProblem& problem, StartEquations& equations,
                  const StartState& guess, FirstEquilibrium& result);

}  // namespace springfold::statics
