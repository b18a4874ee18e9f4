#include "springfold/core/decompositions.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "springfold/core/small_lu.hpp"

namespace springfold {

void Lu::compute(const Matrix& A) { factors_.compute(A); }

Vector Lu::solve_vector(const Vector& right) const { return factors_.solve(right); }

Matrix Lu::solve_matrix(const Matrix& right) const { return factors_.solve(right); }

void Lu::solve(const Vector& right, Eigen::Ref<Vector> x) const { x = factors_.solve(right); }

Matrix Lu::solve_transposed(const Matrix& right) const { return factors_.transpose().solve(right); }

Matrix Lu::inverse() const { return factors_.inverse(); }

double Lu::determinant() const { return factors_.determinant(); }

double Lu::smallest_pivot() const {
  return factors_.matrixLU().size() > 0 ? factors_.matrixLU().diagonal().cwiseAbs().minCoeff() : 0;
}

double Lu::largest_pivot() const {
  return factors_.matrixLU().size() > 0 ? factors_.matrixLU().diagonal().cwiseAbs().maxCoeff() : 0;
}

double Lu::reciprocal_condition() const { return smallest_pivot() > 0 ? factors_.rcond() : 0; }

int Lu::sign() const {
  const Index negative = (factors_.matrixLU().diagonal().array() < 0).count();
  return static_cast<int>(factors_.permutationP().determinant()) * (negative % 2 == 0 ? 1 : -1);
}

double signed_least(const Matrix& A) {
  Matrix inverse;
  int sign = 0;
  if (SmallLu::fits(A.rows())) {
    const SmallLu lu(A);
    sign = lu.sign();
    inverse.setIdentity(A.rows(), A.cols());
    if (sign != 0) lu.solve(inverse);
  } else {
    const Lu lu(A);
    sign = lu.sign();
    inverse = lu.inverse();
  }
  const double size = inverse.norm();
  return size > 0 && std::isfinite(size) ? sign / size : 0;
}

FullPivotLu::FullPivotLu(const Matrix& A) : factors_(A) {}

bool FullPivotLu::is_invertible() const { return factors_.isInvertible(); }

Matrix FullPivotLu::inverse() const { return factors_.inverse(); }

Vector FullPivotLu::solve_vector(const Vector& right) const { return factors_.solve(right); }

Matrix FullPivotLu::solve_matrix(const Matrix& right) const { return factors_.solve(right); }

Vector solve_definite(const Matrix& A, const Vector& right) { return A.ldlt().solve(right); }

Matrix solve_definite(const Matrix& A, const Matrix& right) { return A.ldlt().solve(right); }

SymmetricEigen symmetric_eigen(const Matrix& A) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Vector symmetric_eigenvalues(const Matrix& A) {
  return Eigen::SelfAdjointEigenSolver<Matrix>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

Vector body_eigenvalues(const Matrix& A) {
  if (A.rows() > SmallMatrix::MaxRowsAtCompileTime)
    return symmetric_eigenvalues(0.5 * (A + A.transpose()));
  const SmallMatrix symmetric = 0.5 * (A + A.transpose());
  return Eigen::SelfAdjointEigenSolver<SmallMatrix>(symmetric, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

Vector eigenvalues_of_pair(const Matrix& A, const Matrix& B) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Matrix>(A, B, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

Eigen::VectorXcd eigenvalues(const Matrix& A) {
  return Eigen::EigenSolver<Matrix>(A, false).eigenvalues();
}

double spectral_radius(const SmallMatrix& A) {
  if (A.size() == 0) return 0;
  const Eigen::EigenSolver<SmallMatrix> solver(A, false);
  double largest = 0;
  for (Index i = 0; i < A.rows(); ++i)
    largest = std::max(largest, std::abs(solver.eigenvalues()[i]));
  return largest;
}

}  // namespace springfold
