#include "springfold/analysis/run.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <ctime>

#include "branch_rows.hpp"
#include "limits.hpp"
#include "setup.hpp"
#include "springfold/continuation/davidenko.hpp"
#include "springfold/continuation/trace.hpp"
#include "springfold/core/inertia.hpp"
#include "springfold/statics/first_equilibrium.hpp"

namespace springfold::analysis {
namespace {

using continuation::CurvePoint;

statics::FirstEquilibrium find_start(const Setup& setup, const Study& study) {
  statics::StartProblem problem;
  problem.body = study.body;
  problem.attempts = study.start.attempts;
  problem.seed = study.start.seed;
  problem.z = statics::guess(setup.system);
  problem.inputs = {setup.system.commands, setup.rule.W_start};
  const auto& body = setup.system.body_slices[static_cast<std::size_t>(study.body - 1)];
  const model::TaskSpace space =
      setup.system.mechanism.bodies[static_cast<std::size_t>(study.body - 1)].task_space;
  if (study.start.pose.size() > 0)
    problem.z.segment(body.t, body.count) =
        study.start.pose.cwiseQuotient(pose_scales(space, setup.scales));
  switch (study.start.solve) {
    case StartSolve::pose:
      problem.unknowns = statics::StartUnknowns::pose;
      break;
    case StartSolve::actuators:
      problem.unknowns = statics::StartUnknowns::commands;
      break;
    case StartSolve::wrench:
      problem.unknowns = statics::StartUnknowns::wrench;
      break;
  }
  if (study.start.solver == StartSolver::fixed_point)
    return statics::first_equilibrium_paper(setup.system, problem);
  return statics::first_equilibrium(setup.system, problem);
}

StartReport report_of(const statics::FirstEquilibrium& first, const Study& study) {
  StartReport report;
  report.found = first.status == statics::StartStatus::found;
  report.method = study.start.solver == StartSolver::newton
                      ? "globalised Newton (KINSOL), then exact Newton"
                      : "fixed-point iteration of paper eq. (6)";
  if (report.found && first.attempts > 1)
    report.method += ", from a perturbed guess: see whether this is the equilibrium you mean";
  report.attempts = first.attempts;
  report.iterations = first.iterations;
  report.chain_iterations = first.chain_iterations;
  report.residual = first.residual;
  switch (first.status) {
    case statics::StartStatus::found:
      break;
    case statics::StartStatus::no_assembly:
      report.message =
          "the chains cannot be closed from this guess: check lengths, attachments, "
          "axes and the initial pose and coordinates";
      break;
    case statics::StartStatus::no_equilibrium:
      report.message = "no equilibrium was found near this guess; the smallest residual is left";
      break;
    case statics::StartStatus::wrong_count:
      report.message = "as many actuated joints as pose coordinates are needed";
      break;
  }
  return report;
}

continuation::TraceOptions options_of(const TraceSettings& settings) {
  continuation::TraceOptions options;
  options.step.initial = settings.initial_step;
  options.step.minimum = settings.minimum_step;
  options.step.maximum = settings.maximum_step;
  options.maximum_points = settings.maximum_points;
  return options;
}

Branch trace_both_ways(const PathProblem& problem, const CurvePoint& start, const Study& study,
                       const Evaluator& evaluator,
                       const std::vector<QuantityDefinition>& quantities,
                       const Observer& observer) {
  const continuation::TraceOptions options = options_of(study.trace);
  continuation::Rays rays = rays_from(problem, start.x, start.lambda, start.piece, options);
  if (rays.rays.size() != 2 || !rays.complete) {
    Branch branch = single_point(start, evaluator, quantities, problem);
    branch.forward = branch.backward = {
        "the start is not a regular point of a curve: " +
            (rays.why.empty() ? std::to_string(rays.rays.size()) + " ways lead out of it"
                              : rays.why),
        false};
    return branch;
  }
  // Forward is where lambda grows.
  if (rays.rays[0].tangent.dlambda < rays.rays[1].tangent.dlambda)
    std::swap(rays.rays[0], rays.rays[1]);
  const auto events = events_of(study, evaluator, quantities);
  int points = 1;
  const auto observe = [&](double sign) {
    return [&points, &observer, sign](const CurvePoint& point) {
      ++points;
      return !observer || observer(points, sign * point.s);
    };
  };
  const auto follow = [&](const continuation::Ray& ray, double sign) {
    auto ended = ended_at_start(study, evaluator, quantities, start, ray);
    if (ended) return *ended;
    return study.path == Path::davidenko
               ? davidenko(problem, start.x, start.lambda, ray, events, options, observe(sign))
               : trace(problem, start.x, start.lambda, ray, events, options, observe(sign));
  };
  const continuation::Curve forward = follow(rays.rays[0], 1), backward = follow(rays.rays[1], -1);
  return join(backward, forward, evaluator, quantities, problem);
}

/// A start that was held by a wrench stays held in the directions that the study leaves free.
void hold_free_part(const Study& study, const statics::FirstEquilibrium& first, Setup& setup) {
  const auto& body = setup.system.body_slices[static_cast<std::size_t>(study.body - 1)];
  const Vector extra = (first.inputs.W - setup.rule.W_start).segment(body.W, body.count);
  setup.rule.W_start.segment(body.W, body.count) +=
      setup.rule.N * (setup.rule.N.transpose() * extra);
}

void count_negative(const PathProblem& problem, CurvePoint& start) {
  Matrix A;
  Vector b;
  if (!problem.symmetric() || !problem.derivatives(start.x, start.lambda, start.piece, A, b))
    return;
  const auto inertia = inertia_of(A);
  if (inertia && inertia->zero == 0) start.negative = inertia->negative;
}

}  // namespace

StudyResult run_study(const model::Mechanism& mechanism, const Study& study,
                      const ParameterFamily* family, const Observer& observer) {
  assert(problems_in(study, mechanism).empty());
  const std::clock_t began = std::clock();
  StudyResult result;
  result.study = study.name;
  Setup setup = set_up(mechanism, study, family);
  result.lambda_unit = lambda_unit_of(study, setup.system);
  const auto quantities =
      quantities_of(study, setup.system, setup.scales, setup.lambda_scale, result.lambda_unit);
  for (const QuantityDefinition& q : quantities) result.quantities.push_back({q.name, q.unit});

  const statics::FirstEquilibrium first = find_start(setup, study);
  result.start = report_of(first, study);
  if (result.start.found) {
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
    result.start.stiffness = evaluator.platform_stiffness(start);
    result.start.chain_stiffnesses = evaluator.chain_stiffnesses(start);
    result.branches.push_back(
        study.kind == StudyKind::equilibrium
            ? single_point(start, evaluator, quantities, problem)
            : trace_both_ways(problem, start, study, evaluator, quantities, observer));
  }
  result.seconds = static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
  return result;
}

}  // namespace springfold::analysis
