#include "springfold/core/equilibration.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "equal_sizes.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/scaling.hpp"

namespace springfold {
namespace {

double median_of(Vector values) {
  const Index middle = values.size() / 2;
  std::nth_element(values.begin(), values.begin() + middle, values.end());
  return values[middle];
}

/// Largest entries of rows or columns; where they are nothing but rounding: zero.
Vector sizes_of(const Vector& largest) {
  if (largest.size() == 0) return largest;
  const double floor = equal_sizes::rounding * median_of(largest);
  return (largest.array() > floor).select(largest, 0);
}

}  // namespace

Equilibration equilibrate(const Matrix& A) {
  Equilibration scale{Vector::Ones(A.rows()), Vector::Ones(A.cols())};
  if (A.size() == 0 || !A.allFinite()) return scale;
  Matrix B = A.cwiseAbs();
  const Vector rows = sizes_of(B.rowwise().maxCoeff());
  const Vector columns = sizes_of(B.colwise().maxCoeff().transpose());
  for (int pass = 0; pass < equal_sizes::passes; ++pass) {
    const auto factors = [](const Vector& first, const Vector& largest) {
      Vector f(largest.size());
      for (Index i = 0; i < f.size(); ++i)
        f[i] = first[i] > 0 && largest[i] > 0 ? 1 / power_of_two_near(std::sqrt(largest[i])) : 1;
      return f;
    };
    const Vector r = factors(rows, B.rowwise().maxCoeff());
    const Vector c = factors(columns, B.colwise().maxCoeff().transpose());
    if ((r.array() == 1).all() && (c.array() == 1).all()) break;
    B = r.asDiagonal() * B * c.asDiagonal();
    scale.rows.array() *= r.array();
    scale.columns.array() *= c.array();
  }
  return scale;
}

Vector row_sizes_of(const Matrix& A) {
  if (A.size() == 0) return Vector::Zero(A.rows());
  return sizes_of(A.cwiseAbs().rowwise().maxCoeff());
}

Matrix null_directions(const Matrix& A) {
  assert(A.rows() == A.cols());
  if (A.size() == 0 || !A.allFinite()) return Matrix(A.rows(), 0);
  const Equilibration scale = equilibrate(A);
  const Svd svd = divided_svd(scale.rows.asDiagonal() * A * scale.columns.asDiagonal(),
                              SingularVectors::none, SingularVectors::full);
  const Vector& values = svd.values;
  constexpr double zero = 1e-13, gap = 1e3;
  for (Index i = 0; i < values.size(); ++i) {
    const double above = i > 0 ? values[i - 1] : 1;
    if (values[i] <= zero && values[i] * gap <= above) return svd.V.rightCols(A.rows() - i);
  }
  return Matrix(A.rows(), 0);
}

Index corank(const Matrix& A) {
  if (!A.allFinite()) return A.rows();
  return null_directions(A).cols();
}

}  // namespace springfold
