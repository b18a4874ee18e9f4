#include "springfold/core/row_qr.hpp"

#include <gmock/gmock.h>

#include "random_matrices.hpp"
#include "springfold/core/decompositions.hpp"

namespace springfold {
namespace {

constexpr double to_rounding = 1e-12;

Matrix few_rows(Index rows, Index columns, unsigned seed) {
  std::mt19937_64 random(seed);
  Matrix A(rows, columns);
  for (double& a : A.reshaped()) a = static_cast<double>(random() >> 11) * 0x1p-52 - 1;
  return A;
}

class RowQrOfRandomRows : public testing::TestWithParam<std::pair<Index, Index>> {};

TEST_P(RowQrOfRandomRows, GivesTheShortestSolution) {
  const auto [m, n] = GetParam();
  const Matrix A = few_rows(m, n, 1);
  const Vector b = few_rows(m, 1, 2);
  const RowQr rows(A);
  ASSERT_TRUE(rows.independent());
  EXPECT_LT((rows.least_norm(b) - least_squares(A, b)).norm(),
            to_rounding * (1 + least_squares(A, b).norm()));
}

TEST_P(RowQrOfRandomRows, GivesTheMultipliersOfLeastSquares) {
  const auto [m, n] = GetParam();
  const Matrix A = few_rows(m, n, 3);
  const Vector g = few_rows(n, 1, 4);
  const Vector expected = least_squares(A.transpose(), g);
  EXPECT_LT((RowQr(A).multipliers(g) - expected).norm(), to_rounding * (1 + expected.norm()));
}

TEST_P(RowQrOfRandomRows, HasAnOrthonormalKernelThatTheRowsDoNotSee) {
  const auto [m, n] = GetParam();
  const Matrix A = few_rows(m, n, 5), Z = RowQr(A).kernel();
  EXPECT_EQ(Z.cols(), n - m);
  EXPECT_LT((A * Z).norm(), to_rounding);
  EXPECT_LT((Z.transpose() * Z - Matrix::Identity(n - m, n - m)).norm(), to_rounding);
}

INSTANTIATE_TEST_SUITE_P(Sizes, RowQrOfRandomRows,
                         testing::Values(std::pair<Index, Index>{1, 1},
                                         std::pair<Index, Index>{1, 4},
                                         std::pair<Index, Index>{4, 6},
                                         std::pair<Index, Index>{7, 7},
                                         std::pair<Index, Index>{11, 30}));

class RowQrOfDependentRows : public testing::TestWithParam<std::pair<Index, Index>> {
 protected:
  static constexpr Index columns = 12;
  Index rank = GetParam().first, dependent = GetParam().second;
  Matrix A = few_rows(rank + dependent, rank, 8) * few_rows(rank, columns, 9);
  RowQr rows{A, dependent};
};

TEST_P(RowQrOfDependentRows, HasOrthonormalRelationsBetweenThem) {
  ASSERT_TRUE(rows.independent());
  const Matrix N = rows.relations();
  ASSERT_EQ(N.cols(), dependent);
  EXPECT_LT((A.transpose() * N).norm(), to_rounding * A.norm());
  EXPECT_LT((N.transpose() * N - Matrix::Identity(dependent, dependent)).norm(), to_rounding);
}

TEST_P(RowQrOfDependentRows, GivesTheShortestSolutionOfWhatTheyCanGive) {
  const Vector b = A * few_rows(columns, 1, 10), x = rows.least_norm(b);
  EXPECT_LT((A * x - b).norm(), to_rounding * b.norm());
  EXPECT_LT((rows.kernel().transpose() * x).norm(), to_rounding * x.norm());
  EXPECT_LT((A * rows.kernel()).norm(), to_rounding * A.norm());
}

INSTANTIATE_TEST_SUITE_P(RanksAndRowsLeftOut, RowQrOfDependentRows,
                         testing::Values(std::pair<Index, Index>{1, 1},
                                         std::pair<Index, Index>{5, 1},
                                         std::pair<Index, Index>{7, 3},
                                         std::pair<Index, Index>{12, 2}));

TEST(RowQr, SaysWhereRowsDependOnEachOther) {
  Matrix A = few_rows(3, 6, 6);
  A.row(2) = A.row(0) - 2 * A.row(1);
  EXPECT_FALSE(RowQr(A).independent());
  EXPECT_FALSE(RowQr(Matrix::Zero(1, 3)).independent());
  EXPECT_FALSE(RowQr(few_rows(4, 3, 7)).independent());
}

TEST(RowQr, OfNoRowsSeesNothing) {
  const RowQr rows(Matrix(0, 3));
  ASSERT_TRUE(rows.independent());
  EXPECT_EQ(rows.kernel(), Matrix::Identity(3, 3));
  EXPECT_EQ(rows.least_norm(Vector(0)), Vector::Zero(3));
}

}  // namespace
}  // namespace springfold
