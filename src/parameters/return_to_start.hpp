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
    if (found_) found_->s -= length_;
    here_ = std::move(point);
    return found_.has_value();
  }

  /// The start in this passage, with the arc length of the stretch.
  const std::optional<CurvePoint>& found() const { return found_; }

 private:
  const Augmented& system_;
  const TraceOptions& options_;
  const CurvePoint& start_;
  double length_ = 0;
  CurvePoint here_{};
  std::optional<CurvePoint> found_{};
};

}  // namespace springfold::continuation
