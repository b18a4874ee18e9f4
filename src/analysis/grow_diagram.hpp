// A study's bifurcation diagram: the engine's diagram of the start, and of what searches find.
// Private to analysis.
#pragma once

#include "asking.hpp"
#include "branch_rows.hpp"
#include "lambda_crawl.hpp"
#include "quantities.hpp"
#include "springfold/analysis/row_memory.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/continuation/diagram.hpp"

namespace springfold::analysis {

/// Memory that the rows of one run may still take.
struct RowBudget {
  double bytes = most_memory;
  std::string refused{};  ///< why rows were left out, with what to change; empty if none were
};

/// What is needed to trace a study; the references must outlive it.
struct Tracing {
  const PathProblem& problem;
  const Study& study;
  const Evaluator& evaluator;
  const std::vector<QuantityDefinition>& quantities;
  const Observer& observer;
  double lambda_scale = 1;  ///< physical lambda = lambda_scale * dimensionless lambda
  RowBudget& budget;        ///< for all branches of the run
  LambdaCrawl&
      crawl;  ///< asked at every point; where it sees one, the run is to begin again in another unit
  const Asking& asking;  ///< also between points
};

continuation::TraceOptions options_of(const TraceSettings& settings);

/// Points for rows between those of the steps, if the study wants them and their memory is there.
void add_between(const Tracing& tracing, BranchSource& source);

struct Grown {
  continuation::Diagram diagram{};
  std::vector<continuation::DiagramStart>
      starts{};  ///< the study's own, then those that were found
  std::vector<Search> searches{};
  std::vector<std::string> doubts{};  ///< what an interruption left undone
};

/// Traces the branches of the start and of all special points to the study's depth. At every lambda
/// that the study names, further equilibria are searched for, in order; where some are found, all
/// is traced again with them as further starts.
/// @param further  other starts beside the study's own
Grown grow_diagram(const Tracing& tracing, const continuation::CurvePoint& start,
                   const std::vector<continuation::DiagramStart>& further = {});

}  // namespace springfold::analysis
