#include "continuation/locating/evidence.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/locating/branch_point.hpp"
#include "continuation/locating/tested_step.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/locate.hpp"
#include "continuation/points/words.hpp"
#include "continuation/points/workspace.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {
namespace {

/// Patterns of signs with which rounding is tried.
constexpr Index patterns = 3;
double sign(Index pattern, Index row) {
  return std::cos(2.1 * static_cast<double>((pattern + 1) * (row + 1))) > 0 ? 1 : -1;
}

/// Rounding of F, row by row: of the products with E; and what F shows when the point is moved by some units of
/// rounding, as terms of F may be much larger than what they leave of it.
std::optional<Vector> rounding_of(const TestedStep& arc, const ExtendedMatrix& E,
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
double blur_of_point(const TestedStep& arc, const ExtendedMatrix& E, const CurvePoint& point) {
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
  WeakestDirection(const TestedStep& arc, const ExtendedMatrix& E, const CurvePoint& point)
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

  const TestedStep& arc_;
  const CurvePoint& point_;
  Borders weakest_;
  Direction v_{};
  double length_ = 1, here_;
};

/// Largest residual on the predictor line at a share t of the step, against that at its end. A smooth
/// curve gives t^2, near an inflection t^3; there is room for changing curvature.
double residual_limit(double t) {
  constexpr double most = 1.2;
  return most * t + small_share * std::max(0.0, 1 - std::abs(4 * t - 1));
}

/// The residual on the predicted way, at seven places of it, against that at its end.
std::string residual_doubt(const Walker& walker, const ArcModel* model, const CurvePoint& from,
                           double ds) {
  constexpr int parts = 8;
  Vector& F = walker.memory->F;
  CurvePoint& p = walker.memory->trial;
  const bool expected = expect(walker, model, from, ds, p);
  const auto go_to = [&](double t) {
    const double d = t * ds;
    if (expected) {
      model->point(walker.weights, from, d, p);
    } else {
      p.x = from.x + d * from.tangent.dx;
      p.lambda = from.lambda + d * from.tangent.dlambda;
    }
  };
  const auto size_at = [&](double t) {
    go_to(t);
    // The corrector has begun at the end, and will in the middle.
    if (const Vector* known = known_residual(*walker.memory, p.x, p.lambda, from.piece))
      return known->norm();
    if (t == 0.5 && expected && !walker.problem.structured()) {
      const LinearisedPoint* place =
          linearised_with_residual(walker.problem, *walker.memory, p.x, p.lambda, from.piece);
      return place ? place->F.norm() : 0.0;
    }
    const bool inside = walker.problem.residual(p.x, p.lambda, from.piece, F);
    return inside && F.size() > 0 ? F.norm() : 0.0;
  };
  // What rounding of the terms of each row does not explain: of a stiff spring it is far more than a soft one's
  // residual.
  const auto size_above_rounding = [&](double t) {
    go_to(t);
    Vector rounding;
    if (!rounding_of_rows(walker, from.piece, p, rounding) ||
        !walker.problem.residual(p.x, p.lambda, from.piece, F))
      return infinity;
    return (F.cwiseAbs() - rounding).cwiseMax(0).norm();
  };
  const double at_end = size_at(1), scale = std::max(1.0, from.x.norm());
  for (int k = 1; k < parts; ++k) {
    const double t = static_cast<double>(k) / parts;
    // A kink lies on the curve of the piece behind it as well as its surfaces were placed: that is no growth.
    const double size = size_at(t), most = residual_limit(t) * at_end + residual_level * scale;
    if (size > most && size > most + size_at(0) && size_above_rounding(t) > most)
      return "residual does not grow evenly along the predictor: another branch may be near";
  }
  return {};
}

/// 1 / (tau . tau_from): times the tangent it is the rate of the curve by the way t along the tangent at `from`,
/// du/dt = tau / (tau . tau_from) exactly, every corrected point being on the hyperplane across it.
double rate(const Walker& walker, const CurvePoint& from, const CurvePoint& p) {
  return 1 / metric_product(walker.weights, p.tangent, from.tangent);
}

/// Length of what a direction has across the tangent; the direction is used up.
double across(const Walker& walker, Direction& d, const Direction& tangent) {
  const double along = metric_product(walker.weights, d, tangent);
  d.dx -= along * tangent.dx;
  d.dlambda -= along * tangent.dlambda;
  return length_of(walker, d);
}

/// Distance of the corrected middle from the cubic through both ends. @param d  storage
double off_cubic(const Walker& walker, const CurvePoint& from, const CurvePoint& to,
                 const CurvePoint& middle, Direction& d) {
  ArcModel& chord = walker.memory->chord;
  CurvePoint& expected = walker.memory->trial;
  if (!chord.go_through(walker.weights, from, StepSamples(from, nullptr, to))) return infinity;
  chord.point(walker.weights, from, middle.s - from.s, expected);
  d.dx = middle.x - expected.x;
  d.dlambda = middle.lambda - expected.lambda;
  return across(walker, d, middle.tangent);
}

/// What the tangents, integrated by Simpson's rule, leave of the way from one end to the other. A
/// neighbouring branch has nearly the same tangents, but lies elsewhere. @param d  storage
double off_integral(const Walker& walker, const CurvePoint& from, const CurvePoint& to,
                    const CurvePoint& middle, Direction& d) {
  const double h = to.s - from.s;
  const double a = h / 6 * rate(walker, from, from), m = h * 2 / 3 * rate(walker, from, middle),
               b = h / 6 * rate(walker, from, to);
  d.dx = to.x - from.x - a * from.tangent.dx - m * middle.tangent.dx - b * to.tangent.dx;
  d.dlambda = to.lambda - from.lambda - a * from.tangent.dlambda - m * middle.tangent.dlambda -
              b * to.tangent.dlambda;
  return across(walker, d, middle.tangent);
}

/// Errors that residuals at rounding level leave where dF/dx is nearly singular.
double corrector_noise(const Walker& walker, const CurvePoint& point) {
  if (!walker.problem.symmetric()) return 0;
  const double least = least_eigenvalue(walker, point), scale = std::max(1.0, point.x.norm());
  return least > 0 ? exact_model * scale / least : 1;
}

}  // namespace

std::optional<Separation> separation_at(const TestedStep& arc, const CurvePoint& point) {
  const auto E = arc.matrix(point);
  if (!E) return std::nullopt;
  const WeakestDirection weakest(arc, *E, point);
  const double change = weakest.change(told_apart).value_or(HUGE_VAL);
  return Separation{blur_of_point(arc, *E, point), told_apart * weakest.here() / change};
}

std::optional<double> change_of_rounding(const TestedStep& arc, const CurvePoint& point) {
  const auto E = arc.matrix(point);
  if (!E) return std::nullopt;
  const auto change = WeakestDirection(arc, *E, point).change(told_apart);
  if (!change) return std::nullopt;
  return *change / told_apart * exact_model * std::max(1.0, size_of(point));
}

bool stays_within(const TestedStep& arc, const CurvePoint& point, double radius, double share) {
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

bool is_determined(const TestedStep& arc, const CurvePoint& point, double most_blur) {
  const auto E = arc.matrix(point);
  if (!E) return false;
  const double blur = blur_of_point(arc, *E, point);
  if (!(blur <= most_blur)) return false;
  const WeakestDirection weakest(arc, *E, point);
  const auto change = weakest.change(between_samples * blur);
  // A matrix that changes by less than one of itself stays regular; half leaves a factor of two for motion that is not
  // straight.
  return change && *change <= 0.5 * weakest.here();
}

bool examine(const Walker& walker, const ArcModel* model, const CurvePoint& from,
             const CurvePoint& to, CurvePoint& middle, std::string& doubt) {
  const double ds = to.s - from.s;
  doubt = residual_doubt(walker, model, from, ds);
  if (!doubt.empty()) return false;
  // Predicted by nothing that lies ahead.
  const bool found = (expect(walker, model, from, 0.5 * ds, middle) &&
                      find_point(walker, from.piece, from.tangent, middle)) ||
                     find_point_at(walker, from, 0.5 * ds, middle);
  if (!found) {
    doubt = "no point of the curve found half-way";
    return false;
  }
  middle.s = from.s + 0.5 * ds;
  Direction& d = walker.memory->direction;
  const auto bend = [&](const CurvePoint& p) {
    const double along = p.s - from.s;
    d.dx = p.x - from.x - along * from.tangent.dx;
    d.dlambda = p.lambda - from.lambda - along * from.tangent.dlambda;
    return length_of(walker, d);
  };
  // A piece may begin where a law is hardly smooth, as at a contact whose force grows with a power little above one. No
  // polynomial follows it there, but what a short first step is off by less than places are promised by is no other
  // branch.
  const double nothing = model == nullptr && ds <= poor ? promised_place : function_noise;
  // An eigen-decomposition: only where it can matter.
  const auto exceeds = [&](double value, double limit) {
    return value > limit + nothing && value > limit + nothing + corrector_noise(walker, middle);
  };
  const double size = std::max(bend(middle), bend(to) / 4);
  const double off = off_cubic(walker, from, to, middle, d);
  if (exceeds(off, small_share * size)) {
    doubt = "the point half-way is " + rounded(off / ds) +
            " steps off the cubic through both ends: another branch may be near";
    return true;
  }
  const double left = off_integral(walker, from, to, middle, d);
  if (exceeds(left, negligible_share * size))
    doubt = "the end is " + rounded(left / ds) +
            " steps from where the tangents lead: another branch may be near";
  return true;
}

Evidence examine(const Walker& walker, const CurvePoint& from, const CurvePoint& to) {
  Evidence evidence;
  CurvePoint middle;
  if (examine(walker, nullptr, from, to, middle, evidence.doubt))
    evidence.middle = std::move(middle);
  return evidence;
}

}  // namespace springfold::continuation
