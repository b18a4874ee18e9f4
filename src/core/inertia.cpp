#include "springfold/core/inertia.hpp"

#include <lapacke.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>

#include "equal_sizes.hpp"
#include "springfold/core/equilibration.hpp"
#include "springfold/core/small_symmetric.hpp"

namespace springfold {
namespace {

/// S A S = L D L^T with 1x1 and 2x2 blocks in D; LAPACK's packing of it. S brings rows to one size.
struct Factorisation {
  Matrix LD{};
  std::vector<lapack_int> pivots{};
  Vector S{};
};

/// Are all rows of nearly one size already? Most matrices are, and then nothing is gained by scaling.
bool rows_are_alike(const Eigen::Ref<const Matrix>& A) {
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  for (Index i = 0; i < A.rows(); ++i) {
    double size = 0;
    for (Index j = 0; j < A.cols(); ++j)
      size = std::max(size, std::abs(j <= i ? A(i, j) : A(j, i)));
    smallest = std::min(smallest, size);
    largest = std::max(largest, size);
  }
  return smallest * equal_sizes::alike >= largest && smallest > 0;
}

std::optional<Factorisation> factorise(const Eigen::Ref<const Matrix>& A) {
  assert(A.rows() == A.cols());
  if (!A.allFinite()) return std::nullopt;
  Factorisation f{A, std::vector<lapack_int>(static_cast<std::size_t>(A.rows())),
                  Vector::Ones(A.rows())};
  if (!rows_are_alike(A)) {
    f.S = equilibrate(Matrix(A.selfadjointView<Eigen::Lower>())).rows;
    f.LD = f.S.asDiagonal() * A * f.S.asDiagonal();
  }
  const auto n = static_cast<lapack_int>(A.rows());
  // A positive return value means an exactly zero pivot: harmless here, D is still right.
  Vector work(A.rows());
  LAPACKE_dsytrf_work(LAPACK_COL_MAJOR, 'L', n, f.LD.data(), n, f.pivots.data(), work.data(), n);
  return f;
}

/// Eigenvalues of the diagonal blocks of D.
std::vector<double> pivot_eigenvalues(const Factorisation& f) {
  std::vector<double> values;
  const Index n = f.LD.rows();
  for (Index i = 0; i < n;) {
    if (f.pivots[static_cast<std::size_t>(i)] > 0) {
      values.push_back(f.LD(i, i));
      i += 1;
      continue;
    }
    const double a = f.LD(i, i), b = f.LD(i + 1, i), c = f.LD(i + 1, i + 1);
    const double mean = a / 2 + c / 2, radius = std::hypot(a / 2 - c / 2, b);
    const double large = mean >= 0 ? mean + radius : mean - radius;
    // The smaller one from the determinant, without cancellation.
    values.push_back(large);
    values.push_back(large == 0 ? 0 : (a / large) * c - (b / large) * b);
    i += 2;
  }
  return values;
}

Inertia counted(std::span<const double> values, double zero_tolerance) {
  double largest = 0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  Inertia inertia;
  for (const double v : values) {
    if (std::abs(v) <= zero_tolerance * largest)
      ++inertia.zero;
    else
      ++(v < 0 ? inertia.negative : inertia.positive);
  }
  return inertia;
}

Inertia counted(const SmallSymmetric& factors, double zero_tolerance) {
  std::array<double, static_cast<std::size_t>(SmallSymmetric::largest)> values;
  factors.pivot_values(values.data());
  return counted(std::span(values).first(static_cast<std::size_t>(factors.size())), zero_tolerance);
}

}  // namespace

std::optional<Inertia> inertia_of(const Eigen::Ref<const Matrix>& A, double zero_tolerance) {
  if (A.rows() <= SmallSymmetric::largest) {
    SmallSymmetric small;
    if (!small.factorise(A)) return std::nullopt;
    return counted(small, zero_tolerance);
  }
  const auto f = factorise(A);
  if (!f) return std::nullopt;
  return counted(pivot_eigenvalues(*f), zero_tolerance);
}

std::optional<SymmetricSolution> solve_and_count(const Eigen::Ref<const Matrix>& A,
                                                 const Eigen::Ref<const Matrix>& B) {
  assert(A.rows() == B.rows());
  constexpr double singular = 1e-13;
  if (!B.allFinite()) return std::nullopt;
  SymmetricSolution result{B, {}};
  if (A.rows() <= SmallSymmetric::largest) {
    SmallSymmetric small;
    if (!small.factorise(A)) return std::nullopt;
    result.inertia = counted(small, singular);
    if (result.inertia.zero > 0) return std::nullopt;
    small.solve(result.X);
    return result;
  }
  const auto f = factorise(A);
  if (!f) return std::nullopt;
  result.inertia = counted(pivot_eigenvalues(*f), singular);
  if (result.inertia.zero > 0) return std::nullopt;
  result.X.array().colwise() *= f->S.array();
  const auto n = static_cast<lapack_int>(A.rows());
  LAPACKE_dsytrs_work(LAPACK_COL_MAJOR, 'L', n, static_cast<lapack_int>(B.cols()), f->LD.data(), n,
                      f->pivots.data(), result.X.data(), n);
  result.X.array().colwise() *= f->S.array();
  return result;
}

std::optional<Matrix> solve_symmetric(const Eigen::Ref<const Matrix>& A,
                                      const Eigen::Ref<const Matrix>& B) {
  auto solution = solve_and_count(A, B);
  if (!solution) return std::nullopt;
  return std::move(solution->X);
}

}  // namespace springfold
