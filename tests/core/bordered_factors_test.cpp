// One factorisation for the corrector, the tangent, the count and the test functions.
#include "springfold/core/bordered_factors.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <random>

#include "core/random_matrices.hpp"

namespace springfold {
namespace {

/// A symmetric matrix with an eigenvalue of a given size and others of 0.3 to 3 and both signs.
Matrix symmetric_with(std::mt19937& random, Index n, double least) {
  const Matrix Q = Eigen::HouseholderQR<Matrix>(random_matrix(random, n, n)).householderQ();
  std::uniform_real_distribution<double> size(0.3, 3);
  Vector values =
      Vector::NullaryExpr(n, [&] { return random() % 2 == 0 ? size(random) : -size(random); });
  values[n / 2] = least;
  const Matrix K = Q * values.asDiagonal() * Q.transpose();
  return 0.5 * (K + K.transpose());
}

struct Bordered {
  Linearisation at{};
  Vector weights{};
  Direction border{};

  Matrix matrix() const {
    const Index n = at.dF_dlambda.size();
    Matrix E(n + 1, n + 1);
    E << at.dF_dx, at.dF_dlambda, weights.cwiseProduct(border.dx).transpose(), border.dlambda;
    return E;
  }
};

Bordered bordered(std::mt19937& random, const Matrix& K) {
  const Index n = K.rows();
  return {{K, random_matrix(random, n, 1)},
          Vector::Constant(n, 1.5),
          {random_matrix(random, n, 1), 0.4}};
}

void expect_solutions(std::mt19937& random, const Bordered& of, BorderedFactors& factors,
                      const std::string& what) {
  ASSERT_TRUE(factors.set_border(of.weights, of.border)) << what;
  const Matrix E = of.matrix(), inverse = E.inverse();
  const Index n = E.rows() - 1;
  const double tolerance = 2e-14 * E.norm() * inverse.norm() * static_cast<double>(n + 1);
  const Vector right = random_matrix(random, n + 1, 1);
  Vector x = right;
  ASSERT_TRUE(factors.solve(x.data())) << what;
  EXPECT_LT((x - inverse * right).norm(), tolerance * x.norm()) << what;
  ASSERT_TRUE(factors.solve_for_tangent(x.data())) << what;
  EXPECT_LT((x - inverse.col(n)).norm(), tolerance * x.norm()) << what;
  std::vector<Index> rows;
  for (Index i = 0; i < n; i += 2) rows.push_back(i);
  Matrix columns;
  factors.invert(rows, columns);
  for (std::size_t j = 0; j < rows.size(); ++j)
    EXPECT_LT((columns.col(static_cast<Index>(j)) - inverse.col(rows[j])).norm(),
              tolerance * inverse.norm())
        << what << ", column " << rows[j];
}

TEST(BorderedFactors, SolveWithEveryLastRowAlsoWhereTheMatrixIsNearlySingular) {
  std::mt19937 random(31);
  for (const bool symmetric : {true, false})
    for (const double least : {1.0, 1e-3, 1e-9, 1e-15, 0.0})
      for (const Index n : {1, 2, 3, 7, 10, 24, 39, 40, 64, 70, 129}) {
        Bordered of = bordered(random, symmetric_with(random, n, least));
        BorderedFactors factors;
        factors.begin(of.at, symmetric);
        for (int row = 0; row < 3; ++row) {
          of.border = {random_matrix(random, n, 1), row == 2 ? 0.0 : 0.7};
          expect_solutions(random, of, factors,
                           std::to_string(n) + (symmetric ? " symmetric, " : " general, ") +
                               std::to_string(least));
        }
      }
}

TEST(BorderedFactors, SolveChainsWithSpringsOfVeryDifferentStiffness) {
  std::mt19937 random(32);
  for (const double soft : {1.0, 1e-3, 1e-6})
    for (const double stiff : {1.0, 1e4}) {
      Matrix K = Matrix::Zero(10, 10);  // | springs  -J^T |, the last springs soft
      const Matrix J = random_matrix(random, 4, 6);
      K.bottomLeftCorner(4, 6) = -J;
      K.topRightCorner(6, 4) = -J.transpose();
      K.diagonal().head(6) << stiff, stiff, 1, 1, soft, soft;
      Bordered of = bordered(random, K);
      BorderedFactors factors;
      factors.begin(of.at, true);
      expect_solutions(random, of, factors, std::to_string(soft) + ", " + std::to_string(stiff));
    }
}

/// Against such a border no pivot of the matrix counts.
TEST(BorderedFactors, SolveAndCountWhereNearlyAllPivotsAreDelayed) {
  std::mt19937 random(35);
  Bordered of = bordered(random, 1e-5 * symmetric_with(random, 60, 0.5));
  BorderedFactors factors;
  for (int place = 0; place < 2; ++place) {  // the second one with the same last row
    of.at.dF_dx *= -1;
    factors.begin(of.at, true);
    expect_solutions(random, of, factors, "delayed");
    const Vector values = Eigen::SelfAdjointEigenSolver<Matrix>(of.at.dF_dx).eigenvalues();
    EXPECT_EQ(factors.negative(), (values.array() < 0).count());
  }
}

TEST(BorderedFactors, CountNegativeEigenvaluesFromTheSameFactors) {
  std::mt19937 random(33);
  for (int trial = 0; trial < 300; ++trial) {
    const Index n = 1 + trial % 45;
    const double least = trial % 3 == 0 ? -1e-6 : trial % 3 == 1 ? 1e-8 : 0.5;
    const Bordered of = bordered(random, symmetric_with(random, n, least));
    BorderedFactors factors;
    factors.begin(of.at, true);
    ASSERT_TRUE(factors.set_border(of.weights, of.border));
    const Vector values = Eigen::SelfAdjointEigenSolver<Matrix>(of.at.dF_dx).eigenvalues();
    EXPECT_EQ(factors.negative(), (values.array() < 0).count()) << "trial " << trial;
  }
}

TEST(BorderedFactors, CountNothingWhereAnEigenvalueIsZero) {
  std::mt19937 random(34);
  for (const Index n : {1, 4, 11}) {
    const Bordered of = bordered(random, symmetric_with(random, n, 0));
    BorderedFactors factors;
    factors.begin(of.at, true);
    ASSERT_TRUE(factors.set_border(of.weights, of.border)) << n;
    EXPECT_EQ(factors.negative(), std::nullopt) << n;
  }
}

TEST(BorderedFactors, SayWhereTheBorderedMatrixIsSingular) {
  for (const bool symmetric : {true, false}) {
    Bordered of{{Matrix{{2, 0}, {0, 0}}, Vector{{1, 0}}}, Vector::Ones(2), {Vector{{1, 1}}, 1}};
    BorderedFactors factors;
    factors.begin(of.at, symmetric);
    EXPECT_FALSE(factors.set_border(of.weights, of.border));
    of.at.dF_dlambda[1] = 1;
    factors.begin(of.at, symmetric);
    EXPECT_TRUE(factors.set_border(of.weights, of.border));
  }
}

}  // namespace
}  // namespace springfold
