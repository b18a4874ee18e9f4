// Points at which a mechanism is commanded: their columns and values. Private to analysis.
#pragma once

#include <string>
#include <vector>

#include "scales.hpp"
#include "springfold/analysis/result.hpp"
#include "springfold/analysis/study.hpp"
#include "springfold/statics/kinetostatic_control.hpp"

namespace springfold::analysis {

/// A study of commands made dimensionless.
struct CommandSetup {
  Scales scales{};
  statics::System system{};
  statics::CommandTask task{};  ///< with its lists filled in
  Vector pose_scale{};          ///< d: physical = scale * dimensionless
  Vector wrench_scale{};        ///< d
  Vector command_scale{};       ///< of every command
  Vector W{};                   ///< constant load on the body, dimensionless, stacked
  Vector pose{};                ///< the body's own pose, dimensionless
  Index t = 0, d = 0;           ///< pose of the body in z

  /// Physical prescribed coordinates -> dimensionless ones.
  Vector target_of(const Vector& physical) const;
  /// The constant load and `physical` (d entries or none) on top of it, stacked.
  Vector load_of(const Vector& physical) const;
};

CommandSetup command_setup(const model::Mechanism& mechanism, const Study& study,
                           const Vector& constant_load);

/// One commanded point, dimensionless.
struct CommandedState {
  Vector z{};
  statics::Inputs inputs{};
  Piece piece{};
  statics::KinematicInverse plain{};  ///< plain inverse kinematics of the same target
  double iterations = 0;
};

/// Columns of such a point, without those of the path or the grid in front of them.
/// @param directions  d entries each, along which stiffness and compliance are given
std::vector<Quantity> command_columns(const CommandSetup& setup,
                                      const std::vector<Vector>& directions);

/// Values in the order of command_columns and number of unstable modes under dead load.
struct CommandedValues {
  std::vector<double> values{};
  std::optional<Index> index_force{};
  bool countable = true;  ///< false: an external moment on a spatial body, no index is defined
};

/// "ok", "unstable" (unstable modes under dead load) or "critical" (their number is undefined).
std::string status_of(const CommandedValues& at);
NodeState state_of(const CommandedValues& at);

CommandedValues command_values(const CommandSetup& setup, const std::vector<Vector>& directions,
                               const CommandedState& state);

/// Stiffness and compliance of the study's body, all other bodies free, in world axes.
struct BodyStiffness {
  Matrix K{}, C{};  ///< d x d, dimensionless; empty where undefined
};
BodyStiffness body_stiffness(const CommandSetup& setup, const Vector& z, const Matrix& A_full);

/// Plain inverse kinematics at a target, in steps from a state that is closed already.
statics::KinematicInverse approach(const CommandSetup& setup, const Vector& target,
                                   const statics::KinematicInverse& from);

/// Plain inverse kinematics at the body's own pose, or where the guess leads.
statics::KinematicInverse at_own_pose(const CommandSetup& setup);

}  // namespace springfold::analysis
