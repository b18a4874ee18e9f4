// Chebyshev nodes of a range: mean and interpolation as weights. Private to analysis.
#pragma once

#include "springfold/core/types.hpp"

namespace springfold::analysis {

/// Values f at `nodes` give the mean `mean . f` (Clenshaw and Curtis 1960) and, between the nodes, `inside * f`.
struct RangeNodes {
  Vector nodes{};  ///< from low to high, both ends among them
  Vector mean{};   ///< weights, their sum is 1
  Matrix
      inside{};  ///< barycentric interpolation, its rows are places at even angles, the nodes among them
};

/// @pre low < high
RangeNodes range_nodes(double low, double high);

/// The same weights at a place between the rows of `inside`: 2.5 lies at the angle half-way between rows 2 and 3.
Vector range_weights(double row);

}  // namespace springfold::analysis
