// Parts of a mechanism whose numbers a parameter moves, in a prepared system.
#pragma once

#include "springfold/model/moved_parts.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::statics {

/// Where these parts stand in a system, and in all of the same form.
struct MovedPlaces {
  model::MovedParts parts{};
  std::vector<std::size_t> springs{};  ///< per law of a joint: among System::springs
  std::vector<Index> commands{};       ///< per command: in rho
  std::vector<std::size_t> groups{};   ///< per coupled spring: among System::coupled
};

/// @pre parts of system.mechanism; the joints of laws have coordinates, those of commands are actuated
MovedPlaces places_of(const System& system, model::MovedParts parts);

/// The system as prepare() gives it, after these parts of system.mechanism, and nothing else of it, have got other
/// numbers.
/// @returns false where a law bends at more or fewer places than before: the system is then of no use
bool renew(const MovedPlaces& places, System& system);

}  // namespace springfold::statics
