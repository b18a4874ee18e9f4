// Least squares of smallest norm where rank is in doubt. Private to statics.
#pragma once

#include "springfold/core/decompositions.hpp"

namespace springfold::statics {

/// x of smallest norm among those that make |J x - b| smallest; singular values below `threshold` times
/// the largest pivot count as zero.
inline Vector minimum_norm_solution(const Matrix& J, const Vector& b, double threshold = 1e-9) {
  return least_squares(J, b, threshold);
}

}  // namespace springfold::statics
