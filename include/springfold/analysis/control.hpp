// Commands along a path of targets: what the study kind `control` is asked. Units of the case.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "springfold/core/types.hpp"

namespace springfold::analysis {

/// Which iteration finds commands.
enum class CommandMethod {
  newton,  ///< exact derivatives, KINSOL where plain Newton does not converge
  paper,   ///< the paper's own scheme, to compare
};

/// What is prescribed and what is chosen for it; for the kinds `control` and `map`.
struct CommandSettings {
  std::vector<Index> prescribed{};      ///< pose coordinates of the body; empty: all
  std::vector<std::string> commands{};  ///< actuators, "chain.joint"; empty: all
  CommandMethod method = CommandMethod::newton;
};

/// An arc in the plane of two prescribed coordinates; the others stay as in the centre.
struct CirclePath {
  Vector centre{};  ///< prescribed coordinates
  double radius = 0;
  Index first = 0, second = 1;  ///< numbers among the prescribed coordinates
  double from = 0, to = 0;      ///< angles [rad], from `first` towards `second`
};

/// Targets 1, 2, ..., n; in between the path is straight, or runs along the circle.
struct ControlPath {
  std::vector<Vector> targets{};  ///< prescribed coordinates; circle: empty
  std::optional<CirclePath> circle{};
  int circle_points = 0;  ///< targets on the circle
  /// Wrench on the body (d entries) on top of the constant load: one per target, or two, from the
  /// first target to the last; empty: none. In between they change linearly.
  std::vector<Vector> loads{};

  int count() const { return circle ? circle_points : static_cast<int>(targets.size()); }
};

}  // namespace springfold::analysis
