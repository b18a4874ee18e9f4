// What the methods that look for an equilibrium need to know of their unknowns. Private to statics.
#pragma once

#include "springfold/statics/system.hpp"

namespace springfold::statics {

/// Of a coordinate in one step: beyond, Newton's method without a search along its steps is lost, and may end anywhere.
constexpr double longest_newton = 3;

/// Where a method begins, and where it ends.
struct StartState {
  Vector z{};
  Inputs inputs{};
};

/// Of the unknowns, and behind them the commands.
inline bool is_angle(const System& system, Index unknown) {
  if (unknown >= system.size)
    return !system.command_is_length[static_cast<std::size_t>(unknown - system.size)];
  const auto i = static_cast<std::size_t>(unknown);
  return !system.is_wrench[i] && !system.is_length[i];
}

}  // namespace springfold::statics
