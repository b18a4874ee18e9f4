// Events on one step, for the tracer. Private to the engine.
#pragma once

#include <vector>

#include "continuation/locating/singular.hpp"

namespace springfold::continuation {

/// A walker that looks for the caller's events only.
Walker without_special_points(const Walker& walker);

/// In the order of s; hits at one place as they were.
void sort_by_place(std::vector<Hit>& hits);

/// All smooth special points on the step from -> to, and events of the caller.
/// @param middle  the curve's point half-way, or nullptr: then only the ends are compared
StepEvents events_on_step(const Walker& walker, const CurvePoint& from, const CurvePoint& to,
                          const CurvePoint* middle, const std::vector<Event>& events);

}  // namespace springfold::continuation
