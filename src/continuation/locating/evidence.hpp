// Evidence that a step stayed on its curve and passed nothing unseen. Do the equations determine a point, or could
// rounding have put it on another branch? Private to the engine.
#pragma once

#include <string>

#include "continuation/points/step.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {

class TestedStep;

/// What was learnt about the inside of an accepted step.
struct Evidence {
  std::optional<CurvePoint> middle{};  ///< the curve's own point half-way, corrected
  std::string doubt{};                 ///< set: the step is not to be trusted; why, in words
};

/// Looks inside the step from -> to, ds long:
///
///  - the residual along the predicted way must grow like the square of the distance. If
///    another branch was crossed on the way, it goes up and down instead;
///  - the point half-way, corrected from a guess that knows nothing of `to`, must lie on the cubic that the two ends
///    and their tangents define, and the three tangents, integrated, must lead from one end to the other. A step that
///    landed on a neighbour has the wrong chord for its tangents.
///
/// Sampling, not proof: a feature much narrower than an eighth of the step can escape it.
Evidence examine(const Walker& walker, const CurvePoint& from, const CurvePoint& to);

/// A corrected point is off by what is left of F, at least its rounding, over the smallest singular value of E. Another
/// branch is as far away as that singular value over the second derivative in the weakest direction. The first must be
/// much smaller than the second: E may not change by more than a share of itself when the point is moved by it, both
/// ways.
/// @param most_blur  by which the point may be off
bool is_determined(const TestedStep& arc, const CurvePoint& point,
                   double most_blur = near_share * told_apart);

struct Separation {
  double blur = 0;  ///< how far rounding may have moved the point
  double distance =
      0;  ///< to the next branch, as the smallest singular value of E and its rate say; infinity: none
};

/// @returns nothing where E is not defined
std::optional<Separation> separation_at(const TestedStep& arc, const CurvePoint& point);

/// What the rounding of a corrected point makes of the value of E along its weakest direction; nothing outside the
/// domain.
std::optional<double> change_of_rounding(const TestedStep& arc, const CurvePoint& point);

/// Does E, in its weakest direction, change by no more than a share of itself within so far of the point?
/// @returns false where E is not defined
bool stays_within(const TestedStep& arc, const CurvePoint& point, double radius, double share);

}  // namespace springfold::continuation
