#include <Eigen/QR>
#include <Eigen/SVD>

#include "springfold/core/decompositions.hpp"

namespace springfold {
namespace {

unsigned int options_of(SingularVectors left, SingularVectors right) {
  unsigned int options = 0;
  if (left == SingularVectors::full) options |= Eigen::ComputeFullU;
  if (left == SingularVectors::thin) options |= Eigen::ComputeThinU;
  if (right == SingularVectors::full) options |= Eigen::ComputeFullV;
  if (right == SingularVectors::thin) options |= Eigen::ComputeThinV;
  return options;
}

/// Of a matrix without entries, which Eigen does not take: all vectors of a side are singular ones.
Svd svd_of_nothing(const Matrix& A, SingularVectors left, SingularVectors right) {
  Svd svd{.values = Vector(0), .rank = 0};
  if (left == SingularVectors::full) svd.U = Matrix::Identity(A.rows(), A.rows());
  if (left == SingularVectors::thin) svd.U = Matrix(A.rows(), 0);
  if (right == SingularVectors::full) svd.V = Matrix::Identity(A.cols(), A.cols());
  if (right == SingularVectors::thin) svd.V = Matrix(A.cols(), 0);
  return svd;
}

template <class Solver>
Svd svd_of(const Matrix& A, SingularVectors left, SingularVectors right) {
  if (A.size() == 0) return svd_of_nothing(A, left, right);
  const Solver solver(A, options_of(left, right));
  Svd svd{.values = solver.singularValues(), .rank = solver.rank()};
  if (left != SingularVectors::none) svd.U = solver.matrixU();
  if (right != SingularVectors::none) svd.V = solver.matrixV();
  return svd;
}

using ColumnPivots = Eigen::ColPivHouseholderQR<Matrix>;

ColumnPivots column_pivots(const Matrix& A, std::optional<double> threshold) {
  ColumnPivots qr(A);
  if (threshold) qr.setThreshold(*threshold);
  return qr;
}

using Complete = Eigen::CompleteOrthogonalDecomposition<Matrix>;

/// The threshold has to be set before the decomposition is computed: set afterwards it changes the rank, but not
/// the factors that belong to it.
Complete complete(const Matrix& A, std::optional<double> threshold) {
  Complete decomposition(A.rows(), A.cols());
  if (threshold) decomposition.setThreshold(*threshold);
  decomposition.compute(A);
  return decomposition;
}

}  // namespace

Vector Svd::solve(const Vector& right) const {
  Vector in_U;
  in_U.noalias() = U.leftCols(rank).adjoint() * right;
  in_U = values.head(rank).asDiagonal().inverse() * in_U;
  return V.leftCols(rank) * in_U;
}

Svd jacobi_svd(const Matrix& A, SingularVectors left, SingularVectors right) {
  return svd_of<Eigen::JacobiSVD<Matrix>>(A, left, right);
}

Svd divided_svd(const Matrix& A, SingularVectors left, SingularVectors right) {
  return svd_of<Eigen::BDCSVD<Matrix>>(A, left, right);
}

Matrix orthonormal_columns(const Matrix& A) {
  return Eigen::HouseholderQR<Matrix>(A).householderQ() * Matrix::Identity(A.rows(), A.cols());
}

Matrix orthonormal_basis(const Matrix& A) { return Eigen::HouseholderQR<Matrix>(A).householderQ(); }

PivotedQr pivoted_qr(const Matrix& A, std::optional<double> threshold) {
  const ColumnPivots qr = column_pivots(A, threshold);
  PivotedQr result{.pivots = qr.matrixQR().diagonal().cwiseAbs(), .rank = qr.rank()};
  if (A.rows() == 0) return result;
  result.last_column = Vector::Unit(A.rows(), A.rows() - 1);
  result.last_column.applyOnTheLeft(qr.householderQ());
  return result;
}

Index rank_of(const Matrix& A, std::optional<double> threshold) {
  return A.size() > 0 ? column_pivots(A, threshold).rank() : 0;
}

Matrix kernel_of(const Matrix& A, std::optional<double> threshold) {
  if (A.rows() == 0) return Matrix::Identity(A.cols(), A.cols());
  const ColumnPivots qr = column_pivots(A.transpose(), threshold);
  const Matrix Q = qr.householderQ();
  return Q.rightCols(A.cols() - qr.rank());
}

Vector least_squares(const Matrix& A, const Vector& right, std::optional<double> threshold) {
  if (A.size() == 0) return Vector::Zero(A.cols());
  return complete(A, threshold).solve(right);
}

Matrix least_squares_of_columns(const Matrix& A, const Matrix& right) {
  if (A.size() == 0) return Matrix::Zero(A.cols(), right.cols());
  return complete(A, {}).solve(right);
}

std::optional<Matrix> unique_least_squares(const Matrix& A, const Matrix& right, double threshold) {
  const Complete decomposition = complete(A, threshold);
  if (decomposition.rank() < A.cols()) return std::nullopt;
  return decomposition.solve(right);
}

Matrix fitted(const Matrix& A, const Matrix& right) { return A.householderQr().solve(right); }

}  // namespace springfold
