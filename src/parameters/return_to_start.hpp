// Curves that are followed in stretches, and may be closed. Private to the layer.
#pragma once

#include <optional>

#include "parameters/augmented.hpp"
#include "springfold/continuation/newton.hpp"
#include "springfold/continuation/stretches.hpp"

namespace springfold::continuation {

/// Does a later stretch come back to the start of the first one? Within the first one `trace` sees that itself.
class ReturnToStart {
 public:
  /// @param length  of the stretches before, 0: this is the first one
  ReturnToStart(const Augmented& system, const TraceOptions& options, const CurvePoint& start,
                double length, CurvePoint here)
      : system_{system}, options_{options}, start_{start}, length_{length}, here_{std::move(here)} {
    here_.s = length;
  }

  /// Does the step to this point, the next one, pass the start?
  bool with(CurvePoint point) {
    if (length_ == 0) return false;
    point.s += length_;
    found_ = start_again(system_, options_, start_, here_, point);
    const Direction chord{point.x - here_.x, point.lambda - here_.lambda};
    turned_ = found_ && metric_product(system_.metric(), start_.tangent, chord) <= 0;
    if (turned_) found_.reset();
    if (found_) found_->s -= length_;
    here_ = std::move(point);
    return found_ || turned_;
  }

  /// Has it come back to the start the way it left it?
  bool turned() const { return turned_; }

  /// The start in this passage, with the arc length of the stretch.
  const std::optional<CurvePoint>& found() const { return found_; }

 private:
  const Augmented& system_;
  const TraceOptions& options_;
  const CurvePoint& start_;
  double length_ = 0;
  CurvePoint here_{};
  std::optional<CurvePoint> found_{};
  bool turned_ = false;
};

/// A stretch that comes back to the start of the curve the way this left it, or to its own, has not come round: it
/// turned where its slope jumps, as at the kink of what is zero. It ends.
/// @param length  of the stretches before
inline void end_where_it_turned(const Augmented& system, const ReturnToStart& back, double length,
                                Curve& curve) {
  if (back.found() || (curve.stop != StopReason::closed && !back.turned())) return;
  const auto& points = curve.points;
  const std::size_t count = points.size();
  const auto chord = [&](std::size_t from) {
    return Direction{points[from + 1].x - points[from].x,
                     points[from + 1].lambda - points[from].lambda};
  };
  const bool comes_round = !back.turned() && length == 0 && count > 2 &&
                           metric_product(system.metric(), chord(0), chord(count - 2)) > 0;
  if (comes_round) return;
  const double turned = points.front().s + (points.back().s - points.front().s) / 2;
  std::erase_if(curve.points, [turned](const CurvePoint& point) { return point.s > turned; });
  std::erase_if(curve.hits, [turned](const Hit& hit) { return hit.point.s > turned; });
  curve.stop = StopReason::step_too_small;
  curve.stop_detail =
      "the curve comes back the way it went: where its slope jumps it was not led on";
}

}  // namespace springfold::continuation
