#include "springfold/analysis/run.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "branches.hpp"
#include "case_curves.hpp"
#include "closure_rank.hpp"
#include "cpu_time.hpp"
#include "equilibria.hpp"
#include "held_twice.hpp"
#include "lambda_crawl.hpp"
#include "limits.hpp"
#include "parameter_rules.hpp"
#include "put_to_rest.hpp"
#include "run_kinds.hpp"
#include "run_traced.hpp"
#include "settle_units.hpp"
#include "springfold/analysis/snap.hpp"
#include "springfold/continuation/trace.hpp"
#include "springfold/core/number_text.hpp"
#include "start.hpp"
#include "start_sides.hpp"
#include "start_trouble.hpp"
#include "trace_study.hpp"
#include "zero_lengths.hpp"

namespace springfold::analysis {
namespace {

using continuation::CurvePoint;

void report_tangent(const Evaluator& evaluator, const CurvePoint& start, const Vector& z,
                    StartReport& report) {
  report.tangent = evaluator.tangent_eigenvalues(start);
  report.zero_modes = static_cast<int>(evaluator.zero_modes(start));
  if (report.zero_modes > 0)
    report.free_motions = free_motions(evaluator.problem().system(start.lambda), z,
                                       evaluator.problem().inputs(start.lambda));
}

/// The start violates closures that were taken as redundant.
void refuse_contradiction(const Evaluator& evaluator, const CurvePoint& start,
                          StartReport& report) {
  if (!closures_contradict(evaluator.problem(), start)) return;
  report.found = false;
  report.advice = "give one of the chains an elasticity";
  report.message =
      "the redundant closures contradict each other under this load: a rigid mechanism "
      "would have to give way";
}

void refuse_no_direction(const Setup& setup, const statics::FirstEquilibrium& first,
                         StartReport& report) {
  const auto spring = without_direction(setup.system, first.z, first.inputs);
  if (!spring) return;
  report.found = false;
  report.advice = "guess a state farther from there, or give the spring another end";
  report.message = "spring " + *spring +
                   " has the length 0 where the start was looked for: its force has no direction "
                   "there, and whether that is an equilibrium is not known";
}

/// Every point of the path holds what the joints hold: no curve is determined.
void refuse_held_twice(const Evaluator& evaluator, const Study& study, const CurvePoint& start,
                       StartReport& report) {
  if (study.kind != StudyKind::force_deflection || !holds_twice(evaluator.problem(), study, start))
    return;
  report.found = false;
  report.message = held_twice;
  report.where = "control";
  report.advice = held_twice_advice;
}

void report_range(const Study& study, const Evaluator& evaluator,
                  const std::vector<QuantityDefinition>& quantities, const CurvePoint& start,
                  StartReport& report) {
  if (study.kind != StudyKind::force_deflection) return;
  const auto outside = outside_start(study, evaluator, quantities, start);
  if (!outside) return;
  report.outside = outside->text;
  report.where = "until." + outside->quantity;
  report.advice = outside_advice;
}

/// The same study of commands with its first target alone.
Study first_target(Study study) {
  ControlPath& path = study.targets;
  if (path.circle) {
    path.circle_points = 1;
    path.circle->to = path.circle->from;
  } else {
    path.targets.resize(1);
  }
  path.loads.resize(std::min<std::size_t>(path.loads.size(), 1));
  return study;
}

RedundantClosures redundant_closures(const Setup& setup) {
  const statics::Redundancy& from = setup.redundancy;
  RedundantClosures to{.count = static_cast<int>(from.count),
                       .of = static_cast<int>(setup.system.closure_count())};
  for (const std::size_t chain : from.chains)
    to.chains.push_back(setup.system.mechanism.chains[chain].name);
  to.smallest_kept = from.smallest_kept;
  to.largest_dropped = from.largest_dropped;
  return to;
}

}  // namespace

void require_usable(const model::Mechanism& mechanism, const Study& study) {
  std::vector<std::string> problems = model::problems_in(mechanism);
  if (problems.empty()) problems = problems_in(study, mechanism);
  if (problems.empty()) return;
  std::string all;
  for (const std::string& problem : problems) all += (all.empty() ? "" : "; ") + problem;
  throw std::invalid_argument(all);
}

StudyResult run_study(const model::Mechanism& mechanism, const Study& study,
                      const ParameterFamily* family, const Observer& observer,
                      const RunOptions& options) {
  require_usable(mechanism, study);
  if (study.kind == StudyKind::force_deflection && study.control == ControlMode::parameter &&
      family == nullptr)
    throw std::invalid_argument("control: parameter needs a family of mechanisms");
  if (study.kind == StudyKind::control) return run_control(mechanism, study, observer);
  if (study.kind == StudyKind::map) return run_map(mechanism, study, observer, options);
  if (study.kind == StudyKind::workspace) return run_workspace(mechanism, study, observer);
  if (is_of_critical_points(study.kind)) {
    StudyResult result = run_critical(study, observer);
    result.non_conservative = non_conservative_loads(mechanism, study);
    return result;
  }
  if (study.snap) {
    SnapResult with_jumps = run_with_jumps(mechanism, study, family, *study.snap, observer);
    with_jumps.traced.snap = std::make_shared<const SnapReport>(std::move(with_jumps.report));
    return std::move(with_jumps.traced);
  }
  return run_from_start(mechanism, study, family, observer, {});
}

namespace {

/// A study whose start is found.
struct Begun {
  const model::Mechanism& mechanism;
  const Study& study;
  const ParameterFamily* family;
  const Observer& observer;
  const TraceBy& trace_by;
};

/// The units that it is traced in, and its start in them.
struct InUnits {
  Setup setup;
  statics::FirstEquilibrium first;
};

/// In what lambda is to be measured instead.
struct LambdaAsked {
  double factor = 1;  ///< by which its unit should grow, and the result is worthless; 1: done
  bool is_straight = false;  ///< the curve goes straight along lambda all the way
};

void report_start(const Evaluator& evaluator, const CurvePoint& start, StartReport& report) {
  report.stiffness = evaluator.platform_stiffness(start);
  report.compliance = evaluator.rigid_compliance(start);
  report.sides = sides_of_start(evaluator, start);
  report.chain_stiffnesses = evaluator.chain_stiffnesses(start);
}

/// Has the unit of lambda judged by how steep the curve is at the start; where several curves leave it, none is asked.
void watch_lambda(const Tracing& t, const CurvePoint& start) {
  const auto rays =
      rays_from(t.problem, start.x, start.lambda, start.piece, options_of(t.study.trace));
  if (rays.rays.size() == 2 && rays.complete) t.crawl.begin(rays.rays.front().tangent);
}

/// @param largest  factor by which the unit of lambda may still grow
LambdaAsked run_in_units(const Begun& begun, const InUnits& units, double largest,
                         StudyResult& result) {
  const Study& study = begun.study;
  Setup setup = units.setup;
  begin_at(study, units.first, setup);
  const PathProblem problem(setup.system, setup.rule);
  const Evaluator evaluator(problem, study, setup.scales);
  const auto quantities =
      quantities_of(study, setup.system, setup.scales, setup.lambda_scale, result.lambda_unit);
  CurvePoint start = start_point(problem, setup, units.first);
  count_negative(problem, start);
  refuse_contradiction(evaluator, start, result.start);
  refuse_no_direction(setup, units.first, result.start);
  refuse_held_twice(evaluator, study, start, result.start);
  if (!result.start.found) return {};
  report_tangent(evaluator, start, units.first.z, result.start);
  report_range(study, evaluator, quantities, start, result.start);
  report_start(evaluator, start, result.start);
  RowBudget budget;
  LambdaCrawl crawl(problem, largest, range_of_lambda(study, setup));
  const Asking asking(begun.observer);
  const Observer observer = [&asking](int points, double s) { return asking.step(points, s); };
  const Tracing tracing{problem, study, evaluator, quantities, observer, setup.lambda_scale,
                        budget,  crawl, asking};
  if (study.kind == StudyKind::equilibrium) {
    result.start.situation = situation_of(tracing, start, {});
    result.branches.push_back(single_point(start, evaluator, quantities, problem));
  } else if (begun.trace_by) {
    watch_lambda(tracing, start);
    begun.trace_by(tracing, setup.scales, start, result);
  } else {
    trace_study(tracing, start, result);
  }
  if (begun.family != nullptr && study.control == ControlMode::parameter && crawl.factor() == 1)
    doubt_broken_rules(study, *begun.family, quantities, result);
  if (!budget.refused.empty()) result.doubts.push_back(budget.refused);
  return {crawl.factor(), crawl.goes_straight()};
}

bool has_unresolved(const StudyResult& result) {
  const auto is_unresolved = [](const Event& e) { return e.kind == EventKind::unresolved; };
  return std::ranges::any_of(result.branches, [&](const Branch& branch) {
    return std::ranges::any_of(branch.events, is_unresolved);
  });
}

/// From the start, again and again until no other unit of lambda is asked for. Beside a critical load that is far below
/// its range a curve bends sharply and becomes steep: in the larger unit that may be missed. Parts of lambda take more
/// points, and digits of the works of jumps and cycles, so that they come second, and not at all where those are asked
/// for.
/// @param empty  what is known before
StudyResult run_in_growing_units(const Begun& begun, InUnits units, const StudyResult& empty) {
  const bool begins_long = is_of_many_sizes(range_of_lambda(begun.study, units.setup));
  std::optional<InUnits> finest;  // the first ones, once others are tried
  std::optional<InUnits> before_steep;
  double largest = largest_change_of_lambda_unit;
  for (;;) {
    StudyResult result = empty;
    const LambdaAsked asked = run_in_units(begun, units, largest, result);
    if (asked.factor > 1) {
      if (begins_long && !finest && !begun.trace_by) finest = units;
      const bool is_long = is_of_many_sizes(range_of_lambda(begun.study, units.setup));
      if (is_long && asked.is_straight) {
        measure_lambda_in_parts(units.setup);
        largest = 1;
        continue;
      }
      if (is_long && asked.factor >= long_beside_first_load && !before_steep) before_steep = units;
      largest /= asked.factor;
      enlarge_lambda_unit(begun.mechanism, begun.study, begun.family, asked.factor, units.first,
                          units.setup);
      continue;
    }
    if (begun.trace_by || !has_unresolved(result)) return result;
    if (!begins_long && !before_steep) return result;
    InUnits& parts = before_steep ? *before_steep : finest ? *finest : units;
    measure_lambda_in_parts(parts.setup);
    StudyResult in_parts = empty;
    run_in_units(begun, parts, 1, in_parts);
    return complete(in_parts) ? in_parts : result;
  }
}

}  // namespace

StudyResult run_from_start(const model::Mechanism& given, const Study& study,
                           const ParameterFamily* family, const Observer& observer,
                           const TraceBy& trace_by) {
  const double began = thread_seconds();
  StudyResult result;
  result.study = study.name;
  auto [mechanism, setup, first] = begin_study(given, study, family, result.start);
  result.lambda_unit = lambda_unit_of(study, setup.system);
  result.non_conservative = non_conservative_loads(mechanism, study);
  if (result.start.found) settle_units(mechanism, study, family, first, setup);
  const auto quantities =
      quantities_of(study, setup.system, setup.scales, setup.lambda_scale, result.lambda_unit);
  for (const QuantityDefinition& q : quantities) result.quantities.push_back({q.name, q.unit});
  result.start.redundant = redundant_closures(setup);
  if (study.kind == StudyKind::equilibria) {
    begin_at(study, first, setup);
    find_equilibria(setup, study, first, observer, result);
  } else if (result.start.found) {
    result = run_in_growing_units({mechanism, study, family, observer, trace_by},
                                  {std::move(setup), std::move(first)}, result);
  }
  result.seconds = thread_seconds() - began;
  return result;
}

namespace {

/// The study as its first curve is traced. Where the start moves with a parameter that the study varies, only limits on
/// lambda say something of all starts.
Study first_curve_of(const Study& study) {
  if (!is_of_critical_points(study.kind)) return study;
  Study curve = as_curve(study);
  if (study.kind != StudyKind::critical_curve && study.kind != StudyKind::sensitivity)
    std::erase_if(curve.until, [](const Limit& limit) { return limit.quantity != "lambda"; });
  return curve;
}

}  // namespace

std::optional<StartReport> solve_start(const model::Mechanism& given, const Study& of,
                                       const ParameterFamily* family) {
  require_usable(given, of);
  const bool can_trace = of.control != ControlMode::parameter || family != nullptr;
  const Study study = can_trace ? first_curve_of(of) : of;
  if (study.kind == StudyKind::control) return run_control(given, first_target(study), {}).start;
  if (is_of_commands(study.kind)) return std::nullopt;
  StartReport report;
  auto [mechanism, setup, first] = begin_study(given, study, family, report);
  if (report.found) settle_units(mechanism, study, family, first, setup);
  report.redundant = redundant_closures(setup);
  if (!report.found || study.kind == StudyKind::equilibria) return report;
  const auto quantities = quantities_of(study, setup.system, setup.scales, setup.lambda_scale,
                                        lambda_unit_of(study, setup.system));
  begin_at(study, first, setup);
  const PathProblem problem(setup.system, setup.rule);
  const Evaluator evaluator(problem, study, setup.scales);
  CurvePoint start = start_point(problem, setup, first);
  count_negative(problem, start);
  refuse_contradiction(evaluator, start, report);
  refuse_held_twice(evaluator, study, start, report);
  if (!report.found) return report;
  report_tangent(evaluator, start, first.z, report);
  report_range(study, evaluator, quantities, start, report);
  return report;
}

}  // namespace springfold::analysis
