// Frontal factorisation with borders, against dense eigenvalues and its own residuals.
#include "springfold/core/frontal.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <random>

#include "core/random_matrices.hpp"

namespace springfold {
namespace {

/// A pattern and numbers for it.
struct Sample {
  FrontalPattern pattern{};
  std::vector<double> values{};
  Matrix root{};

  /// A as one matrix.
  Matrix dense() const {
    Matrix A = Matrix::Zero(pattern.size, pattern.size);
    for (std::size_t f = 0; f < pattern.front_count(); ++f) {
      const Index* ids = pattern.variables.data() + pattern.first_variable[f];
      const auto m = static_cast<Index>(pattern.first_variable[f + 1] - pattern.first_variable[f]);
      for (Index c = 0; c < m; ++c)
        for (Index r = c; r < m; ++r) {
          const double v = values[pattern.first_value[f] + static_cast<std::size_t>(c * m + r)];
          A(ids[r], ids[c]) += v;
          if (r != c) A(ids[c], ids[r]) += v;
        }
    }
    const Index t = pattern.root_first, k = pattern.root_count;
    if (k > 0) A.block(t, t, k, k) += root;
    return A;
  }
  void add(const std::vector<Index>& variables, const Matrix& element, bool ends = false) {
    add_front(pattern, variables, ends);
    values.insert(values.end(), element.data(), element.data() + element.size());
  }
  Frontal factorised(const FrontalBorders& borders = {}) const {
    Frontal frontal(pattern);
    EXPECT_TRUE(frontal.factorise(values, root, borders));
    return frontal;
  }
};

FrontalBorders random_borders(std::mt19937& random, Index n, Index k) {
  return {random_matrix(random, n, k), random_matrix(random, n, k), random_matrix(random, k, k)};
}

/// Strings of fronts that overlap, with a root; every element is random and so indefinite.
Sample random_strings(std::mt19937& random, int strings, int fronts, Index root_count) {
  std::uniform_int_distribution<Index> few(1, 3);
  Sample sample;
  sample.pattern.root_count = root_count;
  Index next = root_count;
  for (int s = 0; s < strings; ++s) {
    std::vector<Index> overlap;
    for (int f = 0; f < fronts; ++f) {
      std::vector<Index> variables = overlap;
      overlap.clear();
      for (Index i = few(random) + 2; i-- > 0; ++next) {
        variables.push_back(next);
        if (i < 2) overlap.push_back(next);
      }
      if (f % 3 == 0)
        for (Index i = 0; i < root_count; ++i) variables.push_back(i);
      std::shuffle(variables.begin(), variables.end(), random);
      const auto n = static_cast<Index>(variables.size());
      sample.add(variables, random_symmetric(random, n), f + 1 == fronts);
    }
  }
  sample.pattern.size = next;
  sample.root = random_matrix(random, root_count, root_count);
  return sample;
}

Matrix with_borders(const Matrix& A, const FrontalBorders& borders) {
  const Index n = A.rows(), k = borders.B.cols();
  Matrix M(n + k, n + k);
  if (k == 0) return A;
  M << A, borders.B, borders.C.transpose(), borders.D;
  return M;
}

/// Backward error of solutions: |M X - R| against |M| |X|.
double residual_of(const Matrix& M, const Matrix& X, const Matrix& R) {
  const double sizes = M.cwiseAbs().rowwise().sum().maxCoeff() * X.cwiseAbs().maxCoeff();
  return (M * X - R).cwiseAbs().maxCoeff() / (sizes + R.cwiseAbs().maxCoeff());
}

void expect_solved(const Sample& sample, const FrontalBorders& borders, Frontal& frontal) {
  const Matrix M = with_borders(sample.dense(), borders);
  std::mt19937 random(5);
  const Matrix R = random_matrix(random, M.rows(), 3);
  Matrix X = R;
  ASSERT_TRUE(frontal.solve(X));
  EXPECT_LT(residual_of(M, X, R), 1e-13);
  X = R;
  ASSERT_TRUE(frontal.solve_transposed(X));
  EXPECT_LT(residual_of(M.transpose(), X, R), 1e-13);
}

Inertia dense_inertia(const Matrix& A) {
  const Matrix half = 0.5 * (A + A.transpose());
  const Vector values =
      Eigen::SelfAdjointEigenSolver<Matrix>(half, Eigen::EigenvaluesOnly).eigenvalues();
  const double small = 1e-12 * values.cwiseAbs().maxCoeff();
  Inertia inertia;
  for (const double v : values)
    ++(std::abs(v) < small ? inertia.zero : v < 0 ? inertia.negative : inertia.positive);
  return inertia;
}

TEST(Frontal, RandomStringsAreSolvedToRoundingAndTheirEigenvaluesCounted) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 60; ++trial) {
    const Sample sample = random_strings(random, 1 + trial % 3, 1 + trial % 7, trial % 4);
    const FrontalBorders borders = random_borders(random, sample.pattern.size, trial % 3);
    Frontal frontal = sample.factorised(borders);
    expect_solved(sample, borders, frontal);
    EXPECT_EQ(frontal.inertia(), dense_inertia(sample.dense())) << trial;
  }
}

TEST(Frontal, ThousandsOfFrontsStayAccurateAndSmall) {
  std::mt19937 random(2);
  const Sample sample = random_strings(random, 1, 3000, 1);
  const FrontalBorders borders = random_borders(random, sample.pattern.size, 2);
  Frontal frontal = sample.factorised(borders);
  const Matrix R = random_matrix(random, sample.pattern.size + 2, 2);
  Matrix X = R;
  ASSERT_TRUE(frontal.solve(X));
  const Matrix miss = product(sample.pattern, sample.values, sample.root, borders, X) - R;
  EXPECT_LT(miss.cwiseAbs().maxCoeff(), 1e-13 * 20 * X.cwiseAbs().maxCoeff());
  EXPECT_LT(frontal.largest_front(), 40);
}

TEST(Frontal, ProductIsThatOfTheMatrix) {
  std::mt19937 random(3);
  const Sample sample = random_strings(random, 2, 4, 2);
  const FrontalBorders borders = random_borders(random, sample.pattern.size, 2);
  const Matrix X = random_matrix(random, sample.pattern.size + 2, 2);
  const Matrix Y = product(sample.pattern, sample.values, sample.root, borders, X);
  EXPECT_LT((Y - with_borders(sample.dense(), borders) * X).cwiseAbs().maxCoeff(), 1e-13);
}

/// -u'' = mu u: the tridiagonal matrix tridiag(-1, 2 - mu, -1), a front per pair.
Sample second_differences(Index n, double mu) {
  Sample sample;
  sample.pattern.size = n;
  for (Index i = 0; i + 1 < n; ++i) {
    Matrix element = Matrix::Zero(2, 2);
    element(0, 0) = 2 - mu;
    element(1, 0) = -1;
    if (i + 2 == n) element(1, 1) = 2 - mu;
    sample.add({i, i + 1}, element, i + 2 == n);
  }
  return sample;
}

double eigenvalue(Index j, Index n) {
  return 2 - 2 * std::cos(static_cast<double>(j) * std::numbers::pi / static_cast<double>(n + 1));
}

TEST(Frontal, SecondDifferencesHaveAsManyNegativeEigenvaluesAsTheirFormulaSays) {
  for (const Index n : {2, 5, 40, 1000})
    for (const Index j : {Index{1}, n / 2, n - 1}) {
      const double mu = 0.5 * (eigenvalue(j, n) + eigenvalue(j + 1, n));
      Frontal frontal = second_differences(n, mu).factorised();
      EXPECT_EQ(frontal.inertia(), (Inertia{j, 0, n - j})) << n << " " << j;
    }
}

TEST(Frontal, ASingularMatrixIsSolvedWithItsBorders) {
  const Index n = 200;
  const Sample sample = second_differences(n, eigenvalue(3, n));
  Frontal alone = sample.factorised();
  EXPECT_EQ(alone.inertia(1e-9), (Inertia{2, 1, n - 3}));
  Vector null(n);
  for (Index i = 0; i < n; ++i)
    null[i] =
        std::sin(3 * std::numbers::pi * static_cast<double>(i + 1) / static_cast<double>(n + 1));
  const FrontalBorders borders{null, null, Matrix::Zero(1, 1)};
  Frontal frontal = sample.factorised(borders);
  expect_solved(sample, borders, frontal);
  Matrix X = Vector::Unit(n + 1, n);
  ASSERT_TRUE(frontal.solve(X));
  EXPECT_NEAR(X(n, 0), 0, 1e-14);  // Govaerts' test function vanishes at the eigenvalue
  EXPECT_LT((X.topRows(n) - null / null.squaredNorm()).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(Frontal, ZeroRowsHeldByBordersAloneWaitForTheRoot) {
  // A variable in the middle has nothing but 1e-17 on its diagonal; only a border reaches it.
  std::mt19937 random(6);
  for (const double tiny : {0.0, 1e-17, -1e-9}) {
    Sample sample = second_differences(30, 0.1);
    sample.pattern.size = 31;
    Sample with;
    with.pattern.size = 31;
    for (std::size_t f = 0; f < sample.pattern.front_count(); ++f) {
      const auto i = static_cast<Index>(f);
      Matrix element = Matrix::Zero(3, 3);
      element.topLeftCorner(2, 2) = Eigen::Map<Matrix>(sample.values.data() + 4 * f, 2, 2);
      if (f == 7) element(2, 2) = tiny;
      if (f == 7)
        with.add({i, i + 1, 30}, element);
      else
        with.add({i, i + 1}, element.topLeftCorner(2, 2), f == 28);
    }
    FrontalBorders borders = random_borders(random, 31, 1);
    borders.D(0, 0) = 0.3;
    Frontal frontal = with.factorised(borders);
    EXPECT_EQ(frontal.waiting(), 1);
    expect_solved(with, borders, frontal);
    // The exact solution of the middle: eliminate it by hand, | M x = r | known x.
    const Matrix M = with_borders(with.dense(), borders);
    const Vector x = random_matrix(random, 32, 1);
    Matrix X = M * x;
    ASSERT_TRUE(frontal.solve(X));
    EXPECT_LT((X - x).cwiseAbs().maxCoeff(), 1e-11);
  }
}

TEST(Frontal, SmallPivotsThatABorderFeelsDoNotSwampTheRoot) {
  // diag(1, ..., delta, ..., 1) with dense borders: accepted, delta would cost 1/delta digits.
  const Index n = 20;
  Sample sample;
  sample.pattern.size = n;
  for (Index i = 0; i < n; ++i)
    sample.add({i}, Matrix::Constant(1, 1, i == 5 ? 1e-5 : 1.0), i + 1 == n);
  std::mt19937 random(7);
  const FrontalBorders borders = random_borders(random, n, 2);
  Frontal frontal = sample.factorised(borders);
  EXPECT_EQ(frontal.waiting(), 1);
  const Matrix M = with_borders(sample.dense(), borders);
  const Matrix x = random_matrix(random, n + 2, 1);
  Matrix X = M * x;
  ASSERT_TRUE(frontal.solve(X));
  EXPECT_LT((X - x).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Frontal, SaddlePointsWithZeroDiagonalsNeedNoPivotOfOne) {
  // | 0  B |  along a string: every variable has a zero diagonal.
  // | B' 0 |
  std::mt19937 random(8);
  Sample sample;
  const Index n = 60;
  sample.pattern.size = 2 * n;
  for (Index i = 0; i < n; ++i) {
    std::vector<Index> variables{2 * i, 2 * i + 1};
    if (i + 1 < n) variables.push_back(2 * i + 2);
    Matrix element =
        Matrix::Zero(static_cast<Index>(variables.size()), static_cast<Index>(variables.size()));
    element(1, 0) = i % 3 == 0 ? 0.02 : 1;  // weaker than the coupling to the next
    if (i + 1 < n) element(2, 1) = 0.5 * random_matrix(random, 1, 1)(0, 0);
    sample.add(variables, element, i + 1 == n);
  }
  Frontal frontal = sample.factorised();
  expect_solved(sample, {}, frontal);
  EXPECT_EQ(frontal.inertia(), (Inertia{n, 0, n}));
}

TEST(Frontal, OtherBordersNeedNoNewFactorisation) {
  std::mt19937 random(9);
  const Sample sample = random_strings(random, 2, 5, 2);
  Frontal frontal = sample.factorised(random_borders(random, sample.pattern.size, 1));
  const FrontalBorders borders = random_borders(random, sample.pattern.size, 3);
  ASSERT_TRUE(frontal.set_borders(borders));
  EXPECT_LT(frontal.border_growth(), 1e3);
  expect_solved(sample, borders, frontal);
}

TEST(Frontal, BordersOfAnySizeLeaveTheSolutionAlone) {
  std::mt19937 random(10);
  const Sample sample = random_strings(random, 1, 6, 1);
  const Index n = sample.pattern.size;
  const FrontalBorders borders = random_borders(random, n, 1);
  const FrontalBorders large{0x1p60 * borders.B, 0x1p-40 * borders.C, 0x1p20 * borders.D};
  Matrix X = random_matrix(random, n + 1, 1), Y = X;
  Y(n, 0) *= 0x1p-40;
  ASSERT_TRUE(sample.factorised(borders).solve(X));
  ASSERT_TRUE(sample.factorised(large).solve(Y));
  Y(n, 0) *= 0x1p60;
  EXPECT_EQ(X, Y);
}

TEST(Frontal, ABorderOfNothingButRoundingLeavesTheCornerToDecide) {
  std::mt19937 random(21);
  const Sample sample = random_strings(random, 1, 6, 1);
  const Index n = sample.pattern.size;
  FrontalBorders borders = random_borders(random, n, 1);
  borders.C *= 1e-17;
  borders.D(0, 0) = 1;
  Frontal frontal = sample.factorised(borders);
  expect_solved(sample, borders, frontal);
}

TEST(Frontal, UnsymmetricRootsAreSolvedBothWays) {
  std::mt19937 random(11);
  Sample sample = random_strings(random, 2, 3, 3);
  sample.root(0, 2) += 5;
  const FrontalBorders borders = random_borders(random, sample.pattern.size, 1);
  Frontal frontal = sample.factorised(borders);
  expect_solved(sample, borders, frontal);
}

TEST(Frontal, ManySingularFrontsAreCountedNotDividedBy) {
  // Every front holds a variable of rank zero: coupled to its neighbour with the same row twice.
  Sample sample;
  const Index n = 12;
  sample.pattern.size = 2 * n;
  for (Index i = 0; i < n; ++i) sample.add({2 * i, 2 * i + 1}, Matrix::Ones(2, 2), i + 1 == n);
  Frontal frontal = sample.factorised();
  EXPECT_EQ(frontal.inertia(), (Inertia{0, n, n}));
  EXPECT_EQ(frontal.waiting(), n);
}

TEST(Frontal, ASingularMatrixIsNotSolved) {
  Sample sample;
  sample.pattern.size = 3;
  sample.add({0, 1, 2}, Matrix::Ones(3, 3), true);
  Frontal frontal = sample.factorised();
  Matrix X = Matrix::Ones(3, 1);
  EXPECT_FALSE(frontal.solve(X));
  EXPECT_EQ(frontal.inertia(), (Inertia{0, 2, 1}));
}

TEST(Frontal, NumbersThatAreNotFiniteAreRefused) {
  for (const Index n : {5, 20000}) {  // and do not make the fronts grow
    Sample sample = second_differences(n, 0.1);
    sample.values[4] = std::nan("");
    Frontal frontal(sample.pattern);
    EXPECT_FALSE(frontal.factorise(sample.values, {}));
    EXPECT_LT(frontal.largest_front(), 50);
  }
}

}  // namespace
}  // namespace springfold
