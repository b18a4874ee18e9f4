// Minima under inequalities, by NLopt. Private to analysis.
#pragma once

#include <functional>
#include <optional>

#include "springfold/core/types.hpp"

namespace springfold::analysis {

/// Values of a problem at one place.
struct InequalityValues {
  double f = 0;
  Vector df{};
  Vector g{};   ///< wanted: g <= 0
  Matrix dg{};  ///< one row per inequality
};

/// min f(x) with g(x) <= 0, low <= x <= high.
struct InequalityProblem {
  Vector low{}, high{};
  Index inequalities = 0;
  /// Nothing where the problem is not defined: the search goes around such places.
  std::function<std::optional<InequalityValues>(const Vector& x)> at{};
  std::function<bool()> stopped{};  ///< true ends the search
};

/// How far a search goes.
enum class Depth {
  roughly,    ///< to a few digits: which of several minima is the best?
  to_the_end  ///< to rounding
};

/// Sequential quadratic programming (Kraft 1994, NLopt's SLSQP): the best point that was met, feasible ones first. A
/// local search; whether the point is a minimum is for the caller to judge.
/// @pre the problem is defined at `start`, which lies between the bounds
Vector search_minimum(const InequalityProblem& problem, const Vector& start,
                      Depth how = Depth::to_the_end);

/// Multipliers m >= 0 for which the sum of m_i `row i of active` comes nearest to -df.
Vector multipliers(const Vector& df, const Matrix& active);

}  // namespace springfold::analysis
