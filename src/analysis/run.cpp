#include "springfold/analysis/run.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <ctime>

#include "branch_rows.hpp"
#include "springfold/continuation/trace.hpp"
#include "springfold/core/inertia.hpp"
#include "springfold/core/scaling.hpp"
#include "springfold/statics/first_equilibrium.hpp"

namespace springfold::analysis {
namespace {

using continuation::CurvePoint;

/// Orthonormal basis of the pose coordinates that stay free beside `direction`.
Matrix free_directions(ControlMode control, const Vector& direction, Index d) {
  if (control == ControlMode::pose) return Matrix(d, 0);
  if (control != ControlMode::mixed) return Matrix::Identity(d, d);
  const Eigen::HouseholderQR<Matrix> qr(direction);
  const Matrix Q = qr.householderQ() * Matrix::Identity(d, d);
  return Q.rightCols(d - 1);
}

/// Largest rate in units of the scales sets the scale of lambda, again a power of two.
double lambda_scale_for(const Vector& rate, const Vector& units) {
  return 1 / power_of_two_near(rate.cwiseQuotient(units).lpNorm<Eigen::Infinity>());
}

/// A study made dimensionless.
struct Setup {
  Scales scales{};
  double lambda_scale = 1;  ///< physical lambda = lambda_scale * dimensionless lambda
  double lambda_start = 0;  ///< dimensionless
  statics::System system{};
  PathRule rule{};
};

Vector body_load(const statics::System& system, const Study& study, const Vector& load,
                 const Scales& scales) {
  Vector W = Vector::Zero(system.load_size);
  if (load.size() == 0) return W;
  const auto b = static_cast<std::size_t>(study.body - 1);
  W.segment(system.body_slices[b].W, system.body_slices[b].count) =
      load.cwiseQuotient(wrench_scales(system.mechanism.bodies[b].task_space, scales));
  return W;
}

/// Natural size of a parameter: its start value, or the range it is to run through.
double parameter_scale(const Study& study, double start) {
  double size = std::abs(start);
  for (const Limit& limit : study.until)
    if (limit.quantity == "lambda")
      for (const double end : {limit.low, limit.high})
        if (std::isfinite(end) && size == 0) size = std::abs(end);
  return power_of_two_near(size);
}

void set_control(const Study& study, const ParameterFamily* family, Setup& setup) {
  const auto b = static_cast<std::size_t>(study.body - 1);
  const model::TaskSpace space = setup.system.mechanism.bodies[b].task_space;
  const Index d = dimension(space);
  PathRule& rule = setup.rule;
  rule.t_rate = Vector::Zero(d);
  rule.rho_rate = Vector::Zero(setup.system.commands.size());
  rule.W_rate = Vector::Zero(setup.system.load_size);
  switch (study.control) {
    case ControlMode::load: {
      const Vector units = wrench_scales(space, setup.scales);
      setup.lambda_scale = lambda_scale_for(study.direction, units);
      rule.W_rate.segment(setup.system.body_slices[b].W, d) =
          study.direction.cwiseQuotient(units) * setup.lambda_scale;
      break;
    }
    case ControlMode::pose:
    case ControlMode::mixed: {
      const Vector units = pose_scales(space, setup.scales);
      setup.lambda_scale = lambda_scale_for(study.direction, units);
      rule.t_rate = study.direction.cwiseQuotient(units) * setup.lambda_scale;
      break;
    }
    case ControlMode::actuator: {
      Vector rate = Vector::Zero(setup.system.commands.size()), units = Vector::Ones(rate.size());
      for (Index i = 0; i < rate.size(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (setup.system.command_is_length[k]) units[i] = setup.scales.length;
        for (const ActuatorRate& r : study.actuators)
          if (r.actuator == setup.system.command_names[k]) rate[i] = r.rate;
      }
      setup.lambda_scale = lambda_scale_for(rate, units);
      rule.rho_rate = rate.cwiseQuotient(units) * setup.lambda_scale;
      break;
    }
    case ControlMode::parameter: {
      assert(family != nullptr);
      setup.lambda_scale = parameter_scale(study, family->value);
      setup.lambda_start = family->value / setup.lambda_scale;
      const Scales scales = setup.scales;
      const double unit = setup.lambda_scale;
      rule.family = [family, study, scales, unit](double lambda) {
        const Situation now = family->at(unit * lambda);
        statics::System system = statics::prepare(dimensionless(now.mechanism, scales));
        Vector W = body_load(system, study, now.constant_load, scales);
        return std::pair{std::move(system), std::move(W)};
      };
      break;
    }
  }
}

Setup set_up(const model::Mechanism& mechanism, const Study& study, const ParameterFamily* family) {
  Setup setup;
  setup.scales = scales_for(mechanism, study.constant_load);
  setup.system = statics::prepare(dimensionless(mechanism, setup.scales));
  const auto b = static_cast<std::size_t>(study.body - 1);
  const model::TaskSpace space = setup.system.mechanism.bodies[b].task_space;
  setup.rule.body = study.body;
  setup.rule.W_start = body_load(setup.system, study, study.constant_load, setup.scales);
  if (study.kind == StudyKind::force_deflection) {
    set_control(study, family, setup);
  } else {
    setup.rule.t_rate = Vector::Zero(dimension(space));
    setup.rule.rho_rate = Vector::Zero(setup.system.commands.size());
    setup.rule.W_rate = Vector::Zero(setup.system.load_size);
  }
  const ControlMode free = study.kind == StudyKind::equilibrium ? ControlMode::load : study.control;
  setup.rule.N = free_directions(free, study.direction, dimension(space));
  if (space == model::TaskSpace::spatial)
    for (const Vector* load : {&setup.rule.W_start, &setup.rule.W_rate})
      if (!load->segment(setup.system.body_slices[b].W + 3, 3).isZero(0))
        setup.rule.symmetric = false;
  return setup;
}

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

/// Limits and marks as events of the engine.
std::vector<continuation::Event> events_of(const Study& study, const Evaluator& evaluator,
                                           const std::vector<QuantityDefinition>& quantities) {
  std::vector<continuation::Event> events;
  const auto add = [&](const std::string& name, double value, continuation::EventAction action,
                       std::string label) {
    const auto q = std::find_if(quantities.begin(), quantities.end(),
                                [&](const auto& d) { return d.name == name; });
    assert(q != quantities.end());
    events.push_back({std::move(label),
                      [&evaluator, definition = *q, value](const CurvePoint& point) {
                        return evaluator.value(definition, point) - value;
                      },
                      action});
  };
  if (study.control == ControlMode::pose || study.control == ControlMode::mixed)
    events.push_back({force_limit,
                      [&evaluator](const CurvePoint& point) { return evaluator.force_rate(point); },
                      continuation::EventAction::record});
  for (const Limit& limit : study.until) {
    if (std::isfinite(limit.low))
      add(limit.quantity, limit.low, continuation::EventAction::stop,
          limit.quantity + " reaches its lower limit");
    if (std::isfinite(limit.high))
      add(limit.quantity, limit.high, continuation::EventAction::stop,
          limit.quantity + " reaches its upper limit");
  }
  for (const Mark& mark : study.marks)
    add(mark.quantity, mark.value, continuation::EventAction::record, mark.quantity);
  return events;
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
  const auto forward =
      trace(problem, start.x, start.lambda, rays.rays[0], events, options, observe(1));
  const auto backward =
      trace(problem, start.x, start.lambda, rays.rays[1], events, options, observe(-1));
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
