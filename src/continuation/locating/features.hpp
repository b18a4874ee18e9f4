// Where an interpolant comes near to zero. Private to the engine.
#pragma once

#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <vector>

#include "continuation/points/chebyshev.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {

/// Zero of g between a and b, where it has opposite signs.
template <class Function>
double bisect(Function g, double a, double b) {
  const double ga = g(a), gb = g(b);
  if (ga == 0 || gb == 0) return ga == 0 ? a : b;
  if (!((ga < 0 && gb > 0) || (ga > 0 && gb < 0))) return 0.5 * (a + b);  // not a number
  std::uintmax_t most = 100;
  const auto close = [=](double l, double r) {
    return std::abs(r - l) <= few_roundings * std::max(std::abs(l), std::abs(r));
  };
  const auto [low, high] = boost::math::tools::toms748_solve(g, a, b, ga, gb, close, most);
  return 0.5 * (low + high);
}

/// Cells in which an interpolant is looked at.
inline constexpr int feature_cells = 200;

/// Where the interpolant crosses zero, or has an extremum that reaches the level.
std::vector<double> features_of(const Interpolant& p, double level);

/// The interval's ends and the polynomial's extrema between them.
std::vector<double> extrema_of(const Interpolant& p, double a, double b, double spacing);

}  // namespace springfold::continuation
