#include "springfold/core/extended_matrix.hpp"

#include <algorithm>
#include <cmath>

#include "springfold/core/arnoldi.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/rounding.hpp"
#include "springfold/core/sampling.hpp"

namespace springfold {
namespace {

/// Jacobi's method is the more accurate one; on larger matrices it takes too long.
constexpr Index jacobi_size = 32;

/// Steps of inverse iteration for singular vectors.
constexpr Index most_steps = 16;

/// A singular value that changes by less, of itself, in a step of inverse iteration has some digits.
constexpr double few_digits = 1e-3;

/// Singular vectors that move by less have settled.
constexpr double vectors_settled = 1e-12;

/// Steps up to there cost less than a decomposition.
constexpr Index most_cheap_steps = 64;

/// All columns of a structured E by a function of columns of dF/dx.
template <class Columns>
Matrix by_columns(const ExtendedMatrix& E, const Matrix& X, bool sizes, Columns columns) {
  const Index n = E.at.dF_dlambda.size();
  Matrix Y(E.rows(), X.cols());
  for (Index c = 0; c < X.cols(); ++c) {
    const double last = X(n, c);
    Y.col(c).head(n) = columns(X.col(c).head(n));
    Y.col(c).head(n) += last * E.at.dF_dlambda;
    if (!E.has_last) continue;
    Y(n, c) = (sizes ? Vector(E.row.cwiseAbs()) : E.row).dot(X.col(c).head(n)) +
              (sizes ? std::abs(E.corner) : E.corner) * last;
  }
  return Y;
}

/// The borders of E as borders of dF/dx,
///
///     | dF/dx    dF/dlambda  B_x |
///     | row^T    corner      B_l |      (where E has a last row)
///     | C_x^T    C_l^T       0   |
FrontalBorders borders_of_jacobian(const ExtendedMatrix& E, const Borders& borders) {
  const Index n = E.at.dF_dlambda.size(), last = E.has_last ? 1 : 0;
  const Index left = borders.B.cols(), right = borders.C.cols();
  FrontalBorders all{Matrix(n, 1 + left), Matrix(n, last + right),
                     Matrix::Zero(last + right, 1 + left)};
  all.B.col(0) = E.at.dF_dlambda;
  if (E.has_last) all.C.col(0) = E.row;
  if (E.has_last) all.D(0, 0) = E.corner;
  if (right == 0) return all;
  all.B.rightCols(left) = borders.B.topRows(n);
  all.C.rightCols(right) = borders.C.topRows(n);
  if (E.has_last) all.D.topRightCorner(1, left) = borders.B.bottomRows(1);
  all.D.bottomLeftCorner(right, 1) = borders.C.bottomRows(1).transpose();
  return all;
}

struct LeastVectors {
  Borders borders{};
  Vector values{};  ///< ascending
};

LeastVectors least_vectors(const ExtendedMatrix& E, Index m) {
  LeastVectors result;
  Borders& borders = result.borders;
  kernel_borders(E, m, borders);
  const Matrix image = product(E, borders.C);
  const Svd svd =
      jacobi_svd(borders.B.transpose() * image, SingularVectors::full, SingularVectors::full);
  borders = {borders.B * svd.U, borders.C * svd.V};
  result.values = jacobi_svd(image).values.reverse();
  return result;
}

/// Of the eigenvalues, descending.
std::vector<double> magnitudes_of(const Matrix& M) {
  std::vector<double> values;
  for (const auto& value : eigenvalues(M)) values.push_back(std::abs(value));
  std::sort(values.begin(), values.end(), std::greater<>());
  return values;
}

}  // namespace

Matrix orthonormal(const Matrix& columns) { return orthonormal_columns(columns); }

Matrix irregular_columns(Index rows, Index columns) {
  Matrix X(rows, columns);
  for (Index c = 0; c < columns; ++c)
    for (Index r = 0; r < rows; ++r) X(r, c) = irregular(r, c);
  return orthonormal(X);
}

Matrix unit_rows_below(Index rows, Index columns) {
  Matrix X = Matrix::Zero(rows, columns);
  X.bottomRows(columns).setIdentity();
  return X;
}

ExtendedMatrix extended_matrix(const Linearisation& at, const Vector& weights,
                               const Direction& tau) {
  ExtendedMatrix E;
  if (at.structured) {
    E.at = at;
    E.row = weights.cwiseProduct(tau.dx);
    E.corner = tau.dlambda;
    return E;
  }
  const Index n = at.dF_dx.rows();
  E.dense.resize(n + 1, n + 1);
  E.dense << at.dF_dx, at.dF_dlambda, (weights.array() * tau.dx.array()).matrix().transpose(),
      tau.dlambda;
  return E;
}

Matrix product(const ExtendedMatrix& E, const Matrix& X) {
  if (!E.at.structured) return E.dense * X;
  return by_columns(E, X, false, [&](const Vector& v) { return product(*E.at.structured, v); });
}

Matrix magnitudes(const ExtendedMatrix& E, const Matrix& X) {
  if (!E.at.structured) return E.dense.cwiseAbs() * X.cwiseAbs();
  ExtendedMatrix sizes = E;
  sizes.at.dF_dlambda = E.at.dF_dlambda.cwiseAbs();
  return by_columns(sizes, X.cwiseAbs(), true,
                    [&](const Vector& v) { return magnitudes(*E.at.structured, v); });
}

Matrix bordered(const Matrix& A, const Borders& borders) {
  const Index left = borders.B.cols(), right = borders.C.cols();
  Matrix M = Matrix::Zero(A.rows() + right, A.cols() + left);
  M.topLeftCorner(A.rows(), A.cols()) = A;
  if (left > 0) M.topRightCorner(A.rows(), left) = borders.B;
  if (right > 0) M.bottomLeftCorner(right, A.cols()) = borders.C.transpose();
  return M;
}

BorderedMatrix::BorderedMatrix(const ExtendedMatrix& E, const Borders& borders)
    : structured_{E.at.structured} {
  if (structured_) {
    borders_ = borders_of_jacobian(E, borders);
    return;
  }
  lu_.compute(bordered(E.dense, borders));
}

std::optional<Matrix> BorderedMatrix::solve(const Matrix& right, bool transposed) const {
  Matrix X;
  if (structured_) {
    X = right;
    if (!structured_->solve(borders_, X, transposed)) return std::nullopt;
    return X;
  }
  X = transposed ? lu_.solve_transposed(right) : lu_.solve(right);
  if (!X.allFinite()) return std::nullopt;
  return X;
}

std::optional<Matrix> solve_with(const ExtendedMatrix& E, const Borders& borders,
                                 const Matrix& right, bool transposed) {
  return BorderedMatrix(E, borders).solve(right, transposed);
}

bool kernel_borders(const ExtendedMatrix& E, Index m, Borders& borders) {
  const Index k = m + E.columns() - E.rows();
  borders = {irregular_columns(E.rows(), m), irregular_columns(E.columns(), k)};
  const Matrix right = unit_rows_below(E.rows() + k, k), left = unit_rows_below(E.columns() + m, m);
  for (Index step = 0; step < most_steps; ++step) {
    const BorderedMatrix M(E, borders);
    const auto V = M.solve(right), W = M.solve(left, true);
    if (!V || !W || !V->allFinite() || !W->allFinite()) return false;
    const Matrix C = orthonormal(V->topRows(E.columns())), B = orthonormal(W->topRows(E.rows()));
    const double moved = (C - borders.C * (borders.C.transpose() * C)).norm() +
                         (B - borders.B * (borders.B.transpose() * B)).norm();
    borders = {B, C};
    if (moved < vectors_settled) break;
  }
  return true;
}

Borders borders_of(const ExtendedMatrix& E, Index m) {
  if (E.at.structured) return least_vectors(E, m).borders;
  const auto decompose = E.rows() <= jacobi_size ? jacobi_svd : divided_svd;
  const Svd svd = decompose(E.dense, SingularVectors::full, SingularVectors::full);
  return {svd.U.rightCols(m), svd.V.rightCols(m)};
}

Borders weakest_borders(const ExtendedMatrix& E) {
  if (E.at.structured) return borders_of(E, 1);
  const Lu lu(E.dense);
  Matrix u, v = irregular_columns(E.rows(), 1);
  double last = 0;
  for (Index step = 0; step < most_cheap_steps; ++step) {
    u = lu.solve_transposed(v).normalized();
    v = lu.solve(u);
    const double size = v.norm();                    // of the inverse, in the direction u
    if (!(size > 0) || !std::isfinite(size)) break;  // exactly singular
    v /= size;
    // Where several singular values are about as small, no direction among theirs is weaker than the others.
    if (std::abs(size - last) <= few_digits * size) return {u, v};
    last = size;
  }
  return borders_of(E, 1);
}

Vector singular_values(const Matrix& M) {
  return M.rows() <= jacobi_size ? jacobi_svd(M).values : divided_svd(M).values;
}

Vector least_singular_values(const ExtendedMatrix& E, Index m) {
  if (E.at.structured) return least_vectors(E, m).values;
  return singular_values(E.dense).tail(m).reverse();
}

std::vector<double> relative_motion(const ExtendedMatrix& E, const ExtendedMatrix& E0,
                                    const ExtendedMatrix& E1) {
  Matrix small;  // the map itself, or what Arnoldi's basis sees of it
  if (!E.at.structured) {
    small = Lu(E.dense).solve(E1.dense - E0.dense);
  } else {
    Arnoldi arnoldi;
    arnoldi.begin(E.rows());
    do {
      const Matrix v = arnoldi.newest();
      const auto image = solve_with(E, {}, product(E1, v) - product(E0, v));
      if (!image) return {infinity};
      arnoldi.image() = image->col(0);
    } while (arnoldi.add());
    small = arnoldi.map();
  }
  return small.allFinite() ? magnitudes_of(small) : std::vector<double>{infinity};
}

}  // namespace springfold
