// What a trace knows of the inside of its steps, for points between them. Private to the engine.
#pragma once

#include <vector>

#include "springfold/continuation/between.hpp"
#include "springfold/continuation/trace.hpp"

namespace springfold::continuation {

/// trace() from a point of one piece, which hands over the corrected points half-way of its steps, in the order of s.
Curve trace_with_middles(ProblemView problem, const Vector& x, double lambda, const Ray& start,
                         const std::vector<Event>& events, const TraceOptions& options,
                         const StepObserver& observer, std::vector<CurvePoint>& middles);

/// points_between() that need not look for points which are known. @param middles  in the order of s; those of other steps
/// are left alone
Between points_between(ProblemView problem, const Curve& curve,
                       const std::vector<CurvePoint>& middles, double spacing,
                       const TraceOptions& options);

}  // namespace springfold::continuation
