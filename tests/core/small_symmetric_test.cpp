#include "springfold/core/small_symmetric.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <array>
#include <random>

#include "core/random_matrices.hpp"

namespace springfold {
namespace {

/// Numbers of negative and of positive values.
std::pair<Index, Index> signs(const Vector& values) {
  return {(values.array() < 0).count(), (values.array() > 0).count()};
}

TEST(SmallSymmetric, PivotsHaveTheSignsOfTheEigenvaluesWhetherSomeAreDelayedOrNot) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 300; ++trial) {
    const Index n = 1 + trial % 30;
    Matrix A = random_symmetric(random, n);
    if (trial % 2 == 0) A.bottomRightCorner(n / 2, n / 2) *= 1e-5;  // small pivots
    const Vector border = Vector::Constant(n, trial % 4 < 2 ? 1 : 300);
    const SmallSymmetric::DelayedPivots delayed{.border = border.data()};
    SmallSymmetric all, some;
    ASSERT_TRUE(all.factorise(A) && some.factorise(A, &delayed));
    EXPECT_EQ(all.delayed(), 0);
    const auto expected = signs(Eigen::SelfAdjointEigenSolver<Matrix>(A).eigenvalues());
    Vector values(n);
    all.pivot_values(values.data());
    EXPECT_EQ(signs(values), expected) << "trial " << trial;
    some.pivot_values(values.data());
    EXPECT_EQ(signs(values), expected) << "trial " << trial;
  }
}

TEST(SmallSymmetric, PutsOffNoPivotOfAWellConditionedMatrixAndAllOfAZeroOne) {
  SmallSymmetric factors;
  const SmallSymmetric::DelayedPivots delayed{};
  ASSERT_TRUE(factors.factorise(Matrix{{2, 1, 0}, {1, -2, 1}, {0, 1, 3}}, &delayed));
  EXPECT_EQ(factors.delayed(), 0);
  ASSERT_TRUE(factors.factorise(Matrix::Zero(5, 5), &delayed));
  EXPECT_EQ(factors.delayed(), 5);
}

/// Through all of L and D, by hand where pivots were delayed; every row of A x = b holds to its own size.
TEST(SmallSymmetric, SolvesAlsoWherePivotsWereDelayed) {
  std::mt19937 random(6);
  constexpr Index padded = SmallSymmetric::padded;
  for (int trial = 0; trial < 200; ++trial) {
    const Index n = 1 + trial % 23;
    Matrix A = random_symmetric(random, n);
    if (trial % 3 == 0) A.row(n / 2) *= 1e-7, A.col(n / 2) *= 1e-7;
    if (trial % 3 == 1 && n > 1) A.diagonal().setZero();
    const SmallSymmetric::DelayedPivots delayed{};
    SmallSymmetric factors;
    ASSERT_TRUE(factors.factorise(A, &delayed));
    const Index rest = factors.delayed(), done = n - rest;
    const Vector b = A * random_symmetric(random, n).col(0);
    alignas(16) std::array<double, static_cast<std::size_t>(padded)> y{};
    factors.forward<1>(b.data(), y.data());
    factors.divide<1>(y.data());
    if (rest > 0) {
      Matrix R(rest, rest);
      for (Index i = 0; i < rest; ++i)
        for (Index j = 0; j < rest; ++j) R(i, j) = factors.rest(i, j);
      Eigen::Map<Vector> last(y.data() + done, rest);
      last = R.fullPivLu().solve(Vector(last)).eval();
    }
    Vector solution(n);
    factors.backward<1>(y.data(), solution.data());
    const Vector left = A * solution - b, sizes = A.cwiseAbs() * solution.cwiseAbs() + b.cwiseAbs();
    EXPECT_LT((left.array().abs() / sizes.array()).maxCoeff(), 1e-13 * static_cast<double>(n))
        << "trial " << trial << ", " << rest << " delayed";
  }
}

}  // namespace
}  // namespace springfold
