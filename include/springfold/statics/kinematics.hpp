// The mechanism with all elastic coordinates at rest: plain inverse kinematics and the factors by
// which the actuators' speeds and forces reach the platform.
#pragma once

#include "springfold/statics/system.hpp"

namespace springfold::statics {

/// Which pose coordinates of a body are prescribed, and which commands are chosen for that.
struct CommandTask {
  Index body = 1;                   ///< body number, 1 is the first moving one
  std::vector<Index> prescribed{};  ///< pose coordinates of the body; empty: all
  std::vector<Index> commands{};    ///< entries of rho; empty: all
};

/// The task with its lists filled in. Empty lists stand for all.
CommandTask completed(const CommandTask& task, const System& system);

/// As many commands as prescribed coordinates?
bool counts_match(const CommandTask& task, const System& system);

/// z with every elastic coordinate (virtual springs, springs of drives) where its own torque
/// vanishes, nearest to its initial value; everything else as in `z`, wrenches zero.
Vector at_rest(const System& system, Vector z);

struct KinematicInverse {
  bool closed = false;  ///< all chains close at the target
  bool unique = false;  ///< nothing but the target decides the commands (locally)
  Vector z{};      ///< coordinates and poses, wrenches zero; the nearest approach if not closed
  Vector rho{};    ///< commands, those outside of the task as guessed
  double gap = 0;  ///< largest closure residual
  std::size_t chain = 0;  ///< of this chain
  bool elastic = false;   ///< not closed, but elastic coordinates could make the gap smaller
  int iterations = 0;
};

/// Commands that bring the prescribed coordinates to `target` with all springs at rest: damped
/// least squares (Levenberg-Marquardt) on the closure equations in the passive and preloaded
/// coordinates, the commands and the poses that are not prescribed. Where the chains cannot be
/// closed the state of least squares remains, which says what is short and by how much.
/// @param z, rho  guess; their elastic coordinates and wrenches are not used
KinematicInverse kinematic_inverse(const System& system, const CommandTask& task,
                                   const Vector& target, const Vector& z, const Vector& rho);

/// How far one chain is from closing.
struct ChainGap {
  std::size_t chain = 0;  ///< number of the chain
  double length = 0;      ///< distance of its end from where it belongs
  double angle = 0;       ///< angle by which its end is turned against it [rad]
};

/// Where damped least squares on the closures ends in these unknowns, whatever springs say.
struct NearestApproach {
  bool closed = false;
  Vector z{}, rho{};
  std::vector<ChainGap> gaps{};  ///< of all chains that do not close, the largest first
};

/// @param moving    entries of z that may move, wrenches not among them
/// @param commands  entries of rho that may move
NearestApproach nearest_approach(const System& system, const std::vector<Index>& moving,
                                 const std::vector<Index>& commands, const Vector& z,
                                 const Vector& rho);

/// How a body moves with the commands while all elastic coordinates rest:
/// twist = velocity rho', wrench = force tau with force = velocity^-T.
struct Transmission {
  Matrix velocity{};  ///< d x commands, twist in world axes at the body's origin; empty: the body
                      ///< can move while the commands stand still (or not at all): singular
  Matrix force{};     ///< d x commands; empty: not as many commands as coordinates, or singular
};

/// @param z, rho  a closed state, as of kinematic_inverse
Transmission transmission(const System& system, const CommandTask& task, const Vector& z,
                          const Vector& rho);

/// Largest and smallest singular value of a block of rows: the factors of one part (translation or
/// rotation). Empty block: NaN.
struct Factors {
  double smallest = 0, largest = 0;
};
Factors factors_of(const Matrix& rows);

}  // namespace springfold::statics
