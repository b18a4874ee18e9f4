#include "springfold/statics/first_equilibrium.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <random>

#include "come_to_rest.hpp"
#include "kinsol_newton.hpp"
#include "minimum_norm.hpp"
#include "solve_beside.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/statics/kinetostatic_control.hpp"
#include "springfold/statics/prepare_again.hpp"
#include "stage_newton.hpp"
#include "whole_turns.hpp"

namespace springfold::statics {
namespace {

/// Closes the chains by minimum-norm Newton steps of bounded length on the closure equations.
/// @param move_bodies  false: the guessed poses stay, only the chains move
bool assemble(StartEquations& equations, bool move_bodies, StartState& state) {
  constexpr double longest = 0.3;
  std::vector<Index> moving;
  const Index count = equations.pack(state).size();
  for (Index i = 0; i < count; ++i)
    if (!equations.is_wrench(i) && (move_bodies || !equations.is_pose(i))) moving.push_back(i);
  Vector e;
  Matrix J;
  for (int iteration = 0; iteration < 100; ++iteration) {
    if (!equations.closures(state, moving, e, J)) return false;
    if (e.lpNorm<Eigen::Infinity>() < 1e-10) return true;
    if (moving.empty()) return false;
    Vector step = -minimum_norm_solution(J, e);
    const double length = step.lpNorm<Eigen::Infinity>();
    if (!(length > 0) || !std::isfinite(length)) return false;
    if (length > longest) step *= longest / length;
    Vector y = equations.pack(state);
    for (std::size_t k = 0; k < moving.size(); ++k) y[moving[k]] += step[static_cast<Index>(k)];
    equations.unpack(y, state);
  }
  return false;
}

/// Wrenches that balance the springs best for the given coordinates (least squares).
void estimate_wrenches(StartEquations& equations, StartState& state) {
  Vector r;
  Matrix J;
  Vector y = equations.pack(state);
  std::vector<Index> columns;
  for (Index i = 0; i < y.size(); ++i)
    if (equations.is_wrench(i)) {
      columns.push_back(i);
      y[i] = 0;
    }
  equations.unpack(y, state);
  if (!equations.residual(state, r) || !equations.jacobian(state, J)) return;
  // Columns of the wrenches do not depend on the wrenches: the rows are linear in them.
  const Vector F = -minimum_norm_solution(J(Eigen::all, columns), r);
  for (std::size_t k = 0; k < columns.size(); ++k) y[columns[k]] = F[static_cast<Index>(k)];
  equations.unpack(y, state);
}

/// KINSOL from a guess, then Newton; returns the residual.
double solve_from(StartEquations& equations, StartState& state, int& iterations) {
  StartState trial = state;
  const SquareSystem square{equations.pack(state).size(),
                            [&](const Vector& y, Vector& r) {
                              equations.unpack(y, trial);
                              return equations.residual(trial, r);
                            },
                            [&](const Vector& y, Matrix& J) {
                              equations.unpack(y, trial);
                              return equations.jacobian(trial, J);
                            },
                            equations.angles()};
  const KinsolResult solved = solve_by_kinsol(square, equations.pack(state), 1e-9, 5.0);
  equations.unpack(solved.y, state);
  iterations = solved.iterations;
  return polish(equations, state, iterations);
}

void perturb(StartEquations& equations, StartState& state, int attempt, std::mt19937_64& random) {
  const double size = std::min(1.5, 0.02 * std::pow(1.6, attempt));
  Vector y = equations.pack(state);
  for (Index i = 0; i < y.size(); ++i) {
    const double uniform = static_cast<double>(random() >> 11) * 0x1p-53;  // same on any platform
    if (!equations.is_wrench(i)) y[i] += size * (2 * uniform - 1);
  }
  equations.unpack(y, state);
}

/// Systems with more unknowns are not solved with matrices of entries.
constexpr Index most_dense = 3000;

/// Long chains: Newton's method in stages from the guess and from perturbed ones.
bool solve_long_chains(const System& system, const StartProblem& problem, StartEquations& equations,
                       const StartState& guess, FirstEquilibrium& result) {
  StageNewton newton(system, problem);
  std::mt19937_64 random(problem.seed);
  for (result.attempts = 1; result.attempts <= problem.attempts; ++result.attempts) {
    StartState state = guess;
    if (result.attempts > 1) perturb(equations, state, result.attempts - 1, random);
    result.residual = newton.solve(state.z, state.inputs, result.iterations);
    if (shorten_turns(system, state.z))
      result.residual = newton.solve(state.z, state.inputs, result.iterations);
    if (!std::isfinite(result.residual)) continue;
    result.z = state.z;
    result.inputs = state.inputs;
    if (!equations.solved(state, start_tolerance)) continue;
    result.status = StartStatus::found;
    result.in_stages = true;
    return true;
  }
  result.attempts = problem.attempts;
  return false;
}

/// Has a solution been left for another one?
bool leaves(StartEquations& equations, const System& system, const StartState& from,
            const StartState& to) {
  constexpr double rounding = 64 * std::numeric_limits<double>::epsilon(), hardly = 1e-6;
  return farthest_coordinate(system, to.z, from.z) > hardly && equations.solved(from, rounding);
}

/// From closed chains: residual and iterations into `result`.
void solve_attempt(const System& system, const StartProblem& problem, StartEquations& equations,
                   StartState& state, FirstEquilibrium& result) {
  if (problem.unknowns != StartUnknowns::commands) {
    result.residual = solve_from(equations, state, result.iterations);
    return;
  }
  ControlSolver solver = control_solver(system, {.body = problem.body}, state.z, state.inputs.rho);
  solver.inputs.W = state.inputs.W;
  solve_control_globally(system, solver);
  state = {solver.z, solver.inputs};
  result.iterations = solver.iterations;
  result.residual = solver.residual;
}

/// Solves from where the loads move a guess to from which Newton's method found nothing.
/// @returns whether that is an equilibrium
bool solve_from_rest(const System& system, const StartProblem& problem, StartEquations& equations,
                     StartState state, FirstEquilibrium& result) {
  const bool is_this_guess_meant = problem.attempts == 1;
  if (is_this_guess_meant || problem.unknowns == StartUnknowns::commands) return false;
  const auto close = [&](StartState& open) {
    StartState kept = open;
    if (!assemble(equations, false, kept)) return assemble(equations, true, open);
    open = kept;
    return true;
  };
  come_to_rest(system, equations, close, state);
  int iterations = 0;
  const double residual = solve_from(equations, state, iterations);
  if (!equations.solved(state, start_tolerance)) return false;
  result.came_to_rest = true;
  result.z = state.z;
  result.inputs = state.inputs;
  result.iterations = iterations;
  result.residual = residual;
  result.status = StartStatus::found;
  return true;
}

/// Piece, distance from the guess, and the wrench that holds a given pose.
void complete(const System& system, const StartProblem& problem, FirstEquilibrium& result) {
  result.piece = piece_at(system, result.z);
  result.moved = farthest_coordinate(system, result.z, problem.z);
  if (problem.unknowns != StartUnknowns::wrench) return;
  const BodySlice& body = system.body_slices[static_cast<std::size_t>(problem.body - 1)];
  Workspace work;
  Vector r;
  equilibrium_residual(system, result.piece, result.z, result.inputs, work, r);
  result.inputs.W.segment(body.W, body.count) +=
      Lu(load_columns(system, result.z).block(body.t, body.W, body.count, body.count))
          .solve(-r.segment(body.t, body.count));
}

}  // namespace

bool solves_by_rows(const System& system, const StartProblem& problem,
                    const FirstEquilibrium& found) {
  if (system.size > most_dense) return true;
  Workspace work;
  return StartEquations(system, problem, work)
      .vanishes_by_rows({found.z, found.inputs}, start_tolerance);
}

bool correct_by_rows(const System& system, const StartProblem& problem, FirstEquilibrium& found) {
  constexpr int steps = 3;
  constexpr double hardly = 1e-6;
  if (system.size > most_dense) return false;
  Workspace work;
  StartEquations equations(system, problem, work);
  StartState state{found.z, found.inputs};
  Vector r;
  Matrix J;
  double moved = 0;
  for (int i = 0; i < steps; ++i) {
    if (!equations.residual(state, r) || !equations.jacobian(state, J)) return false;
    const Vector step = Lu(J).solve(r);
    moved += equations.way(step);
    if (!step.allFinite() || moved > hardly) return false;
    equations.unpack(equations.pack(state) - step, state);
    if (!equations.vanishes_by_rows(state, start_tolerance)) continue;
    equations.residual(state, r);
    found.residual = r.lpNorm<Eigen::Infinity>();
    found.z = state.z;
    found.inputs = state.inputs;
    complete(system, problem, found);
    return true;
  }
  return false;
}

FirstEquilibrium first_equilibrium(const System& system, const StartProblem& problem) {
  Workspace work;
  return first_equilibrium(system, problem, work);
}

FirstEquilibrium first_equilibrium(const System& system, const StartProblem& problem,
                                   Workspace& work) {
  FirstEquilibrium result;
  StartEquations equations(system, problem, work);
  StartState guess{problem.z, problem.inputs};
  shorten_turns(system, guess.z);
  if (problem.unknowns == StartUnknowns::commands) {
    const Index d = system.body_slices[static_cast<std::size_t>(problem.body - 1)].count;
    if (problem.inputs.rho.size() != d) {
      result.status = StartStatus::wrong_count;
      return result;
    }
  }
  if (problem.unknowns != StartUnknowns::commands && prefers_stages(system)) {
    const bool found = solve_long_chains(system, problem, equations, guess, result);
    if (found) complete(system, problem, result);
    if (found || system.size > most_dense) return result;
  }
  if (problem.is_neighbour) {
    if (solve_beside(system, problem, equations, guess, result)) complete(system, problem, result);
    return result;
  }
  result.iterations = 0;
  result.status = StartStatus::no_assembly;
  std::mt19937_64 random(problem.seed);
  for (result.attempts = 1; result.attempts <= problem.attempts; ++result.attempts) {
    StartState state = guess;
    if (result.attempts > 1) perturb(equations, state, result.attempts - 1, random);
    // A guessed pose is worth more than guessed joint coordinates: keep it if the chains reach it.
    StartState kept = state;
    const bool reached = assemble(equations, false, kept);
    if (reached) state = kept;
    const bool assembled = reached || assemble(equations, true, state);
    if (assembled) result.status = StartStatus::no_equilibrium;
    estimate_wrenches(equations, state);
    const StartState closed = state;
    solve_attempt(system, problem, equations, state, result);
    if (shorten_turns(system, state.z))
      result.residual = polish(equations, state, result.iterations);
    if (problem.is_state && leaves(equations, system, closed, state)) state = closed;
    result.z = state.z;
    result.inputs = state.inputs;
    if (equations.solved(state, start_tolerance)) {
      result.status = StartStatus::found;
      break;
    }
    if (result.attempts == 1 && assembled &&
        solve_from_rest(system, problem, equations, closed, result))
      break;
  }
  result.attempts = std::min(result.attempts, problem.attempts);
  if (result.status == StartStatus::found) complete(system, problem, result);
  return result;
}

}  // namespace springfold::statics
