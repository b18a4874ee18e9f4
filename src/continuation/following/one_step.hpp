// One step of a curve, with all that is found on it. Private to the engine.
#pragma once

#include <string>
#include <vector>

#include "continuation/kinks/kink_passage.hpp"
#include "springfold/continuation/trace.hpp"

namespace springfold::continuation {

/// What a curve is followed with.
struct Following {
  const Walker& walker;
  const std::vector<Event>& events;
  const HitObserver& at_hit;
  std::vector<CurvePoint>* middles = nullptr;  ///< those of accepted steps, if anybody wants them
};

/// What became of a step that was refused.
struct Refusal {
  std::string reason{};
  bool special = false;  ///< because of special points on it
  bool passing = false;  ///< because branches pass each other on it
  bool astray = false;   ///< because it does not continue the step before
};

/// One step: predict, correct, look for switching surfaces and events, record.
/// @param report  special points that cannot be told apart are reported on the shortest steps
/// @returns shorten where the step is refused; `progress` and `curve` are then as they were
Outcome advance(const Following& following, bool report, Progress& progress, Curve& curve,
                Refusal& refused);

}  // namespace springfold::continuation
