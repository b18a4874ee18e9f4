// Random matrices of tests.
#pragma once

#include <random>

#include "springfold/core/types.hpp"

namespace springfold {

inline Matrix random_matrix(std::mt19937& random, Index rows, Index columns) {
  std::normal_distribution<double> normal;
  return Matrix::NullaryExpr(rows, columns, [&] { return normal(random); });
}

inline Matrix random_symmetric(std::mt19937& random, Index n) {
  const Matrix M = random_matrix(random, n, n);
  return M + M.transpose();
}

}  // namespace springfold
