#include "springfold/core/differences.hpp"

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
                                              double p, double h) {
  const double first = first_of_grid(p, h);
  const double t = p / h - first;
  constexpr int last = grid_nodes - 1;
  GridDerivative result;
  Vector inner;
  for (int j = 0; j <= last; ++j) {
    const auto value = f((first + j) * h);
    if (!value) return std::nullopt;
    if (j == 0) result.value = inner = Vector::Zero(value->size());
    result.value += slope_of_cardinal(0, last, j, t) / h * *value;
    if (j > 0 && j < last) inner += slope_of_cardinal(1, last - 1, j, t) / h * *value;
  }
  result.doubt = (result.value - inner).lpNorm<Eigen::Infinity>();
  return result;
}

std::optional<Vector> rough_grid_derivative(const std::function<std::optional<Vector>(double)>& f,
                                            double p, double h) {
  constexpr int low = grid_nodes / 2 - 2, high = grid_nodes / 2 + 1;
  const double first = first_of_grid(p, h);
  const double t = p / h - first;
  Vector sum;
  for (int j = low; j <= high; ++j) {
    const auto value = f((first + j) * h);
    if (!value) return std::nullopt;
    if (j == low) sum = Vector::Zero(value->size());
    sum += slope_of_cardinal(low, high, j, t) / h * *value;
  }
  return sum;
}

}  // namespace springfold
