// A model of the curve between some of its points. Private to the engine.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "continuation/points/step.hpp"

namespace springfold::continuation {

/// A step's ends and points between them, in order; all on one piece.
using Samples = std::span<const CurvePoint* const>;

/// The ends and, if there is one, a point between them.
class StepSamples {
 public:
  StepSamples(const CurvePoint& from, const CurvePoint* middle, const CurvePoint& to)
      : points_{&from, middle ? middle : &to, &to}, count_{middle ? 3u : 2u} {}

  operator Samples() const { return Samples(points_).first(count_); }  // NOLINT: on purpose

 private:
  std::array<const CurvePoint*, 3> points_;
  std::size_t count_;
};

class Normalised;

/// The polynomial through points of the curve and their tangents, in Newton's form with double knots. On one smooth
/// piece the curve is a function u(t) = (x, lambda)(t) of the way t = tau_0 . (u - u_0) along the tangent at one of its
/// points, the origin, with the rate du/dt = tau / (tau . tau_0). Nothing of F enters: the model passes smoothly
/// through simple branch points, and goes on beyond its ends as the curve did before.
class ArcModel {
 public:
  static constexpr std::size_t most_nodes = 10;

  /// Takes the place of what the arc was before; its storage is used again.
  /// @param nodes  in order along the curve, on one piece, not more than `most_nodes`
  /// @returns false, and is empty, where they do not lie evenly ahead along the tangent at `origin`
  bool go_through(const Vector& weights, const CurvePoint& origin, Samples nodes);

  /// The same of nodes in any order.
  /// @returns false, and is empty, where one is not ahead along the tangent at `origin`, or two lie at one way
  bool interpolate(const Vector& weights, const CurvePoint& origin, Samples nodes);

  bool empty() const { return knots_ == 0; }
  double begin() const { return at_[0]; }
  double end() const { return at_[knots_ - 1]; }

  /// u(t) and du/dt, n + 1 numbers each. @param left_out  so many of the last nodes: the polynomial through the others
  void evaluate(double t, Vector& u, Vector& rate, Index left_out = 0) const;

  /// dlambda/dt.
  double rate_of_lambda(double t) const;

  /// The model's own point, with its unit tangent; s is that of the origin and t.
  void point(const Vector& weights, const CurvePoint& origin, double t, CurvePoint& point) const;

 private:
  std::array<double, 2 * most_nodes> at_{};
  std::size_t knots_ = 0;
  Matrix c_{};  ///< divided differences, one column per knot
  mutable Vector u_{}, rate_{};
};

/// The way from the origin along its tangent to where a point lies.
double way_to(const Vector& weights, const CurvePoint& origin, const CurvePoint& point);

/// How far a model passes from a point.
double distance_of(const Walker& walker, const ArcModel& model, const CurvePoint& origin,
                   const CurvePoint& point);

/// Points of a curve on one smooth piece, in order.
using Stretch = std::vector<CurvePoint>;

/// The points of a curve, in the engine's own units, parted at kinks and where the piece changes, up to the special
/// point that ended it. Each is seen from the one before: a closed curve may end at another copy of its start, whole
/// periods away.
std::vector<Stretch> smooth_stretches(const Walker& walker, const Normalised& own,
                                      const Curve& curve);

}  // namespace springfold::continuation
