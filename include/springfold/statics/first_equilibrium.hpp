// The first point of a branch: an equilibrium near a rough guess.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "springfold/statics/system.hpp"

namespace springfold {
class Lu;
}

namespace springfold::statics {

/// What is unknown besides the chains' coordinates and wrenches.
enum class StartUnknowns {
  pose,      ///< pose of all bodies; commands and loads are given
  commands,  ///< actuator commands; the pose of one body and all loads are given
  wrench,    ///< the wrench that holds one body at its given pose
};

/// What solutions of problems next to this one tell of its own.
struct Foresight {
  Vector z{}, rho{};                    ///< where the solution is expected; empty: not known
  std::shared_ptr<const Lu> factors{};  ///< of the matrix of one of them; may be missing
  /// They lie close by on both sides, and belong to each other: det J has been seen to keep its sign.
  bool enclosed = false;
};

struct StartProblem {
  StartUnknowns unknowns = StartUnknowns::pose;
  Index body = 1;   ///< body whose pose is given (commands, wrench)
  Vector z{};       ///< guess of all unknowns; given poses stand in it
  Inputs inputs{};  ///< commands (guess, if they are unknown) and loads
  int attempts = 16;
  std::uint64_t seed = 1;
  /// z and inputs solve a problem next to this one: its solution is the one that belongs to them, or none.
  bool is_neighbour = false;
  Foresight foresight{};  ///< is_neighbour: what else neighbours tell
  /// z was solved before. Where it solves this problem to rounding it stays: at a limit point, where the matrix is
  /// singular, a step of Newton's method would lead away from it.
  bool is_state = false;
};

enum class StartStatus {
  found,
  no_assembly,     ///< the chains could not be closed from any attempt
  no_equilibrium,  ///< the solver converged from no attempt
  wrong_count,     ///< commands: not as many actuators as pose coordinates
};

/// A solution, or the best attempt.
struct FirstEquilibrium {
  StartStatus status = StartStatus::no_equilibrium;
  Vector z{};
  Inputs inputs{};  ///< with commands and the holding wrench as found
  Piece piece{};
  int attempts = 0;                     ///< tries used
  int iterations = 0;                   ///< of the successful try (or the last one)
  bool in_stages = false;               ///< found by Newton's method for long chains
  bool came_to_rest = false;            ///< found from where the loads move the guess to
  double residual = 0;                  ///< largest entry of the equilibrium residual
  double moved = 0;                     ///< largest change of a coordinate or pose from the guess
  std::vector<int> chain_iterations{};  ///< paper's iteration: of every chain, last sweep
  std::shared_ptr<const Lu>
      factors{};  ///< is_neighbour: of a matrix near the solution, for the next neighbour
};

/// Closes the chains by damped minimum-norm Newton steps, at the guessed poses if they reach them, then
/// solves the equilibrium with KINSOL (Newton with line search, exact matrix), then corrects to full
/// precision. Systems with long chains are tried by damped Newton steps in stages first, and by nothing else
/// where they have more than 3,000 unknowns. Commands are found by solve_control_globally
/// (kinetostatic_control.hpp). If that fails, from where the loads let the guess sink, then from seeded perturbations
/// of growing size. Dimensionless systems are expected: coordinates of order one.
FirstEquilibrium first_equilibrium(const System& system, const StartProblem& problem);

/// Does it solve the equations in the units at hand: gaps to 1e-12 of the lengths, every force to 1e-12 of the unit of
/// force or of the terms of its own row? Always true of systems with more than 3,000 unknowns, whose matrix is not
/// built.
bool solves_by_rows(const System& system, const StartProblem& problem,
                    const FirstEquilibrium& found);

/// Newton's method from a state that solves the equations in another unit of force: what stiff springs leave of their
/// rounding there may be more than soft ones pull with. @returns whether it then solves_by_rows(), hardly moved;
/// otherwise `found` is as it was
bool correct_by_rows(const System& system, const StartProblem& problem, FirstEquilibrium& found);

/// Of the matrix at a solution of this problem, for its neighbours; nothing where it cannot be evaluated.
std::shared_ptr<const Lu> factors_at(const System& system, const StartProblem& problem,
                                     const FirstEquilibrium& found, Workspace& work);

/// One chain at a given pose by the paper's fixed-point iteration, eq. (6), with the sign of the
/// preload corrected: eps = t - g + J_q q + J_theta (theta - theta_0).
struct ChainIteration {
  bool converged = false;
  int iterations = 0;
};

/// Updates the chain's coordinates and wrench in z. Stops when they change by less than `tolerance`.
ChainIteration iterate_chain(const System& system, std::size_t chain, const Vector& rho, Vector& z,
                             double tolerance = 1e-12, int maximum = 200);

/// Equilibrium by the paper's scheme: iterate_chain for every chain at the given pose; with unknown
/// commands inside the paper's Section 5 loop rho <- rho - S^-1 F_Sigma, S by differences.
/// @pre problem.unknowns is not pose
FirstEquilibrium first_equilibrium_paper(const System& system, const StartProblem& problem);

}  // namespace springfold::statics
