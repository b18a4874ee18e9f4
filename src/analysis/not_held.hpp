// Why no commands hold a body at a target. Private to analysis.
#pragma once

#include <string>

#include "commanded.hpp"

namespace springfold::analysis {

struct NotHeld {
  /// A chain cannot be closed there. Otherwise springs and load are not balanced, or no commands are found that do so.
  bool is_unreachable = false;
  std::string why{};      ///< empty: it is held
  bool is_shown = false;  ///< that no commands hold it, and not only that none were found
};

/// "unreachable: " or "not held: ", and why.
std::string words(const NotHeld& failed);

/// Why a target is not held: a chain that is too short; a drive whose spring cannot have the force that it takes;
/// coordinates on which neither a command nor a spring acts; how much of the load can be held there; or what is left
/// where the iteration ended. Drives are judged by their forces, wherever their springs stand.
/// @param target, W  prescribed coordinates and stacked load, dimensionless
/// @param result     of the solve that failed
NotHeld why_not_held(const CommandSetup& setup, const Vector& target, const Vector& W,
                     const statics::ControlResult& result);

}  // namespace springfold::analysis
