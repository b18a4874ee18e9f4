// Least squares of smallest norm where rank is in doubt. Private to statics.
#pragma once

#include <Eigen/QR>

#include "springfold/core/types.hpp"

namespace springfold::statics {

/// x of smallest norm among those that make |J x - b| smallest; singular values below `threshold` times
/// the largest pivot count as zero. The threshold has to be set before the decomposition is computed: set
/// afterwards it changes the rank, but not the factors that belong to it.
inline Vector minimum_norm_solution(const Matrix& J, const Vector& b, double threshold = 1e-9) {
  Eigen::CompleteOrthogonalDecomposition<Matrix> decomposition(J.rows(), J.cols());
  decomposition.setThreshold(threshold);
  decomposition.compute(J);
  return decomposition.solve(b);
}

}  // namespace springfold::statics
