#include "springfold/core/small_lu.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>
#include <random>

#include "core/random_matrices.hpp"

namespace springfold {
namespace {

TEST(SmallLu, SolvesWhatEigenSolves) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 400; ++trial) {
    const Index n = 1 + trial % SmallLu::largest;
    Matrix A = random_matrix(random, n, n);
    if (trial % 3 == 0) A.diagonal().setZero();  // no pivot where it stands
    if (n == 1) A(0, 0) = -0.5;
    const Vector x = random_matrix(random, n, 1);
    Vector solution = A * x;
    const SmallLu lu(A);
    lu.solve(solution.data());
    const double condition = A.norm() * A.inverse().norm();
    EXPECT_LT((solution - x).norm(), 1e-15 * condition * x.norm() * static_cast<double>(n))
        << "trial " << trial;
    Matrix X = random_matrix(random, n, 1 + trial % 19), AX = A * X;
    lu.solve(AX);
    EXPECT_LT((AX - X).norm(), 1e-15 * condition * X.norm() * static_cast<double>(n))
        << "trial " << trial;
    const Vector pivots = A.partialPivLu().matrixLU().diagonal().cwiseAbs();
    EXPECT_NEAR(lu.smallest_pivot(), pivots.minCoeff(), 1e-12 * condition);
    EXPECT_NEAR(lu.largest_pivot(), pivots.maxCoeff(), 1e-12 * condition);
  }
}

TEST(SmallLu, KnowsTheSignOfTheDeterminant) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 100; ++trial) {
    const Index n = 1 + trial % 12;
    Matrix A = random_matrix(random, n, n);
    EXPECT_EQ(SmallLu(A).sign(), A.determinant() < 0 ? -1 : 1) << "trial " << trial;
    A.col(0).setZero();
    EXPECT_EQ(SmallLu(A).sign(), 0) << "trial " << trial;
  }
}

TEST(SmallLu, PutsBordersAroundAMatrix) {
  std::mt19937 random(4);
  const Matrix A = random_matrix(random, 5, 5);
  const Vector b = random_matrix(random, 5, 1), c = random_matrix(random, 5, 1);
  Matrix whole(6, 6);
  whole << A, b, c.transpose(), 0.7;
  Vector one = random_matrix(random, 6, 1), other = one;
  SmallLu(whole).solve(one.data());
  SmallLu(A, b, c, 0.7).solve(other.data());
  EXPECT_EQ(one, other);
}

TEST(SmallLu, ShowsSingularMatricesAndNumbersThatAreNotFinite) {
  EXPECT_EQ(SmallLu(Matrix::Ones(3, 3)).smallest_pivot(), 0);
  EXPECT_EQ(SmallLu(Matrix::Zero(2, 2)).smallest_pivot(), 0);
  Matrix A = Matrix::Identity(3, 3);
  A(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(SmallLu(A).smallest_pivot() > 0);
}

}  // namespace
}  // namespace springfold
