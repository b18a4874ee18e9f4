// Inverse kinetostatics: the actuator commands with which the loaded, preloaded, elastic mechanism
// is in equilibrium with prescribed pose coordinates at a target (paper Section 5).
#pragma once

#include <optional>

#include "springfold/statics/kinematics.hpp"
#include "springfold/statics/stiffness.hpp"

namespace springfold::statics {

/// Unstable modes can be counted only under loads that have a potential: no external moments on
/// spatial bodies.
bool has_potential(const System& system, const Inputs& inputs);

enum class ControlStatus {
  converged,
  unreachable,  ///< the chains cannot be closed with the prescribed coordinates at the target
  not_held,  ///< they can, but no commands were found that balance the springs and the load there
  wrong_count,  ///< not as many commands as prescribed coordinates
};

/// A drive whose spring has nowhere the force that the equilibrium asks of it.
struct UnableDrive {
  Index coordinate = 0;  ///< of its spring, in z
  double force = 0;      ///< that is asked
};

/// Storage and last solution of the on-line solver; it belongs to one thread. After the first solve
/// nothing is allocated any more.
struct ControlSolver {
  CommandTask task{};             ///< with its lists filled in
  std::vector<Index> unknowns{};  ///< entries of z; system.size + k stands for rho[k]
  std::vector<Index> held{};      ///< entries of z that are prescribed
  Vector z{};                     ///< guess before, solution after a solve
  Inputs inputs{};                ///< the same for rho; W as given
  Piece piece{};                  ///< of z
  int iterations = 0;             ///< of the last solve
  bool globalised = false;        ///< KINSOL was needed (solve_control_globally)
  double residual = 0;            ///< largest entry of the equilibrium residual after it
  /// Why there is no solution, where that is known (solve_control_globally).
  std::optional<UnableDrive> unable{};
  Workspace work{};
  Vector r{}, step{};
  Matrix A{}, dR_drho{}, M{};
};

/// @param z, rho  first guess @pre counts_match(task, system)
ControlSolver control_solver(const System& system, const CommandTask& task, const Vector& z,
                             const Vector& rho);

/// The same for plain equilibria: nothing is prescribed, the commands are given.
ControlSolver equilibrium_solver(const System& system, const Vector& z, const Vector& rho);

/// Newton's method from the solver's last solution (or its guess): unknowns are all entries of z but
/// the prescribed ones, and the commands. The matrix is exact,
///
///     | dR/dz (columns of the unknowns)   dR/drho |     with R = 0 the equations of equilibrium
///
/// so that dF/drho by the implicit function theorem is part of it.
/// @param W  stacked external wrenches of all bodies
/// @returns true when R vanishes to rounding; otherwise z and rho are those of the last iteration
bool solve_control(const System& system, ControlSolver& solver, const Vector& target,
                   const Vector& W);

/// The same, and where it fails again from the state `solver` was given, globalised by KINSOL (line
/// search) and then by Newton's method to full precision. Where that fails, too, the forces of the drives are found
/// with straight laws of their springs, and their deflections from the forces by the laws themselves: springs may stand
/// where their law is flat. A law that has the force along a whole flat segment leaves the spring where it stood, if
/// that is in it. The prescribed entries stand in solver.z.
bool solve_control_globally(const System& system, ControlSolver& solver);

/// The system with straight laws of the springs of those drives whose commands are unknown, and of springs of joints
/// that do not move freely whose law is flat somewhere. The same poses are held in it by the same forces of the drives,
/// and no segment of a drive's law hides what commands do.
/// @param solver  gives the unknowns, and the state whose torques the laws go through
System with_straight_drives(const System& system, const ControlSolver& solver);

/// Which iteration finds the commands.
enum class ControlMethod {
  newton,  ///< exact derivatives, KINSOL where plain Newton does not converge
  paper,  ///< the paper's: eq. (6) for every chain, S_Frho by differences; whole pose, all commands
};

struct ControlProblem {
  CommandTask task{};
  Vector target{};  ///< prescribed coordinates
  Vector W{};       ///< stacked external wrenches
  Vector z{};       ///< guess of coordinates and poses, for the kinematics
  Vector rho{};     ///< guess of the commands; those outside of the task keep these values
  ControlMethod method = ControlMethod::newton;
};

struct ControlResult {
  ControlStatus status = ControlStatus::not_held;
  Vector z{};       ///< equilibrium; empty unless converged
  Inputs inputs{};  ///< commands and load
  Piece piece{};
  KinematicInverse plain{};  ///< with all springs at rest: where the iteration began
  int iterations = 0;
  bool globalised = false;  ///< KINSOL was needed
  double residual = 0;      ///< largest entry of the residual
  Stability stability{};    ///< at the solution
  Index worst_row = 0;      ///< not_held: row of the residual that misses most ...
  double miss = 0;          ///< ... and by how much
  /// not_held: a drive whose spring cannot have the force that it takes.
  std::optional<UnableDrive> unable{};
};

/// Commands for a target, from the plain inverse kinematics.
ControlResult kinetostatic_control(const System& system, const ControlProblem& problem);

/// The same where plain inverse kinematics of the target is known already.
ControlResult kinetostatic_control(const System& system, const ControlProblem& problem,
                                   KinematicInverse plain);

}  // namespace springfold::statics
