// What happens on the way from one target to the next. Private to analysis.
#pragma once

#include <optional>

#include "control_path.hpp"
#include "springfold/continuation/options.hpp"

namespace springfold::analysis {

/// A special point on the way.
struct LegEvent {
  EventKind kind = EventKind::limit_point;
  std::string detail{};
  double place = 0;                         ///< on the path: 3.62 lies between targets 3 and 4
  CommandedState state{};                   ///< arriving, without plain inverse kinematics
  std::optional<CommandedState> leaving{};  ///< the other side of a switching spring
};

struct Leg {
  std::optional<CommandedState> end{};  ///< at the next target; empty: control is lost before it
  std::string lost{};                   ///< then: why,
  std::optional<double> lost_place{};   ///< and where, if not at the last event
  std::vector<LegEvent> events{};       ///< in the order of the path
};

/// Follows the commands from the state at target `leg` to the next target, by tracing the curve of
/// equilibria in the path parameter; locates limit points, branch points, switching springs, and
/// changes of the number of unstable modes at fixed commands.
Leg follow_leg(const CommandSetup& setup, const TargetPath& path, int leg,
               const CommandedState& from, const continuation::TraceOptions& options);

}  // namespace springfold::analysis
