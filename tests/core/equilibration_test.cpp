#include "springfold/core/equilibration.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <random>

#include "springfold/core/inertia.hpp"

namespace springfold {
namespace {

/// Q D Q^T with a random rotation Q and the eigenvalues D.
Matrix with_eigenvalues(std::mt19937& random, const Vector& values) {
  std::normal_distribution<double> normal;
  Matrix A(values.size(), values.size());
  for (double& a : A.reshaped()) a = normal(random);
  const Matrix Q = A.householderQr().householderQ();
  return Q * values.asDiagonal() * Q.transpose();
}

Matrix badly_scaled(std::mt19937& random, const Vector& values) {
  std::uniform_int_distribution<int> exponent(-15, 15);
  Vector s(values.size());
  for (double& x : s) x = std::ldexp(1.0, exponent(random));
  const Matrix A = with_eigenvalues(random, values);
  return s.asDiagonal() * (0.5 * (A + A.transpose())) * s.asDiagonal();
}

TEST(Equilibration, BringsRowsAndColumnsToOneSizeAndKeepsSymmetry) {
  std::mt19937 random(31);
  for (int trial = 0; trial < 100; ++trial) {
    const Matrix A = badly_scaled(random, Vector::LinSpaced(6, -2, 3));
    const Equilibration scale = equilibrate(A);
    EXPECT_EQ(scale.rows, scale.columns);
    const Matrix B = scale.rows.asDiagonal() * A * scale.columns.asDiagonal();
    EXPECT_EQ(B, B.transpose());
    EXPECT_LE(B.cwiseAbs().maxCoeff(), 4);
    EXPECT_GE(B.cwiseAbs().rowwise().maxCoeff().minCoeff(), 0.25);
  }
}

TEST(Equilibration, MakesNothingOfRounding) {
  const Matrix A = Vector{{1, 2, 1e-17}}.asDiagonal();
  EXPECT_EQ(equilibrate(A).rows[2], 1);
  EXPECT_EQ(corank(A), 1);
  EXPECT_EQ(inertia_of(A), (Inertia{0, 1, 2}));
}

TEST(Corank, CountsZerosWhateverTheScalesOfTheUnknowns) {
  std::mt19937 random(32);
  for (int trial = 0; trial < 100; ++trial) {
    EXPECT_EQ(corank(badly_scaled(random, Vector{{1, -2, 0.5, 3, -1}})), 0);
    EXPECT_EQ(corank(badly_scaled(random, Vector{{1, -2, 0, 3, -1}})), 1);
    EXPECT_EQ(corank(badly_scaled(random, Vector{{1, 0, 0, 3, -1}})), 2);
  }
  EXPECT_EQ(corank(Matrix(Vector{{1, 1e-9, 1}}.asDiagonal())), 0);
  EXPECT_EQ(corank(Matrix::Constant(2, 2, std::numeric_limits<double>::quiet_NaN())), 2);
}

TEST(Inertia, OfBadlyScaledMatricesIsThatOfTheWellScaledOnes) {
  std::mt19937 random(33);
  for (int trial = 0; trial < 100; ++trial)
    EXPECT_EQ(inertia_of(badly_scaled(random, Vector{{1, -2, 0.5, 3, -1, 0.1}})),
              (Inertia{2, 0, 4}));
}

}  // namespace
}  // namespace springfold
