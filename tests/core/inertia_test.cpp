#include "springfold/core/inertia.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <limits>
#include <random>

#include "core/random_matrices.hpp"

namespace springfold {
namespace {

/// Counts by eigenvalues, the slow and safe way.
Inertia by_eigenvalues(const Matrix& A, double zero) {
  Inertia inertia;
  const Vector values = Eigen::SelfAdjointEigenSolver<Matrix>(A).eigenvalues();
  for (const double value : values)
    ++(std::abs(value) < zero ? inertia.zero : value < 0 ? inertia.negative : inertia.positive);
  return inertia;
}

/// | K  -J^T |  with `springs` non-zero entries on the diagonal K: a chain of the virtual joint
/// | -J   0  |  method, most of whose joints are passive. No 1x1 pivot lies on its zero diagonal.
Matrix chain_like_matrix(std::mt19937& random, Index coordinates, Index closures, Index springs) {
  Matrix A = Matrix::Zero(coordinates + closures, coordinates + closures);
  const Matrix J = random_matrix(random, closures, coordinates);
  A.bottomLeftCorner(closures, coordinates) = -J;
  A.topRightCorner(coordinates, closures) = -J.transpose();
  for (Index i = 0; i < springs; ++i) A(i, i) = std::exp(random_matrix(random, 1, 1)(0, 0));
  return A;
}

TEST(Inertia, AgreesWithEigenvaluesOnChainsWithFewSprings) {
  std::mt19937 random(21);
  for (int trial = 0; trial < 1000; ++trial) {
    const Index closures = 2 + trial % 5, coordinates = closures + trial % 4;
    // Fewer springs than free motions: singular; as many: the KKT matrix of a stable chain.
    const Index springs = coordinates - closures + trial % 2;
    const Matrix A = chain_like_matrix(random, coordinates, closures, springs);
    const auto inertia = inertia_of(A);
    ASSERT_TRUE(inertia.has_value());
    EXPECT_EQ(*inertia, by_eigenvalues(A, 1e-10)) << "trial " << trial << "\n" << A;
  }
}

TEST(Inertia, OfAStableChainHasOneNegativeEigenvaluePerClosure) {
  std::mt19937 random(22);
  for (int trial = 0; trial < 100; ++trial) {
    const auto inertia = inertia_of(chain_like_matrix(random, 7, 4, 5));
    EXPECT_EQ(inertia, (Inertia{4, 0, 7}));
  }
}

TEST(Inertia, AgreesWithEigenvaluesOnDenseIndefiniteMatrices) {
  std::mt19937 random(23);
  for (int trial = 0; trial < 200; ++trial) {
    const Matrix B = random_matrix(random, 1 + trial % 12, 1 + trial % 12);
    const Matrix A = B + B.transpose();
    EXPECT_EQ(inertia_of(A), by_eigenvalues(A, 1e-10)) << A;
  }
}

TEST(Inertia, CountsZeroEigenvaluesOfMatricesOfLowRank) {
  std::mt19937 random(24);
  for (Index rank = 0; rank < 6; ++rank) {
    const Matrix B = random_matrix(random, 6, rank);
    Vector signs = Vector::Ones(rank);
    signs.head(rank / 2).setConstant(-1);
    const Matrix A = B * signs.asDiagonal() * B.transpose();
    EXPECT_EQ(inertia_of(A), (Inertia{rank / 2, 6 - rank, rank - rank / 2})) << "rank " << rank;
  }
}

TEST(Inertia, OfTheZeroMatrixIsAllZeros) {
  EXPECT_EQ(inertia_of(Matrix::Zero(3, 3)), (Inertia{0, 3, 0}));
}

TEST(Inertia, OfTheEmptyMatrixIsEmpty) { EXPECT_EQ(inertia_of(Matrix(0, 0)), (Inertia{0, 0, 0})); }

TEST(Inertia, DoesNotDependOnTheUnitOfTheMatrix) {
  std::mt19937 random(25);
  const Matrix A = chain_like_matrix(random, 6, 4, 3);
  const auto inertia = inertia_of(A);
  for (const double unit : {1e-200, 1e-9, 1e9, 1e200}) EXPECT_EQ(inertia_of(unit * A), inertia);
}

TEST(Inertia, ReadsTheLowerTriangle) {
  Matrix A(2, 2);
  A << 1, 99, 0, -1;
  EXPECT_EQ(inertia_of(A), (Inertia{1, 0, 1}));
}

TEST(Inertia, IsNotDefinedWhereANumberIsNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Matrix A = Matrix::Identity(3, 3);
    A(2, 1) = bad;
    EXPECT_FALSE(inertia_of(A).has_value());
    EXPECT_FALSE(solve_symmetric(A, Matrix::Ones(3, 1)).has_value());
  }
}

TEST(SolveSymmetric, SolvesIndefiniteSystemsWithSeveralRightSides) {
  std::mt19937 random(26);
  for (int trial = 0; trial < 200; ++trial) {
    const Matrix A = chain_like_matrix(random, 6, 4, 4);
    const Matrix X = random_matrix(random, 10, 3);
    const auto solution = solve_symmetric(A, A * X);
    ASSERT_TRUE(solution.has_value());
    const double condition = A.norm() * A.inverse().norm();
    EXPECT_LT((*solution - X).norm(), 1e-14 * condition * X.norm()) << "trial " << trial;
  }
}

/// Few rows are factorised on the stack, many by LAPACK: a matrix and the same one beside the identity.
TEST(SolveSymmetric, GivesTheSameForFewRowsAndForMany) {
  std::mt19937 random(28);
  for (int trial = 0; trial < 300; ++trial) {
    const Index n = 1 + trial % 24;
    Matrix A = random_matrix(random, n, n);
    if (trial % 2 == 0 && n > 3) A = chain_like_matrix(random, n - n / 3, n / 3, n - 2 * (n / 3));
    const Vector sizes = (trial % 3 * random_matrix(random, n, 1).array()).exp();
    A = sizes.asDiagonal() * (A + A.transpose()).eval() * sizes.asDiagonal();
    Matrix large = Matrix::Identity(n + 25, n + 25);
    large.topLeftCorner(n, n) = A;
    const Matrix B = random_matrix(random, n + 25, 2);
    const auto few = solve_and_count(A, B.topRows(n)), many = solve_and_count(large, B);
    ASSERT_TRUE(few.has_value() && many.has_value()) << "trial " << trial;
    EXPECT_EQ(few->inertia.negative, many->inertia.negative) << "trial " << trial;
    EXPECT_EQ(few->inertia, *inertia_of(A)) << "trial " << trial;
    const Matrix S = sizes.cwiseInverse().asDiagonal() * A * sizes.cwiseInverse().asDiagonal();
    const double condition = S.norm() * S.inverse().norm();
    const Matrix difference = sizes.asDiagonal() * (few->X - many->X.topRows(n));
    EXPECT_LT(difference.norm(), 1e-14 * condition * (sizes.asDiagonal() * few->X).norm())
        << "trial " << trial;
  }
}

TEST(SolveSymmetric, RefusesSingularMatrices) {
  std::mt19937 random(27);
  EXPECT_FALSE(solve_symmetric(chain_like_matrix(random, 6, 4, 1), Matrix::Ones(10, 1)));
  EXPECT_FALSE(solve_symmetric(Matrix::Zero(2, 2), Matrix::Ones(2, 1)));
}

TEST(SolveSymmetric, RefusesARightSideThatIsNotFinite) {
  const Matrix B = Matrix::Constant(2, 1, std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(solve_symmetric(Matrix::Identity(2, 2), B));
}

TEST(SolveSymmetric, OfNothingIsNothing) {
  const auto X = solve_symmetric(Matrix(0, 0), Matrix(0, 2));
  ASSERT_TRUE(X.has_value());
  EXPECT_EQ(X->rows(), 0);
  EXPECT_EQ(X->cols(), 2);
}

}  // namespace
}  // namespace springfold
