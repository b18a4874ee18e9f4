#include "start.hpp"

#include <cmath>
#include <limits>

#include "springfold/continuation/newton.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/number_text.hpp"
#include "springfold/statics/stage_jacobians.hpp"
#include "start_trouble.hpp"

namespace springfold::analysis {
namespace {

/// Residual and matrix at the guess; of long chains column by column.
struct Guess {
  explicit Guess(const statics::System& s) : system{s} {
    if (prefers_stages(s)) stages.emplace(s);
  }
  bool evaluate(const statics::StartProblem& problem) {
    const Piece piece = piece_at(system, problem.z);
    commands = problem.inputs.rho.size();
    StructuredMatrix J;
    if (stages)
      return stages->matrix(system, piece, problem.z, problem.inputs, {}, {}, residual, J);
    statics::Workspace work;
    return equilibrium_matrix(system, piece, problem.z, problem.inputs, work, residual, A,
                              &dR_drho);
  }
  Vector column(Index i) const {
    return stages ? stages->product(Vector::Unit(system.size, i), {}) : Vector(A.col(i));
  }
  Vector command_column(Index i) const {
    return stages ? stages->product(Vector::Zero(system.size), Vector::Unit(commands, i))
                  : Vector(dR_drho.col(i));
  }

  const statics::System& system;
  std::optional<statics::StageJacobians> stages{};
  Index commands = 0;
  Vector residual{};
  Matrix A{}, dR_drho{};
};

/// The least residual that any wrenches give at the guess, and what else the solve may choose.
double guess_residual(const statics::System& system, const statics::StartProblem& problem) {
  Guess guess(system);
  if (!guess.evaluate(problem)) return std::numeric_limits<double>::quiet_NaN();
  Vector r = guess.residual;
  std::vector<Vector> columns;
  for (Index i = 0; i < system.size; ++i)
    if (system.is_wrench[static_cast<std::size_t>(i)]) columns.push_back(guess.column(i));
  if (problem.unknowns == statics::StartUnknowns::commands)
    for (Index i = 0; i < problem.inputs.rho.size(); ++i)
      columns.push_back(guess.command_column(i));
  if (problem.unknowns == statics::StartUnknowns::wrench) {
    const Matrix loads = load_columns(system, problem.z);
    const auto& body = system.body_slices[static_cast<std::size_t>(problem.body - 1)];
    for (Index i = 0; i < body.count; ++i) columns.push_back(loads.col(body.W + i));
  }
  Matrix M(system.size, static_cast<Index>(columns.size()));
  for (Index i = 0; i < M.cols(); ++i) M.col(i) = columns[static_cast<std::size_t>(i)];
  if (M.cols() > 0) r -= M * least_squares(M, r);
  return r.lpNorm<Eigen::Infinity>();
}

/// How far the solve went, and whether that is farther than allowed.
void report_move(const Setup& setup, const Study& study, const statics::StartProblem& problem,
                 const statics::FirstEquilibrium& first, StartReport& report) {
  report.guess_residual = guess_residual(setup.system, problem);
  if (!report.found) return;
  for (Index i = 0; i < setup.system.size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double way = std::abs(first.z[i] - problem.z[i]);
    if (setup.system.is_wrench[k] || way <= report.moved) continue;
    report.moved = way;
    report.moved_most = setup.system.coordinate_names[k];
  }
  if (report.moved <= study.start.maximum_move) return;
  report.found = false;
  report.where = "start.maximum_move";
  report.advice = "try a guess nearer to the equilibrium you mean (pose, start.pose, initial)";
  report.message = "the equilibrium found lies " + rounded(report.moved) + " (" +
                   report.moved_most + ") away from the guess, whose residual is " +
                   rounded(report.guess_residual) +
                   ": farther than start.maximum_move = " + rounded(study.start.maximum_move);
}

StartReport report_of(const statics::FirstEquilibrium& first, const Study& study) {
  StartReport report;
  report.found = first.status == statics::StartStatus::found;
  report.method = study.start.solver == StartSolver::fixed_point
                      ? "fixed-point iteration of paper eq. (6)"
                  : first.in_stages ? "damped exact Newton, chains in stages"
                                    : "globalised Newton (KINSOL), then exact Newton";
  if (report.found && first.came_to_rest)
    report.method += ", from where the loads let the guess sink";
  else if (report.found && first.attempts > 1)
    report.method += ", from a perturbed guess: see whether this is the equilibrium you mean";
  report.attempts = first.attempts;
  report.iterations = first.iterations;
  report.chain_iterations = first.chain_iterations;
  report.residual = first.residual;
  return report;
}

}  // namespace

statics::StartProblem start_problem(const Setup& setup, const Study& study) {
  return start_problem(setup, study.body, study.start);
}

statics::StartProblem start_problem(const Setup& setup, Index number, const StartOptions& options) {
  statics::StartProblem problem;
  problem.body = number;
  problem.attempts = options.attempts;
  problem.seed = options.seed;
  problem.is_state = options.is_state;
  problem.z = statics::guess(setup.system);
  problem.inputs = {setup.system.commands, setup.rule.W_start, setup.rule.load_start};
  const auto& body = setup.system.body_slices[static_cast<std::size_t>(number - 1)];
  const model::TaskSpace space =
      setup.system.mechanism.bodies[static_cast<std::size_t>(number - 1)].task_space;
  if (options.pose.size() > 0)
    problem.z.segment(body.t, body.count) =
        options.pose.cwiseQuotient(pose_scales(space, setup.scales));
  switch (options.solve) {
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
  return problem;
}

void hold_free_part(const Study& study, const statics::FirstEquilibrium& first, Setup& setup) {
  const auto& body = setup.system.body_slices[static_cast<std::size_t>(study.body - 1)];
  const Vector extra = (first.inputs.W - setup.rule.W_start).segment(body.W, body.count);
  if (extra.isZero(0)) return;
  const Vector held = setup.rule.N * (setup.rule.N.transpose() * extra);
  setup.rule.W_start.segment(body.W, body.count) += held;
  const bool is_spatial =
      setup.system.mechanism.bodies[static_cast<std::size_t>(study.body - 1)].task_space ==
      model::TaskSpace::spatial;
  if (is_spatial && !body.turn && held.tail(3).lpNorm<Eigen::Infinity>() > 1e-12 * held.norm())
    setup.rule.symmetric = false;  // a moment about fixed axes holds it
}

Vector start_guess(const Setup& setup, const Study& study) { return start_problem(setup, study).z; }

void count_negative(const PathProblem& problem, continuation::CurvePoint& point) {
  continuation::Linearisation at;
  if (problem.symmetric() &&
      continuation::linearise(problem, point.x, point.lambda, point.piece, at))
    point.negative = negative_eigenvalues(at);
}

statics::FirstEquilibrium find_start(const Setup& setup, const Study& study, StartReport& report) {
  const statics::StartProblem problem = start_problem(setup, study);
  statics::FirstEquilibrium first = study.start.solver == StartSolver::fixed_point
                                        ? first_equilibrium_paper(setup.system, problem)
                                        : first_equilibrium(setup.system, problem);
  report = report_of(first, study);
  explain_failure(setup, study, problem, first, report);
  report_move(setup, study, problem, first, report);
  if (!setup.origins_found) {
    report.found = false;
    explain_origins(setup, study, problem, report);
  }
  return first;
}

}  // namespace springfold::analysis
