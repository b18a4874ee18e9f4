#include "springfold/analysis/run.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <ctime>

#include "branch_rows.hpp"
#include "branches.hpp"
#include "closure_rank.hpp"
#include "equilibria.hpp"
#include "limits.hpp"
#include "run_kinds.hpp"
#include "springfold/continuation/davidenko.hpp"
#include "springfold/continuation/trace.hpp"
#include "start.hpp"

namespace springfold::analysis {
namespace {

using continuation::CurvePoint;

/// The branch through an ordinary start point alone.
Branch trace_both_ways(const Tracing& t, const CurvePoint& start, continuation::Rays rays) {
  const continuation::TraceOptions options = options_of(t.study.trace);
  // Forward is where lambda grows.
  if (rays.rays[0].tangent.dlambda < rays.rays[1].tangent.dlambda)
    std::swap(rays.rays[0], rays.rays[1]);
  const auto events = events_of(t.study, t.evaluator, t.quantities);
  int points = 1;
  const auto observe = [&](double sign) {
    return [&points, &t, sign](const CurvePoint& point) {
      ++points;
      return !t.observer || t.observer(points, sign * point.s);
    };
  };
  const auto follow = [&](const continuation::Ray& ray, double sign) {
    auto ended = ended_at_start(t.study, t.evaluator, t.quantities, start, ray);
    if (ended) return *ended;
    return t.study.path == Path::davidenko
               ? davidenko(t.problem, start.x, start.lambda, ray, events, options, observe(sign))
               : trace(t.problem, start.x, start.lambda, ray, events, options, observe(sign));
  };
  BranchSource source;
  source.forward = follow(rays.rays[0], 1);
  source.backward = source.forward.stop == continuation::StopReason::closed
                        ? nothing_behind(source.forward)
                        : follow(rays.rays[1], -1);
  source.forward_stop = stop_of(source.forward);
  source.backward_stop = stop_of(source.backward);
  add_between(t, source);
  std::vector<BranchRows> rows{join(std::move(source), t.evaluator, t.quantities, t.problem)};
  label_events(rows, 0, t.quantities);
  return std::move(rows.front().branch);
}

/// What is special about a start, as far as it is seen at once; branch points are found later.
std::string situation_of(const Tracing& t, const CurvePoint& start,
                         const continuation::Rays& rays) {
  Vector g;
  std::string names;
  if (t.problem.switches(start.x, start.lambda, g))
    for (Index j = 0; j < g.size(); ++j)
      if (std::abs(g[j]) <= 1e-10) names += (names.empty() ? "" : ", ") + t.problem.switch_name(j);
  if (!names.empty()) return "on the threshold of " + names;
  const bool turns =
      !rays.rays.empty() && std::all_of(rays.rays.begin(), rays.rays.end(), [](const auto& ray) {
        return std::abs(ray.tangent.dlambda) < 1e-6;
      });
  return turns && rays.rays.size() == 2 ? "a limit point" : "";
}

Branch not_traced(const Tracing& t, const CurvePoint& start, const std::string& why) {
  Branch branch = single_point(start, t.evaluator, t.quantities, t.problem);
  branch.forward = branch.backward = {why, false};
  return branch;
}

/// A start that several curves leave needs the diagram, whatever the study asks for: none of them is
/// picked.
void trace_study(const Tracing& t, const CurvePoint& start, StudyResult& result) {
  const BranchSettings& wanted = t.study.branches;
  const auto rays =
      rays_from(t.problem, start.x, start.lambda, start.piece, options_of(t.study.trace));
  const bool ordinary = rays.rays.size() == 2 && rays.complete;
  result.start.situation = situation_of(t, start, rays);
  const auto outside = limit_passed(t.study, t.evaluator, t.quantities, start);
  if (ordinary && (outside || (wanted.depth == 0 && wanted.search_at.empty()))) {
    if (!result.start.situation.empty())
      for (const continuation::Ray& ray : rays.rays) {
        CurvePoint along = start;
        along.tangent = ray.tangent;
        along.piece = ray.piece;
        result.start.ways.push_back({t.evaluator.rates(t.quantities, along), 1});
      }
    result.branches.push_back(trace_both_ways(t, start, rays));
    return;
  }
  const std::string why =
      rays.why.empty() ? std::to_string(rays.rays.size()) + " ways lead out of it" : rays.why;
  const auto singular = kinematic_singularity(t.problem, start);
  if (outside || t.study.path == Path::davidenko) {
    result.branches.push_back(
        not_traced(t, start, "the start is not an ordinary point of a curve: " + why));
  } else {
    trace_branches(t, start, result);
    if (result.branches.empty())
      result.branches.push_back(
          not_traced(t, start, "no curve was found to leave the start: " + why));
  }
  if (singular) result.start.situation = "a " + *singular;
}

/// A start that was held by a wrench stays held in the directions that the study leaves free.
void hold_free_part(const Study& study, const statics::FirstEquilibrium& first, Setup& setup) {
  const auto& body = setup.system.body_slices[static_cast<std::size_t>(study.body - 1)];
  const Vector extra = (first.inputs.W - setup.rule.W_start).segment(body.W, body.count);
  const Vector held = setup.rule.N * (setup.rule.N.transpose() * extra);
  setup.rule.W_start.segment(body.W, body.count) += held;
  const bool is_spatial =
      setup.system.mechanism.bodies[static_cast<std::size_t>(study.body - 1)].task_space ==
      model::TaskSpace::spatial;
  if (is_spatial && held.tail(3).lpNorm<Eigen::Infinity>() > 1e-12 * held.norm())
    setup.rule.symmetric = false;  // a moment about fixed axes holds it
}

void report_tangent(const Evaluator& evaluator, const CurvePoint& start, StartReport& report) {
  report.tangent = evaluator.tangent_eigenvalues(start);
  report.zero_modes = static_cast<int>(evaluator.zero_modes(start));
}

/// The start violates closures that were taken as redundant.
void refuse_contradiction(const Evaluator& evaluator, const CurvePoint& start,
                          StartReport& report) {
  if (evaluator.closure_gap(start) <= allowed_closure_gap) return;
  report.found = false;
  report.message =
      "the redundant closures contradict each other under this load: a rigid mechanism "
      "would have to give way; give one of the chains an elasticity";
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

StudyResult run_study(const model::Mechanism& mechanism, const Study& study,
                      const ParameterFamily* family, const Observer& observer,
                      const RunOptions& options) {
  assert(problems_in(study, mechanism).empty());
  if (study.kind == StudyKind::control) return run_control(mechanism, study, observer);
  if (study.kind == StudyKind::map) return run_map(mechanism, study, observer, options);
  if (study.kind == StudyKind::workspace) return run_workspace(mechanism, study);
  const std::clock_t began = std::clock();
  StudyResult result;
  result.study = study.name;
  Setup setup = set_up(mechanism, study, family);
  result.lambda_unit = lambda_unit_of(study, setup.system);
  const auto quantities =
      quantities_of(study, setup.system, setup.scales, setup.lambda_scale, result.lambda_unit);
  for (const QuantityDefinition& q : quantities) result.quantities.push_back({q.name, q.unit});

  result.non_conservative = non_conservative_loads(mechanism, study);
  const statics::FirstEquilibrium first = find_start(setup, study, result.start);
  result.start.redundant = redundant_closures(setup);
  if (study.kind == StudyKind::equilibria) {
    setup.rule.t_start = Vector::Zero(setup.rule.t_rate.size());
    setup.rule.rho_start = first.inputs.rho;
    hold_free_part(study, first, setup);
    find_equilibria(setup, study, first, result);
  } else if (result.start.found) {
    const auto& body = setup.system.body_slices[static_cast<std::size_t>(study.body - 1)];
    setup.rule.t_start = first.z.segment(body.t, body.count);
    setup.rule.rho_start = first.inputs.rho;
    hold_free_part(study, first, setup);
    const PathProblem problem(setup.system, setup.rule);
    const Evaluator evaluator(problem, study, setup.scales);
    CurvePoint start;
    start.x = problem.reduce(first.z);
    start.lambda = setup.lambda_start;
    start.piece = first.piece;
    count_negative(problem, start);
    refuse_contradiction(evaluator, start, result.start);
    if (!result.start.found) return result;
    report_tangent(evaluator, start, result.start);
    result.start.stiffness = evaluator.platform_stiffness(start);
    result.start.compliance = evaluator.rigid_compliance(start);
    result.start.chain_stiffnesses = evaluator.chain_stiffnesses(start);
    if (study.kind == StudyKind::equilibrium)
      result.branches.push_back(single_point(start, evaluator, quantities, problem));
    else
      trace_study({problem, study, evaluator, quantities, observer, setup.lambda_scale}, start,
                  result);
  }
  result.seconds = static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
  return result;
}

}  // namespace springfold::analysis
