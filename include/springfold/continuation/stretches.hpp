// For callers that follow a curve in stretches: what a trace knows of the inside of its steps, and closed curves.
#pragma once

#include <optional>
#include <vector>

#include "springfold/continuation/between.hpp"
#include "springfold/continuation/trace.hpp"

namespace springfold::continuation {

/// trace() from a point of one piece, which hands over the corrected points half-way of its steps, in the order of s.
Curve trace_with_middles(ProblemView problem, const Vector& x, double lambda, const Ray& start,
                         const std::vector<Event>& events, const TraceOptions& options,
                         const StepObserver& observer, std::vector<CurvePoint>& middles);

/// points_between() that need not look for points which are known. @param middles in the order of s; those of other
/// steps are left alone
Between points_between(ProblemView problem, const Curve& curve,
                       const std::vector<CurvePoint>& middles, double spacing,
                       const TraceOptions& options);

/// The start of a curve, if a step from -> to of another stretch of it passes it again in the direction in which the
/// curve left it. Given with the tangent and the arc length of this passage.
std::optional<CurvePoint> start_again(ProblemView problem, const TraceOptions& options,
                                      const CurvePoint& start, const CurvePoint& from,
                                      const CurvePoint& to);

}  // namespace springfold::continuation
