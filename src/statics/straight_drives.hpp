// Springs of drives whose forces are asked for before their deflections. Private to statics.
#pragma once

#include <vector>

#include "springfold/statics/kinetostatic_control.hpp"

namespace springfold::statics {

/// A spring whose force is asked for: that of a drive whose command is unknown, or one that stands, or may come to
/// stand, where its law is flat.
struct AskedSpring {
  std::size_t spring = 0;  ///< number among System::springs
  Index command = -1;      ///< of its drive, if it is unknown
};

/// Springs of joints that move freely are none: nothing stands in series with them.
std::vector<AskedSpring> asked_springs(const System& system, const ControlSolver& solver);

/// The system with straight laws of those springs, through their torques in the state of the solver. Their breakpoints
/// stay, with the same line on both sides.
System straightened(const System& system, const ControlSolver& solver,
                    const std::vector<AskedSpring>& asked);

/// A system with straight laws, and how well its forces are known in a solution.
struct StraightSprings {
  const System& system;
  const std::vector<AskedSpring>& asked;
  double force_error = 0;
};

/// The deflections with which the springs have the forces that they have in a solution with straight laws, and commands
/// that differ by as much: the places of the drives stay.
/// @param start   where the springs stood before
/// @param solver  the solution; changed
/// @returns false where a law never has its force: `solver.unable` tells it if the force is known
bool put_deflections(const System& system, const StraightSprings& straight,
                     const ControlSolver& start, ControlSolver& solver);

}  // namespace springfold::statics
