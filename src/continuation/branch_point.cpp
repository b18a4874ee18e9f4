#include "springfold/continuation/branch_point.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace springfold::continuation {
namespace {

/// d([dF/dx dF/dlambda]^T v)/d(x, lambda) by central differences, (n + 1) x (n + 1).
std::optional<Matrix> gradient_rate(const Walker& walker, const CurvePoint& at, const Vector& v) {
  constexpr double h = 0x1p-17;
  const Index n = at.x.size();
  Matrix rate(n + 1, n + 1);
  Linearisation plus, minus;
  for (Index k = 0; k <= n; ++k) {
    Vector x_plus = at.x, x_minus = at.x;
    double l_plus = at.lambda, l_minus = at.lambda;
    (k < n ? x_plus[k] : l_plus) += h;
    (k < n ? x_minus[k] : l_minus) -= h;
    if (!linearise(walker.problem, x_plus, l_plus, at.piece, plus) ||
        !linearise(walker.problem, x_minus, l_minus, at.piece, minus))
      return std::nullopt;
    rate.col(k).head(n) = (plus.dF_dx - minus.dF_dx).transpose() * v / (2 * h);
    rate(n, k) = (plus.dF_dlambda - minus.dF_dlambda).dot(v) / (2 * h);
  }
  return rate;
}

}  // namespace

std::optional<Vector> spectrum_at(const Walker& walker, const CurvePoint& point) {
  Linearisation at;
  if (!linearise(walker.problem, point.x, point.lambda, point.piece, at)) return std::nullopt;
  return Eigen::SelfAdjointEigenSolver<Matrix>(at.dF_dx, Eigen::EigenvaluesOnly).eigenvalues();
}

std::optional<CurvePoint> refine_branch_point(const Walker& walker, const CurvePoint& near) {
  const Index n = near.x.size();
  CurvePoint point = near;
  Linearisation at;
  if (!linearise(walker.problem, point.x, point.lambda, point.piece, at)) return std::nullopt;
  Matrix extended(n, n + 1);
  extended << at.dF_dx, at.dF_dlambda;
  const Eigen::JacobiSVD<Matrix> svd(extended, Eigen::ComputeThinU);
  Vector v = svd.matrixU().col(n - 1), F;
  double b = 0;
  for (int iteration = 0; iteration < 12; ++iteration) {
    if (!walker.problem.residual(point.x, point.lambda, point.piece, F) ||
        !linearise(walker.problem, point.x, point.lambda, point.piece, at))
      return std::nullopt;
    Vector r(2 * n + 2);
    r << F + b * v, at.dF_dx.transpose() * v, at.dF_dlambda.dot(v), v.dot(v) - 1;
    const auto rate = gradient_rate(walker, point, v);
    if (!rate) return std::nullopt;
    Matrix A = Matrix::Zero(2 * n + 2, 2 * n + 2);
    A.block(0, 0, n, n + 1) << at.dF_dx, at.dF_dlambda;
    A.block(0, n + 1, n, 1) = v;
    A.block(0, n + 2, n, n) = b * Matrix::Identity(n, n);
    A.block(n, 0, n + 1, n + 1) = *rate;
    A.block(n, n + 2, n, n) = at.dF_dx.transpose();
    A.block(2 * n, n + 2, 1, n) = at.dF_dlambda.transpose();
    A.block(2 * n + 1, n + 2, 1, n) = 2 * v.transpose();
    const Eigen::FullPivLU<Matrix> lu(A);
    if (!lu.isInvertible()) return std::nullopt;  // a multiple branch point
    const Vector step = lu.solve(-r);
    if (!step.allFinite()) return std::nullopt;
    point.x += step.head(n);
    point.lambda += step[n];
    b += step[n + 1];
    v += step.tail(n);
    const double moved = std::max((point.x - near.x).lpNorm<Eigen::Infinity>(),
                                  std::abs(point.lambda - near.lambda));
    if (moved > 1e-3) return std::nullopt;
    const double scale = std::max({1.0, point.x.lpNorm<Eigen::Infinity>(), std::abs(point.lambda)});
    if (step.lpNorm<Eigen::Infinity>() <= 1e-13 * scale ||
        (iteration > 2 && r.lpNorm<Eigen::Infinity>() <= 1e-13 * scale)) {
      if (std::abs(b) > 1e-10) return std::nullopt;  // a nearly-branch point: no curve through it
      return point;
    }
  }
  return std::nullopt;
}

}  // namespace springfold::continuation
