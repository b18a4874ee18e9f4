#include "springfold/statics/kinetostatic_control.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "kinsol_newton.hpp"
#include "springfold/core/rounding.hpp"
#include "springfold/statics/first_equilibrium.hpp"
#include "springfold/statics/shapes.hpp"
#include "straight_drives.hpp"
#include "unknowns.hpp"

namespace springfold::statics {
namespace {

constexpr int most_iterations = 12;
constexpr double solved_to = 1e-12;  // of the residual, scaled as in is_solved
constexpr double last_step = 1e-8;   // after such a step Newton's error is below rounding

/// Solves M x = b by elimination with row exchanges in place: b becomes x. Allocates nothing.
bool solve_in_place(Matrix& M, Vector& b) {
  const Index n = M.rows();
  for (Index k = 0; k < n; ++k) {
    Index p = k;
    M.col(k).tail(n - k).cwiseAbs().maxCoeff(&p);
    p += k;
    if (!(std::abs(M(p, k)) > 0)) return false;
    if (p != k) {
      for (Index j = k; j < n; ++j) std::swap(M(k, j), M(p, j));
      std::swap(b[k], b[p]);
    }
    for (Index i = k + 1; i < n; ++i) M(i, k) /= M(k, k);
    for (Index j = k + 1; j < n; ++j) {
      const double pivot = M(k, j);
      if (pivot == 0) continue;
      for (Index i = k + 1; i < n; ++i) M(i, j) -= M(i, k) * pivot;
    }
    for (Index i = k + 1; i < n; ++i) b[i] -= M(i, k) * b[k];
  }
  for (Index k = n - 1; k >= 0; --k) {
    b[k] /= M(k, k);
    for (Index i = 0; i < k; ++i) b[i] -= M(i, k) * b[k];
  }
  return true;
}

/// What rounding may leave of a row: some units of its terms, lengths against max(1, their size).
/// @pre A and dR_drho are those of a state nearby
double rounding_of_row(const System& system, const ControlSolver& s, Index row) {
  double terms = 0;
  for (Index i = 0; i < system.size; ++i) {
    const double least = system.is_wrench[static_cast<std::size_t>(i)] ? 0 : 1;
    terms += std::abs(s.A(row, i)) * std::max(least, std::abs(s.z[i]));
  }
  for (Index k = 0; k < s.dR_drho.cols(); ++k)
    terms += std::abs(s.dR_drho(row, k)) * std::max(1.0, std::abs(s.inputs.rho[k]));
  return few_roundings * terms;
}

/// What a solution may leave of a row. Gaps are compared with lengths, forces with forces: a huge wrench must not
/// excuse a gap.
double most_left(const System& system, const ControlSolver& s, bool is_gap) {
  double size = 1, wrench = 1;
  for (Index i = 0; i < system.size; ++i) {
    double& largest = system.is_wrench[static_cast<std::size_t>(i)] ? wrench : size;
    largest = std::max(largest, std::abs(s.z[i]));
  }
  return solved_to * (is_gap ? size : std::max(size, wrench));
}

/// Forces of stiff springs leave their rounding, whatever a soft one makes of the unit of force.
bool is_solved(const System& system, const ControlSolver& s) {
  const double most_gap = most_left(system, s, true), most_force = most_left(system, s, false);
  for (Index i = 0; i < system.size; ++i) {
    const bool is_gap = system.is_wrench[static_cast<std::size_t>(i)];
    if (std::abs(s.r[i]) <= (is_gap ? most_gap : most_force)) continue;
    if (is_gap || !(std::abs(s.r[i]) <= rounding_of_row(system, s, i))) return false;
  }
  return true;
}

void set_piece(const System& system, const Vector& z, const Vector& rho, Piece& piece) {
  for (std::size_t j = 0; j < system.switches.size(); ++j)
    piece[j] = switch_value(system, j, z, rho) >= 0 ? std::int8_t{1} : std::int8_t{-1};
}

bool evaluate(const System& system, ControlSolver& s) {
  set_piece(system, s.z, s.inputs.rho, s.piece);
  return equilibrium_matrix(system, s.piece, s.z, s.inputs, s.work, s.r, s.A, &s.dR_drho);
}

bool evaluate_residual(const System& system, ControlSolver& s) {
  set_piece(system, s.z, s.inputs.rho, s.piece);
  const bool finite = equilibrium_residual(system, s.piece, s.z, s.inputs, s.work, s.r);
  s.residual = s.r.lpNorm<Eigen::Infinity>();
  return finite;
}

void fill_matrix(const System& system, ControlSolver& s) {
  for (std::size_t k = 0; k < s.unknowns.size(); ++k) {
    const Index from = s.unknowns[k], column = static_cast<Index>(k);
    if (from < system.size)
      s.M.col(column) = s.A.col(from);
    else
      s.M.col(column) = s.dR_drho.col(from - system.size);
  }
}

double& unknown(const System& system, ControlSolver& s, std::size_t k) {
  const Index at = s.unknowns[k];
  return at < system.size ? s.z[at] : s.inputs.rho[at - system.size];
}

/// The step of the command of the drive whose spring has this coordinate; zero if it has none that is unknown.
double step_of_command(const System& system, const ControlSolver& s, Index coordinate) {
  for (const ChainSlice& chain : system.chain_slices)
    for (std::size_t j = 0; j < chain.joint_coordinate.size(); ++j) {
      if (chain.joint_coordinate[j] != coordinate || chain.joint_command[j] < 0) continue;
      const Index command = system.size + chain.joint_command[j];
      for (std::size_t k = 0; k < s.unknowns.size(); ++k)
        if (s.unknowns[k] == command) return s.step[static_cast<Index>(k)];
    }
  return 0;
}

/// Largest motion of a joint or pose in a step; wrenches and commands may change at will, and so may the deflection of
/// a drive against its command.
double longest_move(const System& system, const ControlSolver& s) {
  double longest = 0;
  for (std::size_t k = 0; k < s.unknowns.size(); ++k) {
    const Index at = s.unknowns[k];
    if (at >= system.size || system.is_wrench[static_cast<std::size_t>(at)]) continue;
    const double move = s.step[static_cast<Index>(k)] + step_of_command(system, s, at);
    longest = std::max(longest, std::abs(move));
  }
  return longest;
}

/// Newton's method from the state of the solver.
bool newton(const System& system, ControlSolver& s) {
  for (s.iterations = 0; s.iterations < most_iterations;) {
    if (!evaluate(system, s)) return false;
    fill_matrix(system, s);
    s.step = s.r;
    if (!solve_in_place(s.M, s.step) || !s.step.allFinite()) return false;
    const double length = s.step.lpNorm<Eigen::Infinity>();
    if (longest_move(system, s) > longest_newton) return false;
    for (std::size_t k = 0; k < s.unknowns.size(); ++k)
      unknown(system, s, k) -= s.step[static_cast<Index>(k)];
    ++s.iterations;
    const double size = std::max(1.0, s.z.lpNorm<Eigen::Infinity>());
    if (length > last_step * size) continue;
    if (!evaluate_residual(system, s)) return false;
    if (is_solved(system, s)) return true;
  }
  return evaluate_residual(system, s) && is_solved(system, s);
}

Index worst_row_of(const System& system, const ControlSolver& s) {
  Index worst = 0;
  for (Index i = 0; i < system.size; ++i)
    if (std::abs(s.r[i]) > std::abs(s.r[worst])) worst = i;
  return worst;
}

/// Where the solver begins.
StartState start_of(const ControlSolver& solver) { return {solver.z, solver.inputs}; }

void begin_at(const StartState& start, ControlSolver& solver) {
  solver.z = start.z;
  solver.inputs = start.inputs;
}

/// Newton's method, then KINSOL and Newton's method.
/// @param start  that of the solver, to begin there again
bool solve_from(const StartState& start, const System& system, ControlSolver& solver) {
  solver.globalised = false;
  if (newton(system, solver)) return true;
  const int wasted = solver.iterations;
  solver.globalised = true;
  begin_at(start, solver);
  const auto n = static_cast<Index>(solver.unknowns.size());
  const auto put = [&](const Vector& y) {
    for (std::size_t k = 0; k < solver.unknowns.size(); ++k)
      unknown(system, solver, k) = y[static_cast<Index>(k)];
  };
  Vector y(n);
  for (std::size_t k = 0; k < solver.unknowns.size(); ++k)
    y[static_cast<Index>(k)] = unknown(system, solver, k);
  std::vector<Index> angles;
  for (Index k = 0; k < n; ++k)
    if (is_angle(system, solver.unknowns[static_cast<std::size_t>(k)])) angles.push_back(k);
  const SquareSystem square{n,
                            [&](const Vector& at, Vector& r) {
                              put(at);
                              const bool finite = evaluate_residual(system, solver);
                              r = solver.r;
                              return finite;
                            },
                            [&](const Vector& at, Matrix& J) {
                              put(at);
                              const bool finite = evaluate(system, solver);
                              fill_matrix(system, solver);
                              J = solver.M;
                              return finite;
                            },
                            angles};
  const KinsolResult found = solve_by_kinsol(square, y, 1e-9, 5.0);
  put(found.y);
  const ControlSolver before = solver;
  const bool solved = newton(system, solver);
  const int last = solver.iterations;
  if (!solved) {  // what KINSOL reached says more than a Newton iteration that went astray
    solver = before;
    evaluate_residual(system, solver);
  }
  solver.iterations = wasted + found.iterations + last;
  return solved;
}

/// Which force a drive must have is a matter of the equilibrium alone: it is the same whatever the law of its spring.
/// So it is looked for with straight laws, and the laws tell the deflections that belong to the forces: Newton's method
/// would have to find its way out of segments in which forces do not depend on deflections. For springs that are no
/// drive's these deflections are where Newton's method begins.
bool solve_by_forces(const System& system, ControlSolver& solver) {
  const ControlSolver start = solver;
  const std::vector<AskedSpring> asked = asked_springs(system, solver);
  if (asked.empty()) return false;
  const System straight = straightened(system, start, asked);
  if (!solve_from(start_of(start), straight, solver)) return false;
  const int spent = solver.iterations;
  const StraightSprings springs{straight, asked, most_left(system, solver, false)};
  if (!put_deflections(system, springs, start, solver) || !evaluate(system, solver)) return false;
  solver.residual = solver.r.lpNorm<Eigen::Infinity>();
  if (is_solved(system, solver)) return true;
  const bool solved = solve_from(start_of(solver), system, solver);
  solver.iterations += spent;
  return solved;
}

ControlResult by_paper(const System& system, const ControlProblem& problem, ControlResult result) {
  StartProblem start{.unknowns = StartUnknowns::commands, .body = problem.task.body};
  start.z = result.plain.z;
  start.inputs = {result.plain.rho, problem.W};
  const FirstEquilibrium found = first_equilibrium_paper(system, start);
  result.iterations = found.iterations;
  result.residual = found.residual;
  if (found.status != StartStatus::found) return result;
  result.status = ControlStatus::converged;
  result.z = found.z;
  result.inputs = found.inputs;
  result.piece = found.piece;
  return result;
}

}  // namespace

bool has_potential(const System& system, const Inputs& inputs) {
  for (std::size_t b = 0; b < system.body_slices.size(); ++b)
    if (system.mechanism.bodies[b].task_space == model::TaskSpace::spatial &&
        !system.body_slices[b].turn && !inputs.W.segment(system.body_slices[b].W + 3, 3).isZero(0))
      return false;
  return true;
}

ControlSolver equilibrium_solver(const System& system, const Vector& z, const Vector& rho) {
  ControlSolver s;
  for (Index i = 0; i < system.size; ++i) s.unknowns.push_back(i);
  s.z = z;
  s.inputs = {rho, Vector::Zero(system.load_size)};
  s.piece.resize(system.switches.size());
  s.M.resize(system.size, system.size);
  s.step.resize(system.size);
  return s;
}

ControlSolver control_solver(const System& system, const CommandTask& task, const Vector& z,
                             const Vector& rho) {
  assert(counts_match(task, system));
  ControlSolver s = equilibrium_solver(system, z, rho);
  s.task = completed(task, system);
  const BodySlice& body = system.body_slices[static_cast<std::size_t>(task.body - 1)];
  for (const Index k : s.task.prescribed) s.held.push_back(body.t + k);
  std::erase_if(s.unknowns, [&s](Index i) {
    return std::find(s.held.begin(), s.held.end(), i) != s.held.end();
  });
  for (const Index k : s.task.commands) s.unknowns.push_back(system.size + k);
  return s;
}

bool solve_control(const System& system, ControlSolver& solver, const Vector& target,
                   const Vector& W) {
  for (std::size_t k = 0; k < solver.held.size(); ++k)
    solver.z[solver.held[k]] = target[static_cast<Index>(k)];
  solver.inputs.W = W;
  return newton(system, solver);
}

bool solve_control_globally(const System& system, ControlSolver& solver) {
  const StartState start = start_of(solver);
  solver.unable.reset();
  if (solve_from(start, system, solver)) return true;
  ControlSolver asked = solver;
  begin_at(start, asked);
  if (solve_by_forces(system, asked)) {
    asked.iterations += solver.iterations;
    solver = std::move(asked);
    return true;
  }
  solver.unable = asked.unable;
  return false;
}

ControlResult kinetostatic_control(const System& system, const ControlProblem& problem) {
  ControlResult result{.status = ControlStatus::wrong_count};
  if (!counts_match(problem.task, system)) return result;
  return kinetostatic_control(
      system, problem,
      kinematic_inverse(system, problem.task, problem.target, problem.z, problem.rho));
}

ControlResult kinetostatic_control(const System& system, const ControlProblem& problem,
                                   KinematicInverse plain) {
  ControlResult result;
  if (!counts_match(problem.task, system)) {
    result.status = ControlStatus::wrong_count;
    return result;
  }
  result.plain = std::move(plain);
  result.status = result.plain.closed ? ControlStatus::not_held : ControlStatus::unreachable;
  ControlSolver solver = control_solver(system, problem.task, result.plain.z, result.plain.rho);
  if (!result.plain.closed && !result.plain.elastic) return result;
  if (problem.method == ControlMethod::paper) {
    if (result.plain.closed) result = by_paper(system, problem, result);
  } else {
    solver.inputs.W = problem.W;
    const bool found = solve_control_globally(system, solver);
    result.iterations = solver.iterations;
    result.globalised = solver.globalised;
    result.residual = solver.residual;
    if (found) {
      result.status = ControlStatus::converged;
      result.z = solver.z;
      result.inputs = solver.inputs;
      result.piece = solver.piece;
    } else {
      result.worst_row = worst_row_of(system, solver);
      result.miss = std::abs(solver.r[result.worst_row]);
      result.unable = solver.unable;
    }
  }
  if (result.status != ControlStatus::converged) return result;
  Workspace work;
  Vector r;
  Matrix A;
  if (has_potential(system, result.inputs) &&
      equilibrium_matrix(system, result.piece, result.z, result.inputs, work, r, A))
    result.stability = stability(system, A);
  return result;
}

}  // namespace springfold::statics
