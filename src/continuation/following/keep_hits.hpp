// What a curve keeps of what was found on a step. Private to the engine.
#pragma once

#include <vector>

#include "continuation/kinks/beside.hpp"
#include "continuation/kinks/kink_passage.hpp"
#include "continuation/points/samples.hpp"
#include "springfold/continuation/trace.hpp"

namespace springfold::continuation {

/// Keeps the special points of a step and, between any two, a point of the curve with the index there.
/// @returns whether the curve ends at one of them
bool keep(const Walker& walker, Samples samples, const HitObserver& at_hit, StepEvents& found,
          Curve& curve);

/// The way to a surface just beside the singular point that the curve leaves, and past it: nothing of the engine's own lies
/// on it, events of the caller may.
Outcome pass_opening(const Walker& walker, const std::vector<Event>& events,
                     const HitObserver& at_hit, const Opening& opening, Progress& progress,
                     Curve& curve);

}  // namespace springfold::continuation
