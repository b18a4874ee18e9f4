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

/// Singular vectors that are off by so much give their singular value with the square of it as error.
constexpr double few_digits = 1e-6;

/// Singular vectors that move by less have settled.
constexpr double settled = 1e-12;

/// Steps up to there cost less than a decomposition.
constexpr Index most_cheap_steps = 64;

/// All columns of a structured E by a function of columns of dF/dx.
template <class Columns>
Matrix by_columns(const ExtendedMatrix& E, const Matrix& X, bool sizes, Columns columns) {
  const Index n = E.row.size();
  Matrix Y(n + 1, X.cols());
  for (Index c = 0; c < X.cols(); ++c) {
    const double last = X(n, c);
    Y.col(c).head(n) = columns(X.col(c).head(n));
    Y.col(c).head(n) += last * E.at.dF_dlambda;
    Y(n, c) = (sizes ? Vector(E.row.cwiseAbs()) : E.row).dot(X.col(c).head(n)) +
              (sizes ? std::abs(E.corner) : E.corner) * last;
  }
  return Y;
}

/// The borders of E as borders of dF/dx,
///
///     | dF/dx    dF/dlambda  B_x |
///     | row^T    corner      B_l |
///     | C_x^T    C_l^T       0   |
FrontalBorders borders_of_jacobian(const ExtendedMatrix& E, const Borders& borders) {
  const Index n = E.row.size(), m = borders.B.cols();
  FrontalBorders all{Matrix(n, m + 1), Matrix(n, m + 1), Matrix::Zero(m + 1, m + 1)};
  all.B.col(0) = E.at.dF_dlambda;
  all.C.col(0) = E.row;
  all.D(0, 0) = E.corner;
  if (m == 0) return all;
  all.B.rightCols(m) = borders.B.topRows(n);
  all.C.rightCols(m) = borders.C.topRows(n);
  all.D.block(0, 1, 1, m) = borders.B.bottomRows(1);
  all.D.block(1, 0, m, 1) = borders.C.bottomRows(1).transpose();
  return all;
}

/// Singular vectors by inverse iteration: with M = | E B; C^T 0 |, which is regular also where E is not,
/// M^-1 | 0; I | holds better right vectors than C, and M^-T | 0; I | better left ones than B.
struct LeastVectors {
  Borders borders{};
  Vector values{};  ///< ascending
};

LeastVectors least_vectors(const ExtendedMatrix& E, Index m) {
  const Index n = E.rows();
  LeastVectors result{{irregular_columns(n, m), irregular_columns(n, m)}, Vector::Zero(m)};
  Borders& borders = result.borders;
  Matrix right = Matrix::Zero(n + m, m);
  right.bottomRows(m).setIdentity();
  for (Index step = 0; step < most_steps; ++step) {
    const auto V = solve_with(E, borders, right), W = solve_with(E, borders, right, true);
    if (!V || !W) break;
    const Matrix C = orthonormal(V->topRows(n)), B = orthonormal(W->topRows(n));
    const double moved = (C - borders.C * (borders.C.transpose() * C)).norm() +
                         (B - borders.B * (borders.B.transpose() * B)).norm();
    borders = {B, C};
    if (moved < settled) break;
  }
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

std::optional<Matrix> solve_with(const ExtendedMatrix& E, const Borders& borders,
                                 const Matrix& right, bool transposed) {
  if (E.at.structured) {
    Matrix X = right;
    if (!E.at.structured->solve(borders_of_jacobian(E, borders), X, transposed))
      return std::nullopt;
    return X;
  }
  const Index n = E.dense.rows(), m = borders.B.cols();
  Matrix A(n + m, n + m);
  A.topLeftCorner(n, n) = E.dense;
  if (m > 0) A.topRightCorner(n, m) = borders.B;
  if (m > 0) A.bottomLeftCorner(m, n) = borders.C.transpose();
  A.bottomRightCorner(m, m).setZero();
  if (transposed) A.transposeInPlace();
  Matrix X = Lu(A).solve(right);
  if (!X.allFinite()) return std::nullopt;
  return X;
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
  for (Index step = 0; step < most_cheap_steps; ++step) {
    u = lu.solve_transposed(v).normalized();
    const Matrix next = lu.solve(u).normalized();
    if (!u.allFinite() || !next.allFinite()) break;  // exactly singular
    const double moved = (next - v * (v.transpose() * next)).norm();
    v = next;
    if (moved < few_digits) return {u, v};
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
