// Quantities over a grid of poses or parameters: what the study kind `map` is asked. Units of the
// case.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "springfold/analysis/situation.hpp"

namespace springfold::analysis {

/// How the commands of a node are chosen.
enum class NodeCommand {
  kinetostatic,  ///< the node is the pose in equilibrium
  geometric,     ///< plain inverse kinematics: the platform then settles beside the node
  given,         ///< the commands of the mechanism; axes are parameters
};

/// Equally spaced values of a pose coordinate or of a parameter of the case.
struct MapAxis {
  std::string name{};           ///< column: "tool.x" or the parameter's name
  std::optional<Index> pose{};  ///< pose coordinate of the body; none: a parameter
  double from = 0, to = 0;
  int points = 2;

  /// Value at place i.
  double at(int i) const;
};

/// Where stability is lost first when a dead load grows along a direction.
struct CriticalSettings {
  Vector direction{};  ///< d entries, unit length as in Study::direction
  double up_to = 0;    ///< largest load looked at
};

struct MapSettings {
  std::vector<MapAxis> axes{};  ///< 1 to 3; the first one runs fastest
  NodeCommand command = NodeCommand::kinetostatic;
  Vector pose{};                     ///< coordinates that are no axes; empty: the body's own pose
  std::vector<Vector> directions{};  ///< stiffness and compliance along them, unit length
  std::optional<CriticalSettings> critical{};
  /// Mechanism and load for values of the axes that are parameters, in the order of the axes; may
  /// be called by several threads. Needed if there are any.
  std::function<Situation(const std::vector<double>&)> situation{};

  int nodes() const;
};

}  // namespace springfold::analysis
