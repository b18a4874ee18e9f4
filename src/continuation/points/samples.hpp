// The points of a step that are known while it is looked into. Private to the engine.
#pragma once

#include <array>
#include <span>

#include "springfold/continuation/curve.hpp"

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

}  // namespace springfold::continuation
