// Evidence that a step stayed on its curve and passed nothing unseen. Private to the engine.
#pragma once

#include <string>

#include "continuation/points/step.hpp"

namespace springfold::continuation {

/// What was learnt about the inside of an accepted step.
struct Evidence {
  std::optional<CurvePoint> middle{};  ///< the curve's own point half-way, corrected
  std::string doubt{};                 ///< set: the step is not to be trusted; why, in words
};

/// Looks inside the step from -> to, ds long:
///
///  - the residual along the predicted way must grow like the square of the distance. If
///    another branch was crossed on the way, it goes up and down instead;
///  - the point half-way, corrected from a guess that knows nothing of `to`, must lie on the cubic that the two ends and their
///    tangents define, and the three tangents, integrated, must lead from one end to the other. A
///    step that landed on a neighbour has the wrong chord for its tangents.
///
/// Sampling, not proof: a feature much narrower than an eighth of the step can escape it.
Evidence examine(const Walker& walker, const CurvePoint& from, const CurvePoint& to);

}  // namespace springfold::continuation
