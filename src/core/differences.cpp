#include "springfold/core/differences.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace springfold {
namespace {

constexpr int grid_nodes = 8;

/// Derivative at t of the polynomial that is 1 at node j of first, ..., last and 0 at the others.
double slope_of_cardinal(int first, int last, int j, double t) {
  double sum = 0;
  for (int m = first; m <= last; ++m) {
    if (m == j) continue;
    double product = 1.0 / (j - m);
    for (int l = first; l <= last; ++l)
      if (l != j && l != m) product *= (t - l) / (j - l);
    sum += product;
  }
  return sum;
}

/// Which multiple of h is the first of eight, four on each side of p.
double first_of_grid(double p, double h) { return std::floor(p / h) - (grid_nodes / 2 - 1); }

/// From inside out, a pair of places more for two orders more, `pairs` of them or until these agree.
std::optional<GridDerivative> by_pairs(const std::function<std::optional<Vector>(double)>& f,
                                       double p, double h, int pairs, double enough) {
  const double first = first_of_grid(p, h);
  const double t = p / h - first;
  std::array<Vector, grid_nodes> values;
  GridDerivative result;
  for (int pair = 1; pair <= pairs; ++pair) {
    const int low = grid_nodes / 2 - pair, high = grid_nodes / 2 - 1 + pair;
    for (const int j : {low, high}) {
      auto value = f((first + j) * h);
      if (!value) return std::nullopt;
      values[static_cast<std::size_t>(j)] = std::move(*value);
    }
    Vector finer = Vector::Zero(values[static_cast<std::size_t>(low)].size());
    for (int j = low; j <= high; ++j)
      finer += slope_of_cardinal(low, high, j, t) / h * values[static_cast<std::size_t>(j)];
    if (pair > 1) {
      const double before = result.doubt;
      result.doubt = (finer - result.value).lpNorm<Eigen::Infinity>();
      const bool shrinks = pair > 2 && result.doubt < before;
      result.expected_error = shrinks ? result.doubt * (result.doubt / before) : result.doubt;
    }
    const double size = std::max(1.0, finer.lpNorm<Eigen::Infinity>());
    result.value = std::move(finer);
    if (pair > 1 && result.doubt < enough * size) break;
  }
  return result;
}

}  // namespace

std::optional<Vector> six_point_derivative(const std::function<std::optional<Vector>(double)>& f,
                                           double p, double h) {
  constexpr std::array<double, 3> weights{45, -9, 1};
  Vector sum;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const double offset = static_cast<double>(k + 1) * h;
    const auto above = f(p + offset), below = f(p - offset);
    if (!above || !below) return std::nullopt;
    const Vector term = weights[k] * (*above - *below);
    sum = k == 0 ? term : Vector(sum + term);
  }
  return sum / (60 * h);
}

std::optional<GridDerivative> grid_derivative(const std::function<std::optional<Vector>(double)>& f,
                                              double p, double h, double enough) {
  return by_pairs(f, p, h, grid_nodes / 2, enough);
}

std::optional<GridDerivative> rough_grid_derivative(
    const std::function<std::optional<Vector>(double)>& f, double p, double h) {
  return by_pairs(f, p, h, 2, 0);
}

}  // namespace springfold
