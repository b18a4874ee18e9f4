#include "springfold/continuation/branch_point.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "springfold/continuation/locate.hpp"

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

std::optional<EigenvalueZero> eigenvalue_zero(const Walker& walker, const CurvePoint& from,
                                              double a, double b, Index sorted) {
  std::optional<CurvePoint> best;
  double smallest = std::numeric_limits<double>::infinity();
  const auto f = [&](double ds) -> double {
    auto point = point_at(walker, from, ds);
    const auto spectrum = point ? spectrum_at(walker, *point) : std::nullopt;
    if (!spectrum) return 0;
    const double mu = (*spectrum)[sorted];
    if (std::abs(mu) < smallest) {
      smallest = std::abs(mu);
      best = std::move(point);
    }
    return mu;
  };
  const double fa = f(a), fb = f(b);
  if (!(fa != 0 && fb != 0 && (fa < 0) != (fb < 0))) return std::nullopt;
  std::uintmax_t most = 100;
  const double tolerance = walker.options.location_tolerance * (b - a);
  const auto close = [tolerance](double l, double r) { return std::abs(r - l) <= tolerance; };
  const auto [low, high] = boost::math::tools::toms748_solve(f, a, b, fa, fb, close, most);
  if (!best || smallest > 1e-5 * std::max(std::abs(fa), std::abs(fb))) return std::nullopt;
  return EigenvalueZero{*best, low, high};
}

int corank_at(const Walker& walker, const CurvePoint& point, double tolerance) {
  const auto spectrum = spectrum_at(walker, point);
  if (!spectrum) return 0;
  const Vector sizes = spectrum->cwiseAbs();
  return static_cast<int>((sizes.array() <= tolerance * sizes.maxCoeff()).count());
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

namespace {

/// Lower triangle of Sigma as a vector, m (m + 1) / 2 entries.
std::optional<Vector> singular_block(const Walker& walker, const CurvePoint& point,
                                     const Matrix& V) {
  Linearisation at;
  if (!linearise(walker.problem, point.x, point.lambda, point.piece, at)) return std::nullopt;
  const Index n = V.rows(), m = V.cols();
  Matrix A = Matrix::Zero(n + m, n + m), right = Matrix::Zero(n + m, m);
  A.topLeftCorner(n, n) = at.dF_dx;
  A.topRightCorner(n, m) = V;
  A.bottomLeftCorner(m, n) = V.transpose();
  right.bottomRows(m).setIdentity();
  const Matrix Sigma = A.partialPivLu().solve(right).bottomRows(m);
  Vector entries(m * (m + 1) / 2);
  for (Index i = 0, k = 0; i < m; ++i)
    for (Index j = 0; j <= i; ++j) entries[k++] = 0.5 * (Sigma(i, j) + Sigma(j, i));
  if (!entries.allFinite()) return std::nullopt;
  return entries;
}

/// m eigenvectors of dF/dx with the eigenvalues nearest to zero.
std::optional<Matrix> nearly_null(const Walker& walker, const CurvePoint& point, int m) {
  Linearisation at;
  if (!linearise(walker.problem, point.x, point.lambda, point.piece, at)) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(at.dF_dx);
  std::vector<Index> order(static_cast<std::size_t>(point.x.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    return std::abs(eigen.eigenvalues()[a]) < std::abs(eigen.eigenvalues()[b]);
  });
  order.resize(static_cast<std::size_t>(m));
  return Matrix(eigen.eigenvectors()(Eigen::all, order));
}

}  // namespace

std::optional<CurvePoint> refine_multiple_point(const Walker& walker, const CurvePoint& near,
                                                int m) {
  constexpr double h = 0x1p-17;
  const Index n = near.x.size();
  const auto V = nearly_null(walker, near, m);
  if (!V || m > n) return std::nullopt;
  CurvePoint point = near;
  Vector F;
  Linearisation at;
  for (int iteration = 0; iteration < 12; ++iteration) {
    const auto sigma = singular_block(walker, point, *V);
    if (!sigma || !walker.problem.residual(point.x, point.lambda, point.piece, F) ||
        !linearise(walker.problem, point.x, point.lambda, point.piece, at))
      return std::nullopt;
    Vector r(n + sigma->size());
    r << F, *sigma;
    Matrix J(n + sigma->size(), n + 1);
    J.topRows(n) << at.dF_dx, at.dF_dlambda;
    for (Index k = 0; k <= n; ++k) {
      CurvePoint plus = point, minus = point;
      (k < n ? plus.x[k] : plus.lambda) += h;
      (k < n ? minus.x[k] : minus.lambda) -= h;
      const auto above = singular_block(walker, plus, *V),
                 below = singular_block(walker, minus, *V);
      if (!above || !below) return std::nullopt;
      J.col(k).tail(sigma->size()) = (*above - *below) / (2 * h);
    }
    // Directions that neither F nor Sigma sees to first order are left alone.
    Eigen::CompleteOrthogonalDecomposition<Matrix> decomposition(J);
    decomposition.setThreshold(1e-6);
    const Vector step = decomposition.solve(-r);
    if (!step.allFinite()) return std::nullopt;
    point.x += step.head(n);
    point.lambda += step[n];
    const double moved = std::max((point.x - near.x).lpNorm<Eigen::Infinity>(),
                                  std::abs(point.lambda - near.lambda));
    if (moved > 1e-3) return std::nullopt;
    const double scale = std::max({1.0, point.x.lpNorm<Eigen::Infinity>(), std::abs(point.lambda)});
    if (step.lpNorm<Eigen::Infinity>() > 1e-13 * scale && iteration < 11) continue;
    if (r.lpNorm<Eigen::Infinity>() > 1e-9 * scale) return std::nullopt;
    return point;
  }
  return std::nullopt;
}

}  // namespace springfold::continuation
