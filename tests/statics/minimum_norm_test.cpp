#include "statics/minimum_norm.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <random>

namespace springfold::statics {
namespace {

Matrix random_matrix(std::mt19937& random, Index rows, Index columns) {
  std::normal_distribution<double> normal;
  Matrix A(rows, columns);
  for (Index j = 0; j < columns; ++j)
    for (Index i = 0; i < rows; ++i) A(i, j) = normal(random);
  return A;
}

TEST(MinimumNorm, SolutionIsThatOfThePseudoInverseWhereRankIsLostToRounding) {
  std::mt19937 random(41);
  for (int trial = 0; trial < 200; ++trial) {
    const Index rows = 5 + trial % 3, columns = 4 + trial % 5, rank = 2 + trial % 3;
    Matrix J = random_matrix(random, rows, rank) * random_matrix(random, rank, columns);
    J += 1e-13 * random_matrix(random, rows, columns);  // full rank by rounding alone
    const Vector b = random_matrix(random, rows, 1);
    Eigen::JacobiSVD<Matrix> svd(J, Eigen::ComputeThinU | Eigen::ComputeThinV);
    svd.setThreshold(1e-9);
    EXPECT_LT((minimum_norm_solution(J, b) - svd.solve(b)).norm(), 1e-9 * (1 + b.norm())) << trial;
  }
}

}  // namespace
}  // namespace springfold::statics
