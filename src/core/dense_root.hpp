// Small dense matrices with complete pivoting, in storage that is kept. Private to core.
#pragma once

#include <vector>

#include "springfold/core/inertia.hpp"

namespace springfold {

/// P A Q = L U with the largest entry of what is left as every pivot.
struct DenseRoot {
  Index size = 0;
  std::vector<double> values{};  ///< A, then L and U; column by column
  std::vector<Index> rows{}, columns{};
  std::vector<double> work{};

  void resize(Index n);
  double& at(Index row, Index column) {
    return values[static_cast<std::size_t>(column * size + row)];
  }
  /// @returns smallest over largest pivot; 1 for an empty matrix
  double factorise();
  /// x = A^-1 x or A^-T x. @pre factorise() > 0
  void solve(double* x, bool transposed);
};

/// Inertia of a symmetric matrix by complete pivoting with 1x1 and 2x2 pivots (Bunch, Parlett 1971);
/// destroys it. Where nothing is left that is larger than `small`, the rest counts as zero.
Inertia inertia_by_pivots(std::vector<double>& values, Index n, double small);

}  // namespace springfold
