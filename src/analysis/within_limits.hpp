// Curves that stay within the limits of a study. Private to analysis.
#pragma once

#include "asking.hpp"
#include "limits.hpp"
#include "springfold/continuation/trace.hpp"
#include "ways_on.hpp"

namespace springfold::analysis {

/// A curve that begins on a limit and leads out of the range, slowly or after a bend, ends where it leaves: takes back
/// the points beyond, if the observer stopped it there or it joined a branch there.
void cut_to_range(const Study& study, const Evaluator& evaluator,
                  const std::vector<QuantityDefinition>& quantities, continuation::Curve& curve);

/// What a curve is followed with; the references must outlive it.
struct Following {
  const PathProblem& problem;
  const Study& study;
  const Evaluator& evaluator;
  const std::vector<QuantityDefinition>& quantities;
  const AskedProblem* asked = nullptr;  ///< the problem, if steps are given up half-way on request
};

/// The curve from the start along the ray, as the study's path says, within its limits also where it begins on one.
/// @param events  of the study (events_of)
/// @param at_hit  with path = "arc_length" only
continuation::Curve trace_within_limits(
    const Following& with, const continuation::CurvePoint& start, const continuation::Ray& ray,
    const std::vector<continuation::Event>& events, const continuation::TraceOptions& options,
    const continuation::StepObserver& observer = {}, const continuation::HitObserver& at_hit = {});

/// As trace_within_limits(), along a way on from a special point.
continuation::Curve curve_within_limits(const Following& t, const WayOn& way,
                                        const std::vector<continuation::Event>& events,
                                        const continuation::TraceOptions& options,
                                        const continuation::StepObserver& observer);

}  // namespace springfold::analysis
