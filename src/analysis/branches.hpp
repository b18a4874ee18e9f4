// A study's bifurcation diagram: the engine's branches and junctions as a result. Private to analysis.
#pragma once

#include "quantities.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/continuation/diagram.hpp"

namespace springfold::analysis {

/// What is needed to trace a study; the references must outlive it.
struct Tracing {
  const PathProblem& problem;
  const Study& study;
  const Evaluator& evaluator;
  const std::vector<QuantityDefinition>& quantities;
  const Observer& observer;
  double lambda_scale = 1;  ///< physical lambda = lambda_scale * dimensionless lambda
};

continuation::TraceOptions options_of(const TraceSettings& settings);

/// Traces the branches of the start and of all special points to the study's depth, searches where
/// the study says so, and writes branches, junctions, searches, doubts and the start's ways.
void trace_branches(const Tracing& tracing, const continuation::CurvePoint& start,
                    StudyResult& result);

}  // namespace springfold::analysis
