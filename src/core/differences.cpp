#include "springfold/core/differences.hpp"

#include <array>
#include <cmath>

namespace springfold {
namespace {

constexpr int grid_nodes = 8;

/// Derivative at t of the polynomial that is 1 at node j of 0, 1, 2, ... and 0 at the others.
double slope_of_cardinal(int j, double t) {
  double sum = 0;
  for (int m = 0; m < grid_nodes; ++m) {
    if (m == j) continue;
    double product = 1.0 / (j - m);
    for (int l = 0; l < grid_nodes; ++l)
      if (l != j && l != m) product *= (t - l) / (j - l);
    sum += product;
  }
  return sum;
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

std::optional<Vector> grid_derivative(const std::function<std::optional<Vector>(double)>& f,
                                      double p, double h) {
  const double first = std::floor(p / h) - (grid_nodes / 2 - 1);
  const double t = p / h - first;
  Vector sum;
  for (int j = 0; j < grid_nodes; ++j) {
    const auto value = f((first + j) * h);
    if (!value) return std::nullopt;
    const Vector term = slope_of_cardinal(j, t) * *value;
    sum = j == 0 ? term : Vector(sum + term);
  }
  return sum / h;
}

}  // namespace springfold
