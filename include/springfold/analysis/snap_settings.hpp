// What is asked about the motion after a loss of stability.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace springfold::analysis {

/// Damping of one joint in a motion.
struct JointDamping {
  std::string joint{};  ///< name of its coordinate: "leg_x.knee"
  double value = 1;     ///< torque per speed [force time/length, moment time/angle]
};

/// The motion with the masses of the mechanism, from every push.
struct InertialSettings {
  /// Of the softest mode at the landing; the dampers stand to each other as in the overdamped motion.
  double damping_ratio = 0.1;
  std::vector<JointDamping> damping{};  ///< if any: these dampers instead, and no others
};

/// Levels of lambda that are gone to one after the other.
struct CycleSettings {
  std::vector<double> levels{};
  int times = 1;  ///< the whole list so many times
};

/// All stable states and the jumps between them.
struct TransitionSettings {
  std::vector<double> search_at{};  ///< values of lambda at which states are searched for
  std::vector<double>
      barriers_at{};   ///< values of lambda at which barriers between states are looked for
  int starts = 64;     ///< random first states of each search
  int maximum = 2000;  ///< stable states
};

struct SnapSettings {
  int starts = 16;  ///< random first states when other states at the critical load are looked for
  std::uint64_t seed = 1;                           ///< of these
  std::vector<JointDamping> damping{};              ///< others have one unit of the mechanism each
  std::optional<InertialSettings> inertia{};        ///< wanted?
  std::optional<CycleSettings> cycle{};             ///< kind load_cycle
  std::optional<TransitionSettings> transitions{};  ///< kind transitions
};

}  // namespace springfold::analysis
