#include "constant_nodes.hpp"

#include <cmath>
#include <numbers>

namespace springfold::analysis {
namespace {

constexpr Index parts = 32;  ///< between nodes; even
constexpr Index finer = 4;   ///< places of interpolation in every part

/// Clenshaw-Curtis weights on [-1, 1], divided by 2.
double mean_weight(Index k) {
  const double angle = std::numbers::pi * static_cast<double>(k) / static_cast<double>(parts);
  double sum = 1;
  for (Index j = 1; 2 * j <= parts; ++j) {
    const double b = 2 * j == parts ? 1 : 2;
    sum -= b * std::cos(2 * static_cast<double>(j) * angle) / static_cast<double>(4 * j * j - 1);
  }
  return (k == 0 || k == parts ? 0.5 : 1.0) * sum / static_cast<double>(parts);
}

}  // namespace

RangeNodes range_nodes(double low, double high) {
  RangeNodes range{Vector(parts + 1), Vector(parts + 1), Matrix::Zero(finer * parts + 1, parts + 1)};
  const auto place = [](double k) { return -std::cos(std::numbers::pi * k / parts); };
  for (Index k = 0; k <= parts; ++k) {
    const double x = place(static_cast<double>(k));
    range.nodes[k] = k == 0 ? low : k == parts ? high : 0.5 * (low + high) + 0.5 * (high - low) * x;
    range.mean[k] = mean_weight(k);
  }
  for (Index i = 0; i <= finer * parts; ++i) {
    if (i % finer == 0) {
      range.inside(i, i / finer) = 1;
      continue;
    }
    const double x = place(static_cast<double>(i) / finer);
    double sum = 0;
    for (Index k = 0; k <= parts; ++k) {
      const double end = k == 0 || k == parts ? 0.5 : 1.0;
      const double weight = (k % 2 == 0 ? end : -end) / (x - place(static_cast<double>(k)));
      range.inside(i, k) = weight;
      sum += weight;
    }
    range.inside.row(i) /= sum;
  }
  return range;
}

}  // namespace springfold::analysis
