#include "continuation/locating/determined.hpp"

#include <cmath>
#include <limits>

#include "continuation/points/numerics.hpp"

namespace springfold::continuation {
namespace {

/// How far what is left of F, or its rounding with a few patterns of signs, may have moved a corrected point.
double blur_of_point(const WatchedStep& arc, const ExtendedMatrix& E, const CurvePoint& point) {
  constexpr double unknown = std::numeric_limits<double>::infinity();
  const Index n = point.x.size();
  Vector F, u(n + 1);
  if (!arc.walker().problem.residual(point.x, point.lambda, point.piece, F)) return unknown;
  u << point.x, point.lambda;
  const Vector rounding_of_F = rounding_unit * magnitudes(E, u).col(0);
  Matrix right = Matrix::Zero(n + 1, 4);
  right.col(3).head(n) = F;
  for (Index k = 0; k < 3; ++k)
    for (Index i = 0; i < n; ++i)
      right(i, k) =
          rounding_of_F[i] * (std::cos(2.1 * static_cast<double>((k + 1) * (i + 1))) > 0 ? 1 : -1);
  const auto moved = solve_with(E, {}, right);
  if (!moved) return unknown;
  double worst = 0;
  for (Index k = 0; k < right.cols(); ++k) {
    const Direction d{moved->col(k).head(n), (*moved)(n, k)};
    worst = std::max(worst, std::sqrt(metric_product(arc.walker().weights, d, d)));
  }
  return worst;
}

}  // namespace

std::optional<Separation> separation_at(const WatchedStep& arc, const CurvePoint& point) {
  const auto E = arc.matrix(point);
  if (!E) return std::nullopt;
  const Borders weakest = borders_of(*E, 1);
  const auto seen = [&](const ExtendedMatrix& M) {
    return (weakest.B.transpose() * product(M, weakest.C))(0, 0);
  };
  const Index n = point.x.size();
  const Direction v{weakest.C.col(0).head(n), weakest.C(n, 0)};
  const double length = std::sqrt(metric_product(arc.walker().weights, v, v)), here = seen(*E);
  double change = 0;
  for (const double side : {-1.0, 1.0}) {
    CurvePoint aside = point;
    aside.x += side * told_apart / length * v.dx;
    aside.lambda += side * told_apart / length * v.dlambda;
    const auto there = arc.matrix(aside);
    if (there) change = std::max(change, std::abs(seen(*there) - here));
  }
  return Separation{blur_of_point(arc, *E, point), told_apart * std::abs(here) / change};
}

bool is_determined(const WatchedStep& arc, const CurvePoint& point) {
  constexpr double most_blur = 3e-5;
  const auto E = arc.matrix(point);
  if (!E) return false;
  const double blur = blur_of_point(arc, *E, point);
  if (!(blur <= most_blur)) return false;
  const Borders weakest = borders_of(*E, 1);
  const auto seen = [&](const ExtendedMatrix& M) {
    return (weakest.B.transpose() * product(M, weakest.C))(0, 0);
  };
  const Index n = point.x.size();
  const Direction v{weakest.C.col(0).head(n), weakest.C(n, 0)};
  const double length = std::sqrt(metric_product(arc.walker().weights, v, v));
  const double shift = between_samples * blur / length, here = seen(*E);
  for (const double side : {-1.0, 1.0}) {
    CurvePoint aside = point;
    aside.x += side * shift * v.dx;
    aside.lambda += side * shift * v.dlambda;
    const auto there = arc.matrix(aside);
    if (!there || std::abs(seen(*there) - here) > stays_regular * std::abs(here)) return false;
  }
  return true;
}

}  // namespace springfold::continuation
