// What is asked about the motion after a loss of stability.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace springfold::analysis {

/// Damping of one joint in the overdamped motion.
struct JointDamping {
  std::string joint{};  ///< name of its coordinate: "leg_x.knee"
  double value = 1;     ///< torque per speed [force time/length, moment time/angle]
};

struct SnapSettings {
  int starts = 16;  ///< random first states when other states at the critical load are looked for
  std::uint64_t seed = 1;               ///< of these
  std::vector<JointDamping> damping{};  ///< others have one unit of the mechanism each
};

}  // namespace springfold::analysis
