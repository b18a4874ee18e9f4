// Sparse matrices in the form in which the engine asks for large ones, against dense arithmetic.
#include "springfold/core/sparse_matrices.hpp"

#include <gmock/gmock.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "core/random_matrices.hpp"

namespace springfold {
namespace {

/// Pairs of neighbours in a net of rows x columns, two unknowns each.
std::vector<std::vector<Index>> net(Index rows, Index columns) {
  std::vector<std::vector<Index>> members;
  const auto first = [columns](Index i, Index j) { return 2 * (i * columns + j); };
  for (Index i = 0; i < rows; ++i)
    for (Index j = 0; j < columns; ++j) {
      const Index a = first(i, j);
      if (i + 1 < rows) members.push_back({a, a + 1, first(i + 1, j), first(i + 1, j) + 1});
      if (j + 1 < columns) members.push_back({a, a + 1, first(i, j + 1), first(i, j + 1) + 1});
    }
  return members;
}

/// A sum of random members, indefinite, their sizes from 1e-3 to 1e3.
Matrix random_sum(std::mt19937& random, Index size,
                  const std::vector<std::vector<Index>>& members) {
  std::uniform_real_distribution<double> power(-3, 3);
  Matrix A = Matrix::Zero(size, size);
  for (const auto& list : members) {
    const auto m = static_cast<Index>(list.size());
    const Matrix part = random_matrix(random, m, m);
    A(list, list) += std::pow(10, power(random)) * (part + part.transpose());
  }
  return A;
}

struct Fixture {
  Index size;
  std::vector<std::vector<Index>> members;
  Matrix A;
  SparseMatrices matrices;
  StructuredMatrix J;

  Fixture(Index rows, Index columns, unsigned seed)
      : size{2 * rows * columns},
        members{net(rows, columns)},
        matrices{SparseLayout{size, members}} {
    std::mt19937 random{seed};
    A = random_sum(random, size, members);
    matrices.take(A, J);
  }
};

TEST(SparseMatrices, GiveTheProductsOfTheDenseMatrix) {
  Fixture f{5, 7, 1};
  const Vector v = Vector::LinSpaced(f.size, -1, 2);
  EXPECT_LT((product(f.J, v) - f.A * v).norm(), 1e-14 * f.A.norm() * v.norm());
  EXPECT_TRUE(magnitudes(f.J, v).isApprox(f.A.cwiseAbs() * v.cwiseAbs(), 1e-14));
  EXPECT_EQ(f.J.largest, f.A.cwiseAbs().maxCoeff());
}

TEST(SparseMatrices, SolveWithBordersBothWays) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    Fixture f{4, 9, seed};
    std::mt19937 random{seed + 100};
    const Index n = f.size, k = 2;
    const FrontalBorders borders{random_matrix(random, n, k), random_matrix(random, n, k),
                                 random_matrix(random, k, k)};
    Matrix M(n + k, n + k);
    M << f.A, borders.B, borders.C.transpose(), borders.D;
    const Matrix right = random_matrix(random, n + k, 3);
    Matrix X = right;
    ASSERT_TRUE(f.J.solve(borders, X, false));
    EXPECT_LT((M * X - right).norm(), 1e-10 * M.norm() * X.norm());
    X = right;
    ASSERT_TRUE(f.J.solve(borders, X, true));
    EXPECT_LT((M.transpose() * X - right).norm(), 1e-10 * M.norm() * X.norm());
  }
}

TEST(SparseMatrices, CountEigenvaluesAsTheDenseMatrixHasThem) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    Fixture f{6, 6, seed};
    const auto wanted = inertia_of(f.A);
    const auto found = f.J.inertia();
    ASSERT_TRUE(wanted && found);
    EXPECT_EQ(found->negative, wanted->negative);
    EXPECT_EQ(found->positive, wanted->positive);
  }
}

TEST(SparseMatrices, HandOutMatricesThatLiveBesideEachOther) {
  Fixture f{3, 5, 1};
  StructuredMatrix other;
  f.matrices.take(2 * f.A, other);
  const Vector v = Vector::Ones(f.size);
  EXPECT_EQ(product(other, v), 2 * product(f.J, v));
}

TEST(SparseMatrices, SayWhenAMatrixIsSingular) {
  const std::vector<std::vector<Index>> members{{0, 1}, {1, 2}};
  SparseMatrices matrices{SparseLayout{3, members}};
  Matrix A = Matrix::Zero(3, 3);
  A.topLeftCorner(2, 2) << 1, -1, -1, 1;
  A.bottomRightCorner(2, 2) += (Matrix(2, 2) << 1, -1, -1, 1).finished();
  StructuredMatrix J;
  matrices.take(A, J);
  Matrix X = Matrix::Ones(3, 1);
  EXPECT_FALSE(J.solve({Matrix(3, 0), Matrix(3, 0), Matrix(0, 0)}, X, false));
  EXPECT_EQ(J.inertia()->zero, 1);
}

// A long strip is eliminated from one end to the other: what is held together does not grow with it.
TEST(SparseLayout, HoldsOneLayerOfALongStripTogether) {
  const Index of_100 = SparseLayout(2 * 3 * 100, net(3, 100)).largest_front();
  const Index of_300 = SparseLayout(2 * 3 * 300, net(3, 300)).largest_front();
  EXPECT_EQ(of_100, of_300);
  EXPECT_LT(of_300, 40);
}

}  // namespace
}  // namespace springfold
