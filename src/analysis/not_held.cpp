#include "not_held.hpp"

#include <algorithm>
#include <cmath>

#include "springfold/core/decompositions.hpp"
#include "springfold/core/number_text.hpp"
#include "switch_words.hpp"

namespace springfold::analysis {
namespace {

/// Systems with more unknowns are not looked into.
constexpr Index largest_matrix = 300;

/// Rows of the equilibrium that no unknown can change, by the coordinates that they belong to: the left null
/// vectors of the matrix of the solve at the state of plain kinematics.
std::string untouched(const statics::System& system, const statics::ControlSolver& solver,
                      const statics::ControlResult& result) {
  constexpr double none = 1e-9, visible = 0.3;
  if (system.size > largest_matrix || !result.plain.closed) return {};
  statics::Workspace work;
  Vector r;
  Matrix A, by_rho;
  const statics::Inputs unloaded{result.plain.rho, Vector::Zero(system.load_size), {}};
  if (!equilibrium_matrix(system, piece_at(system, result.plain.z), result.plain.z, unloaded, work,
                          r, A, &by_rho))
    return {};
  Matrix M(system.size, static_cast<Index>(solver.unknowns.size()));
  for (Index k = 0; k < M.cols(); ++k) {
    const Index i = solver.unknowns[static_cast<std::size_t>(k)];
    M.col(k) = i < system.size ? A.col(i) : by_rho.col(i - system.size);
  }
  const Svd svd = jacobi_svd(M, SingularVectors::full);
  const Vector& values = svd.values;
  const Index last = system.size - 1;
  if (values.size() > last && values[last] > none * values[0]) return {};
  const Vector u = svd.U.col(last);
  std::string names;
  for (Index i = 0; i < system.size; ++i)
    if (std::abs(u[i]) >= visible * u.cwiseAbs().maxCoeff() &&
        !system.is_wrench[static_cast<std::size_t>(i)])
      names += (names.empty() ? "" : ", ") + system.coordinate_names[static_cast<std::size_t>(i)];
  return names;
}

/// The largest part of the load with which the target is held, from none on; nothing where it is not held
/// without load.
std::optional<double> held_part(const statics::System& system, statics::ControlSolver solver,
                                const Vector& target, const Vector& W) {
  constexpr int steps = 20, halvings = 12;
  if (!solve_control(system, solver, target, Vector::Zero(W.size()))) return std::nullopt;
  double held = 0, next = 1.0 / steps, step = 1.0 / steps;
  for (int i = 0; i < steps + halvings && held < 1; ++i) {
    statics::ControlSolver trial = solver;
    if (solve_control(system, trial, target, next * W)) {
      solver = trial;
      held = next;
    } else {
      step /= 2;
    }
    next = std::min(1.0, held + step);
  }
  return held;
}

/// Does a spring act otherwise beyond a threshold, so that the state says little about others?
bool has_thresholds(const statics::System& system) {
  for (std::size_t j = 0; j < system.switches.size(); ++j) {
    const statics::Switch& s = system.switches[j];
    if (law_of(system, s).changes_at(j - first_switch_of(system, s))) return true;
  }
  return false;
}

std::string unable_words(const CommandSetup& setup, const statics::UnableDrive& drive) {
  const statics::System& system = setup.system;
  const auto spring = std::find_if(
      system.springs.begin(), system.springs.end(),
      [&](const statics::CoordinateSpring& one) { return one.coordinate == drive.coordinate; });
  const bool is_force = system.is_length[static_cast<std::size_t>(drive.coordinate)];
  return "the spring of " + spring->name + " would have to bear a " +
         (is_force ? "force" : "moment") + " of " +
         rounded(drive.force * (is_force ? setup.scales.force : setup.scales.moment())) +
         ", which it never does";
}

NotHeld out_of_reach(const CommandSetup& setup, const statics::KinematicInverse& plain) {
  return {.is_unreachable = true,
          .why = "chain " + setup.system.mechanism.chains[plain.chain].name +
                 " cannot be closed, it is short by " + rounded(setup.scales.length * plain.gap),
          .is_shown = true};
}

/// What is left where the iteration ended.
std::string left_over(const CommandSetup& setup, const statics::ControlResult& result) {
  const statics::System& system = setup.system;
  const auto row = static_cast<std::size_t>(result.worst_row);
  if (result.miss == 0) return "the iteration does not converge";
  if (system.is_wrench[row])
    return "no commands found; the closure of " + system.coordinate_names[row] + " is missed by " +
           rounded(result.miss * setup.scales.length);
  const bool force = system.is_length[row];
  return "no commands found that balance springs and load; at " + system.coordinate_names[row] +
         " a " + (force ? "force" : "moment") + " of " +
         rounded(result.miss * (force ? setup.scales.force : setup.scales.moment())) + " is left";
}

NotHeld not_held(std::string why, bool is_shown = false) {
  return {.why = std::move(why), .is_shown = is_shown};
}

}  // namespace

std::string words(const NotHeld& failed) {
  return (failed.is_unreachable ? "unreachable: " : "not held: ") + failed.why;
}

NotHeld why_not_held(const CommandSetup& setup, const Vector& target, const Vector& W,
                     const statics::ControlResult& result) {
  if (result.status == statics::ControlStatus::wrong_count)
    return not_held("as many commands as prescribed pose coordinates are needed", true);
  if (result.status == statics::ControlStatus::unreachable)
    return out_of_reach(setup, result.plain);
  if (result.unable) return not_held(unable_words(setup, *result.unable), true);
  const statics::ControlSolver solver =
      control_solver(setup.system, setup.task, result.plain.z, result.plain.rho);
  const statics::System straight = with_straight_drives(setup.system, solver);
  if (const std::string names = untouched(straight, solver, result); !names.empty())
    return not_held("none of the chosen commands and no spring acts on " + names +
                        ", so nothing balances a load there",
                    !has_thresholds(straight));
  const std::string left = left_over(setup, result);
  if (!result.plain.closed) return not_held(left);
  const auto part = held_part(straight, solver, target, W);
  if (!part && W.isZero(0)) return not_held(left + "; the springs alone cannot be balanced here");
  if (!part) return not_held(left + ", not even without the load");
  if (*part < 1)
    return not_held("only " + rounded(100 * *part, 3) +
                        " % of the load can be held here, found by raising it from zero",
                    *part > 0);
  return not_held(left);
}

}  // namespace springfold::analysis
