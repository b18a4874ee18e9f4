// Do the equations determine a point, or could rounding have put it on another branch? Private to the engine.
#pragma once

#include "continuation/locating/watched_step.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {

/// A corrected point is off by what is left of F, at least its rounding, over the smallest singular value of E. Another branch
/// is as far away as that singular value over the second derivative in the weakest direction. The first must be much
/// smaller than the second: E may not change by more than a share of itself when the point is moved by it, both ways.
/// @param most_blur  by which the point may be off
bool is_determined(const WatchedStep& arc, const CurvePoint& point,
                   double most_blur = near_share * told_apart);

struct Separation {
  double blur = 0;  ///< how far rounding may have moved the point
  double distance =
      0;  ///< to the next branch, as the smallest singular value of E and its rate say; infinity: none
};

/// @returns nothing where E is not defined
std::optional<Separation> separation_at(const WatchedStep& arc, const CurvePoint& point);

/// Does E, in its weakest direction, change by no more than a share of itself within so far of the point?
/// @returns false where E is not defined
bool stays_within(const WatchedStep& arc, const CurvePoint& point, double radius, double share);

}  // namespace springfold::continuation
