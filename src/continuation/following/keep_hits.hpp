// What a curve keeps of what was found on a step. Private to the engine.
#pragma once

#include <vector>

#include "continuation/kinks/beside.hpp"
#include "continuation/kinks/kink_passage.hpp"
#include "continuation/points/arc.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/continuation/trace.hpp"

namespace springfold::continuation {

/// Keeps the special points of a step and, between any two, a point of the curve with the index there.
/// @param ends_at_kink  the end of the step will be one more
/// @returns whether the curve ends at one of them
bool keep(const Walker& walker, Samples samples, bool ends_at_kink, const HitObserver& at_hit,
          const StepEvents& found, Curve& curve);

/// The way to a surface just beside the singular point that the curve leaves, and past it: nothing of the engine's own
/// lies on it, events of the caller may.
Outcome pass_opening(const Walker& walker, const std::vector<Event>& events,
                     const HitObserver& at_hit, const Opening& opening, Progress& progress,
                     Curve& curve);

/// Steps are not shortened below this to separate special points; what is left is one cluster.
inline constexpr double unresolved_length = poor;

/// Neighbouring unresolved steps are one cluster with its total multiplicity.
void add_unresolved(const CurvePoint& from, const CurvePoint& to, const StepEvents& found,
                    Curve& curve);

/// Steps may end where an eigenvalue is zero to rounding. From the last point before them with a count of negative
/// eigenvalues to the new one, the special points must explain its change.
void account_over_gap(Curve& curve);

}  // namespace springfold::continuation
