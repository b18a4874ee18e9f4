#include <cmath>

#include "continuation/locating/watched_step.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {
namespace {

/// Patterns of signs with which rounding is tried.
constexpr Index patterns = 3;
double sign(Index pattern, Index row) {
  return std::cos(2.1 * static_cast<double>((pattern + 1) * (row + 1))) > 0 ? 1 : -1;
}

/// Rounding of F, row by row: of the products with E; and what F shows when the point is moved by some units of rounding,
/// as terms of F may be much larger than what they leave of it.
std::optional<Vector> rounding_of(const WatchedStep& arc, const ExtendedMatrix& E,
                                  const CurvePoint& point, const Vector& F) {
  const ProblemView problem = arc.walker().problem;
  const Index n = point.x.size();
  Vector u(n + 1), moved(n), F_moved;
  u << point.x, point.lambda;
  Vector rounding = rounding_unit * magnitudes(E, u).col(0).head(n);
  for (Index k = 0; k < patterns; ++k) {
    Vector step = Vector::Zero(n + 1);
    for (Index i = 0; i < n; ++i) {
      moved[i] = point.x[i] * (1 + sign(k, i) * static_cast<double>(k + 1) * rounding_unit);
      step[i] = moved[i] - point.x[i];
    }
    if (!problem.residual(moved, point.lambda, point.piece, F_moved)) return std::nullopt;
    const Vector linear = product(E, step).col(0).head(n);
    rounding = rounding.cwiseMax((F_moved - F - linear).cwiseAbs());
  }
  return rounding;
}

/// How far what is left of F, or its rounding with a few patterns of signs, may have moved a corrected point.
double blur_of_point(const WatchedStep& arc, const ExtendedMatrix& E, const CurvePoint& point) {
  const Index n = point.x.size();
  Vector F;
  if (!arc.walker().problem.residual(point.x, point.lambda, point.piece, F)) return infinity;
  const auto rounding_of_F = rounding_of(arc, E, point, F);
  if (!rounding_of_F) return infinity;
  Matrix right = Matrix::Zero(n + 1, patterns + 1);
  right.col(patterns).head(n) = F;
  for (Index k = 0; k < patterns; ++k)
    for (Index i = 0; i < n; ++i) right(i, k) = (*rounding_of_F)[i] * sign(k, i);
  const auto moved = solve_with(E, {}, right);
  if (!moved) return infinity;
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

bool is_determined(const WatchedStep& arc, const CurvePoint& point, double most_blur) {
  const auto E = arc.matrix(point);
  if (!E) return false;
  const double blur = blur_of_point(arc, *E, point);
  if (!(blur <= most_blur)) return false;
  const WeakestDirection weakest(arc, *E, point);
  const auto change = weakest.change(between_samples * blur);
  return change && *change <= stays_regular * weakest.here();
}

}  // namespace springfold::continuation
