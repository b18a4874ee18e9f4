#include "springfold/continuation/branch_point.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>

#include "springfold/continuation/locate.hpp"

namespace springfold::continuation {
namespace {

std::optional<double> eigenvalue(const Walker& walker, const CurvePoint& point, Index sorted) {
  Linearisation at;
  if (!linearise(walker.problem, point.x, point.lambda, point.piece, at)) return std::nullopt;
  return Eigen::SelfAdjointEigenSolver<Matrix>(at.dF_dx, Eigen::EigenvaluesOnly)
      .eigenvalues()[sorted];
}

/// Zero of one sorted eigenvalue. Where a trial point cannot be corrected because the matrix is
/// singular to rounding, that is the zero; the nearest good point is kept.
std::optional<CrossingPoint> zero_of(const Walker& walker, const CurvePoint& from, double h,
                                     Index sorted) {
  std::optional<CurvePoint> best;
  double smallest = std::numeric_limits<double>::infinity();
  const auto f = [&](double ds) -> double {
    auto point = point_at(walker, from, ds);
    const auto mu = point ? eigenvalue(walker, *point, sorted) : std::nullopt;
    if (!mu) return 0;
    if (std::abs(*mu) < smallest) {
      smallest = std::abs(*mu);
      best = std::move(point);
    }
    return *mu;
  };
  const double fa = f(0), fb = f(h);
  if (!(fa != 0 && fb != 0 && (fa < 0) != (fb < 0))) return std::nullopt;
  std::uintmax_t most = 100;
  const double tolerance = walker.options.location_tolerance * h;
  const auto close = [tolerance](double l, double r) { return std::abs(r - l) <= tolerance; };
  const auto [low, high] = boost::math::tools::toms748_solve(f, 0.0, h, fa, fb, close, most);
  if (!best) return std::nullopt;
  return CrossingPoint{*best, 1, low, high};
}

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

std::optional<std::vector<CrossingPoint>> locate_crossings(const Walker& walker,
                                                           const CurvePoint& from,
                                                           const CurvePoint& to) {
  const double h = to.s - from.s;
  const auto [fewer, more] = std::minmax(*from.negative, *to.negative);
  std::vector<CrossingPoint> crossings;
  for (Index sorted = fewer; sorted < more; ++sorted) {
    auto zero = zero_of(walker, from, h, sorted);
    if (!zero) return std::nullopt;
    const auto same = std::find_if(crossings.begin(), crossings.end(), [&](const auto& other) {
      return std::abs(other.point.s - zero->point.s) <= 1e-6 * h;
    });
    if (same != crossings.end())
      ++same->multiplicity;
    else
      crossings.push_back(std::move(*zero));
  }
  for (CrossingPoint& crossing : crossings) {
    if (crossing.multiplicity > 1) continue;
    auto refined = refine_branch_point(walker, crossing.point);
    if (!refined) continue;
    const Direction offset{refined->x - from.x, refined->lambda - from.lambda};
    refined->s = from.s + metric_product(walker.weights, offset, from.tangent);
    crossing.point = std::move(*refined);
  }
  std::sort(crossings.begin(), crossings.end(),
            [](const auto& a, const auto& b) { return a.point.s < b.point.s; });
  for (CrossingPoint& crossing : crossings) crossing.point.negative.reset();
  return crossings;
}

}  // namespace springfold::continuation
