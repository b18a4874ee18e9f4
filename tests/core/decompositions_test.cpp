#include "springfold/core/decompositions.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

namespace springfold {
namespace {

constexpr double exactly = 1e-13;

Matrix seeded_matrix(Index rows, Index columns, unsigned seed) {
  std::mt19937 random(seed);
  Matrix A(rows, columns);
  for (double& a : A.reshaped())
    a = static_cast<double>(random()) / static_cast<double>(std::mt19937::max()) - 0.5;
  return A;
}

/// Of rank r.
Matrix of_rank(Index rows, Index columns, Index r, unsigned seed) {
  return seeded_matrix(rows, r, seed) * seeded_matrix(r, columns, seed + 1);
}

double off_identity(const Matrix& Q) {
  return (Q.transpose() * Q - Matrix::Identity(Q.cols(), Q.cols())).norm();
}

TEST(Lu, SolvesForVectorsForMatricesAndTransposed) {
  const Matrix A = seeded_matrix(7, 7, 1), B = seeded_matrix(7, 3, 2);
  const Lu lu(A);
  EXPECT_LT((A * lu.solve(B) - B).norm(), exactly);
  EXPECT_LT((A * lu.solve(Vector(B.col(0))) - B.col(0)).norm(), exactly);
  EXPECT_LT((A.transpose() * lu.solve_transposed(B) - B).norm(), exactly);
  Vector x(7);
  lu.solve(B.col(1), x);
  EXPECT_LT((A * x - B.col(1)).norm(), exactly);
  EXPECT_LT((A * lu.inverse() - Matrix::Identity(7, 7)).norm(), 10 * exactly);
}

TEST(Lu, KnowsTheSignOfTheDeterminantWhereTheNumberItselfWouldOverflow) {
  const Vector d = Vector::Constant(200, 1e3);
  Matrix A = d.asDiagonal();
  EXPECT_EQ(Lu(A).sign(), 1);
  A.row(3).swap(A.row(90));
  EXPECT_EQ(Lu(A).sign(), -1);
  A.row(5) *= -1;
  EXPECT_EQ(Lu(A).sign(), 1);
}

TEST(SignedLeast, IsTheLeastSingularValueButForTheRootOfTheRows) {
  for (const Index rows : {3, 60}) {  // on the stack, and not
    const Matrix A = seeded_matrix(rows, rows, 3);
    const double least = jacobi_svd(A).values[rows - 1], size = std::abs(signed_least(A));
    EXPECT_LE(size, least * (1 + 1e-9)) << rows;
    EXPECT_GE(size, least / std::sqrt(static_cast<double>(rows))) << rows;
  }
}

TEST(SignedLeast, ChangesItsSignWithTheDeterminantAndIsZeroForSingularMatrices) {
  for (const Index rows : {3, 60}) {
    Matrix A = Matrix::Identity(rows, rows);
    EXPECT_GT(signed_least(A), 0);
    A(1, 1) = -1;
    EXPECT_LT(signed_least(A), 0);
    A(1, 1) = 0;
    EXPECT_EQ(signed_least(A), 0);
  }
  EXPECT_EQ(signed_least(Matrix{}), 0);
}

TEST(Lu, GivesDeterminantAndPivots) {
  Matrix A(2, 2);
  A << 0, 2, 4, 1;
  const Lu lu(A);
  EXPECT_DOUBLE_EQ(lu.determinant(), -8);
  EXPECT_DOUBLE_EQ(lu.smallest_pivot(), 2);
  EXPECT_DOUBLE_EQ(lu.largest_pivot(), 4);
  EXPECT_EQ(lu.sign(), -1);
}

TEST(FullPivotLu, TellsSingularMatricesFromRegularOnes) {
  EXPECT_FALSE(FullPivotLu(of_rank(5, 5, 4, 3)).is_invertible());
  const Matrix A = seeded_matrix(5, 5, 4), B = seeded_matrix(5, 2, 5);
  const FullPivotLu lu(A);
  ASSERT_TRUE(lu.is_invertible());
  EXPECT_LT((A * lu.solve(B) - B).norm(), exactly);
  EXPECT_LT((A * lu.inverse() - Matrix::Identity(5, 5)).norm(), 10 * exactly);
}

TEST(SingularValues, AreTheSameByBothMethodsAndBelongToTheirVectors) {
  for (const auto& [rows, columns] : {std::pair<Index, Index>{9, 9}, {12, 5}, {5, 12}, {40, 40}}) {
    const Matrix A = seeded_matrix(rows, columns, 6);
    const Svd jacobi = jacobi_svd(A, SingularVectors::thin, SingularVectors::thin);
    const Svd divided = divided_svd(A, SingularVectors::full, SingularVectors::full);
    EXPECT_LT((jacobi.values - divided.values).norm(), 100 * exactly);
    EXPECT_LT((jacobi.U * jacobi.values.asDiagonal() * jacobi.V.transpose() - A).norm(),
              100 * exactly);
    EXPECT_EQ(divided.U.cols(), rows);
    EXPECT_EQ(divided.V.cols(), columns);
    EXPECT_LT(off_identity(divided.U) + off_identity(divided.V), 100 * exactly);
  }
}

TEST(Svd, SolvesInTheLeastSquaresSenseWithTheSmallestNorm) {
  const Matrix A = of_rank(6, 5, 3, 7);
  const Vector b = seeded_matrix(6, 1, 8);
  const Svd svd = jacobi_svd(A, SingularVectors::thin, SingularVectors::thin);
  EXPECT_EQ(svd.rank, 3);
  const Vector x = svd.solve(b);
  EXPECT_LT((A.transpose() * (A * x - b)).norm(), 10 * exactly);
  EXPECT_LT((kernel_of(A, 1e-10).transpose() * x).norm(), 10 * exactly);
  EXPECT_LT((least_squares(A, b, 1e-10) - x).norm(), 1000 * exactly);
  EXPECT_LT((least_squares_of_columns(A, b) - x).norm(), 1000 * exactly);
}

TEST(SymmetricEigenvalues, AreAscendingAndReproduceTheMatrix) {
  const Matrix B = seeded_matrix(6, 6, 9), A = B + B.transpose();
  const SymmetricEigen eigen = symmetric_eigen(A);
  EXPECT_LT((eigen.vectors * eigen.values.asDiagonal() * eigen.vectors.transpose() - A).norm(),
            10 * exactly);
  EXPECT_TRUE(std::is_sorted(eigen.values.begin(), eigen.values.end()));
  EXPECT_LT((symmetric_eigenvalues(A) - eigen.values).norm(), 10 * exactly);
  EXPECT_LT((body_eigenvalues(A) - eigen.values).norm(), 10 * exactly);
}

TEST(EigenvaluesOfAPair, AreThoseOfTheProductWithTheInverse) {
  const Matrix M = seeded_matrix(5, 5, 13), A = M + M.transpose(),
               B = M * M.transpose() + Matrix::Identity(5, 5);
  const Vector values = eigenvalues_of_pair(A, B);
  EXPECT_TRUE(std::is_sorted(values.begin(), values.end()));
  for (const double value : values) EXPECT_LT(jacobi_svd(A - value * B).values[4], 100 * exactly);
}

TEST(Lu, EstimatesTheReciprocalCondition) {
  Matrix A = Matrix::Identity(3, 3);
  A(2, 2) = 1e-6;
  EXPECT_NEAR(Lu(A).reciprocal_condition(), 1e-6, 1e-12);
  A(2, 2) = 0;
  EXPECT_EQ(Lu(A).reciprocal_condition(), 0);
}

TEST(Eigenvalues, OfARotationLieOnTheUnitCircle) {
  Matrix R(2, 2);
  R << std::cos(0.3), -std::sin(0.3), std::sin(0.3), std::cos(0.3);
  for (const auto& value : eigenvalues(R)) {
    EXPECT_NEAR(value.real(), std::cos(0.3), exactly);
    EXPECT_NEAR(std::abs(value.imag()), std::sin(0.3), exactly);
  }
  EXPECT_NEAR(spectral_radius(2 * R), 2, exactly);
  EXPECT_EQ(spectral_radius(SmallMatrix(0, 0)), 0);
}

TEST(Orthonormal, ColumnsSpanTheColumnsAndTheBasisContinuesThem) {
  const Matrix A = seeded_matrix(7, 3, 10), Q = orthonormal_columns(A), all = orthonormal_basis(A);
  EXPECT_LT((A - Q * (Q.transpose() * A)).norm(), exactly);
  EXPECT_LT(off_identity(all), 10 * exactly);
  EXPECT_LT((all.rightCols(4).transpose() * A).norm(), exactly);
}

TEST(Rank, AndKernelFitTogether) {
  const Matrix A = of_rank(5, 8, 3, 11);
  EXPECT_EQ(rank_of(A, 1e-10), 3);
  const Matrix Z = kernel_of(A, 1e-10);
  EXPECT_EQ(Z.cols(), 5);
  EXPECT_LT((A * Z).norm(), exactly);
  EXPECT_LT(off_identity(Z), 10 * exactly);
  EXPECT_EQ(kernel_of(Matrix(0, 4)), Matrix::Identity(4, 4));
  EXPECT_EQ(rank_of(Matrix(0, 4)), 0);
}

TEST(PivotedQr, EndsWithWhatIsOrthogonalToAllColumns) {
  const Matrix A = seeded_matrix(6, 5, 12);
  const PivotedQr qr = pivoted_qr(A);
  EXPECT_EQ(qr.rank, 5);
  EXPECT_EQ(qr.pivots.size(), 5);
  EXPECT_NEAR(qr.last_column.norm(), 1, exactly);
  EXPECT_LT((A.transpose() * qr.last_column).norm(), exactly);
}

TEST(LeastSquares, AreUniqueOnlyWhereColumnsAreIndependent) {
  const Matrix right = seeded_matrix(6, 2, 13);
  EXPECT_FALSE(unique_least_squares(of_rank(6, 4, 3, 14), right, 1e-10));
  const Matrix A = seeded_matrix(6, 4, 15);
  const auto X = unique_least_squares(A, right, 1e-10);
  ASSERT_TRUE(X);
  EXPECT_LT((A.transpose() * (A * *X - right)).norm(), 10 * exactly);
  EXPECT_LT((fitted(A, right) - *X).norm(), 100 * exactly);
}

TEST(EmptyMatrices, HaveZerosAsSolutionsAndWholeSpacesAsKernels) {
  EXPECT_EQ(least_squares(Matrix(3, 0), Vector::Ones(3)).size(), 0);
  EXPECT_EQ(least_squares(Matrix(0, 2), Vector(0)), Vector(Vector::Zero(2)));
  const Svd svd = jacobi_svd(Matrix(0, 2), SingularVectors::full, SingularVectors::full);
  EXPECT_EQ(svd.values.size(), 0);
  EXPECT_EQ(svd.rank, 0);
  EXPECT_EQ(svd.V, Matrix(Matrix::Identity(2, 2)));
}

TEST(Definite, SystemsAreSolvedForVectorsAndMatrices) {
  const Matrix B = seeded_matrix(5, 5, 16), A = B * B.transpose() + Matrix::Identity(5, 5);
  const Matrix right = seeded_matrix(5, 2, 17);
  EXPECT_LT((A * solve_definite(A, right) - right).norm(), 10 * exactly);
  EXPECT_LT((A * solve_definite(A, Vector(right.col(0))) - right.col(0)).norm(), 10 * exactly);
}

}  // namespace
}  // namespace springfold
