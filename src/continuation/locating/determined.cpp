#include "continuation/locating/determined.hpp"

#include <cmath>
#include <limits>

#include "continuation/numerics/numerics.hpp"

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

/// E in its weakest direction at a point, and how that changes when the point is moved in it.
class WeakestDirection {
 public:
  WeakestDirection(const WatchedStep& arc, const ExtendedMatrix& E, const CurvePoint& point)
      : arc_{arc}, point_{point}, weakest_{weakest_borders(E)}, here_{seen(E)} {
    const Index n = point.x.size();
    v_ = {weakest_.C.col(0).head(n), weakest_.C(n, 0)};
    length_ = std::sqrt(metric_product(arc.walker().weights, v_, v_));
  }

  double here() const { return std::abs(here_); }

  /// The larger one of both ways; nothing where E is not defined on a side.
  std::optional<double> change(double distance) const {
    double change = 0;
    for (const double side : {-1.0, 1.0}) {
      CurvePoint aside = point_;
      aside.x += side * distance / length_ * v_.dx;
      aside.lambda += side * distance / length_ * v_.dlambda;
      const auto there = arc_.matrix(aside);
      if (!there) return std::nullopt;
      change = std::max(change, std::abs(seen(*there) - here_));
    }
    return change;
  }

 private:
  double seen(const ExtendedMatrix& M) const {
    return (weakest_.B.transpose() * product(M, weakest_.C))(0, 0);
  }

  const WatchedStep& arc_;
  const CurvePoint& point_;
  Borders weakest_;
  Direction v_{};
  double length_ = 1, here_;
};

}  // namespace

std::optional<Separation> separation_at(const WatchedStep& arc, const CurvePoint& point) {
  const auto E = arc.matrix(point);
  if (!E) return std::nullopt;
  const WeakestDirection weakest(arc, *E, point);
  const double change = weakest.change(told_apart).value_or(HUGE_VAL);
  return Separation{blur_of_point(arc, *E, point), told_apart * weakest.here() / change};
}

bool stays_within(const WatchedStep& arc, const CurvePoint& point, double radius, double share) {
  const auto E = arc.matrix(point);
  if (!E) return false;
  const WeakestDirection weakest(arc, *E, point);
  // Not at the ends alone: what is periodic may be there what it is here.
  for (const double part : {1.0, 0.5, 0.25}) {
    const auto change = weakest.change(part * radius);
    if (!change || *change > share * weakest.here()) return false;
  }
  return true;
}

bool is_determined(const WatchedStep& arc, const CurvePoint& point) {
  const auto E = arc.matrix(point);
  if (!E) return false;
  const double blur = blur_of_point(arc, *E, point);
  if (!(blur <= near_share * told_apart)) return false;
  const WeakestDirection weakest(arc, *E, point);
  const auto change = weakest.change(between_samples * blur);
  return change && *change <= stays_regular * weakest.here();
}

}  // namespace springfold::continuation
