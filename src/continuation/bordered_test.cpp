#include "bordered_test.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "small_lu.hpp"

namespace springfold::continuation {
namespace {

/// Jacobi's method is the more accurate one; on larger matrices it takes too long.
constexpr Index jacobi_size = 32;

constexpr double few_units = 4 * std::numeric_limits<double>::epsilon();

/// Is the spectral radius of the matrix X >= 0 below 1/2?
bool is_small(const Matrix& X) {
  if (!X.allFinite()) return false;
  Vector d = Vector::Ones(X.cols());
  for (int i = 0; i < 8; ++i) {
    const Vector Xd = X * d;
    if ((Xd.array() / d.array()).maxCoeff() < 0.5) return true;
    const double largest = Xd.maxCoeff();
    if (!(largest > 0)) return true;
    d = (Xd / largest).cwiseMax(1e-12);
  }
  return false;
}

}  // namespace

Matrix extended_matrix(const Linearisation& at, const Vector& weights, const Direction& tau) {
  const Index n = at.dF_dx.rows();
  Matrix E(n + 1, n + 1);
  E << at.dF_dx, at.dF_dlambda, (weights.array() * tau.dx.array()).matrix().transpose(),
      tau.dlambda;
  return E;
}

bool surely_regular(const std::vector<Matrix>& E, std::size_t middle) {
  if (SmallLu::fits(E[middle].rows())) {
    const SmallLu lu(E[middle]);
    if (!(lu.smallest_pivot() > 0)) return false;
    Matrix X;
    for (std::size_t i = 0; i < E.size(); ++i) {
      if (i == middle) continue;
      X = E[i] - E[middle];
      lu.solve(X);
      X = X.cwiseAbs();
      if (!is_small(X)) return false;
    }
    return true;
  }
  const Eigen::PartialPivLU<Matrix> lu(E[middle]);
  for (std::size_t i = 0; i < E.size(); ++i)
    if (i != middle && !is_small(lu.solve(E[i] - E[middle]).cwiseAbs())) return false;
  return true;
}

Vector singular_values(const Matrix& E) {
  return E.rows() <= jacobi_size ? Vector(Eigen::JacobiSVD<Matrix>(E).singularValues())
                                 : Vector(Eigen::BDCSVD<Matrix>(E).singularValues());
}

Index small_singular_values(const Matrix& E, double reach) {
  return std::max<Index>(1, (singular_values(E).array() < reach).count());
}

Borders borders_of(const Matrix& E, Index m) {
  constexpr int both = Eigen::ComputeFullU | Eigen::ComputeFullV;
  const auto last = [m](const auto& svd) {
    return Borders{svd.matrixU().rightCols(m), svd.matrixV().rightCols(m)};
  };
  return E.rows() <= jacobi_size ? last(Eigen::JacobiSVD<Matrix>(E, both))
                                 : last(Eigen::BDCSVD<Matrix>(E, both));
}

std::optional<Matrix> sigma_of(const Matrix& E, const Borders& borders) {
  const Index n = E.rows(), m = borders.B.cols();
  Matrix A(n + m, n + m);
  A << E, borders.B, borders.C.transpose(), Matrix::Zero(m, m);
  Matrix right = Matrix::Zero(n + m, m);
  right.bottomRows(m).setIdentity();
  Matrix Sigma = A.partialPivLu().solve(right).bottomRows(m);
  if (!Sigma.allFinite()) return std::nullopt;
  return Sigma;
}

double sigma_noise(const Matrix& E, const Borders& borders) {
  const Index n = E.rows(), m = borders.B.cols();
  Matrix A(n + m, n + m);
  A << E, borders.B, borders.C.transpose(), Matrix::Zero(m, m);
  Matrix right = Matrix::Zero(n + m, m);
  right.bottomRows(m).setIdentity();
  const Matrix Phi = A.partialPivLu().solve(right).topRows(n).cwiseAbs();
  const Matrix Psi = A.transpose().partialPivLu().solve(right).topRows(n).cwiseAbs();
  const double noise = few_units * (Psi.transpose() * (E.cwiseAbs() * Phi)).norm();
  return std::isfinite(noise) ? noise : std::numeric_limits<double>::infinity();
}

double rate_noise(const Matrix& E) {
  const Index n = E.rows();
  const Vector unit = Vector::Unit(n, n - 1);
  const Eigen::PartialPivLU<Matrix> lu(E);
  Vector tangent = lu.solve(unit);
  tangent /= tangent.norm();
  const Vector row = lu.transpose().solve(unit);
  const double noise = few_units * row.cwiseAbs().dot(E.cwiseAbs() * tangent.cwiseAbs());
  return std::isfinite(noise) ? noise : std::numeric_limits<double>::infinity();
}

}  // namespace springfold::continuation
