#include "constant_nodes.hpp"

#include <cmath>
#include <numbers>

namespace springfold::analysis {
namespace {

constexpr Index node_parts = 32;  ///< between nodes; even
constexpr Index finer = 4;        ///< places of interpolation in every part

/// Clenshaw-Curtis weights on [-1, 1], divided by 2.
double mean_weight(Index k) {
  const double angle = std::numbers::pi * static_cast<double>(k) / static_cast<double>(node_parts);
  double sum = 1;
  for (Index j = 1; 2 * j <= node_parts; ++j) {
    const double b = 2 * j == node_parts ? 1 : 2;
    sum -= b * std::cos(2 * static_cast<double>(j) * angle) / static_cast<double>(4 * j * j - 1);
  }
  return (k == 0 || k == node_parts ? 0.5 : 1.0) * sum / static_cast<double>(node_parts);
}

/// Node k on [-1, 1].
double place(double k) { return -std::cos(std::numbers::pi * k / node_parts); }

}  // namespace

Vector range_weights(double row) {
  Vector weights = Vector::Zero(node_parts + 1);
  const double x = place(row / finer);
  for (Index k = 0; k <= node_parts; ++k) {
    const double distance = x - place(static_cast<double>(k));
    if (distance == 0) return Vector::Unit(node_parts + 1, k);
    const double end = k == 0 || k == node_parts ? 0.5 : 1.0;
    weights[k] = (k % 2 == 0 ? end : -end) / distance;
  }
  return weights / weights.sum();
}

RangeNodes range_nodes(double low, double high) {
  RangeNodes range{Vector(node_parts + 1), Vector(node_parts + 1),
                   Matrix::Zero(finer * node_parts + 1, node_parts + 1)};
  for (Index k = 0; k <= node_parts; ++k) {
    const double x = place(static_cast<double>(k));
    range.nodes[k] = k == 0            ? low
                     : k == node_parts ? high
                                       : 0.5 * (low + high) + 0.5 * (high - low) * x;
    range.mean[k] = mean_weight(k);
  }
  for (Index i = 0; i <= finer * node_parts; ++i)
    range.inside.row(i) = range_weights(static_cast<double>(i)).transpose();
  return range;
}

}  // namespace springfold::analysis
