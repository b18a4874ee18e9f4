// A case of which a parameter moves few numbers, so that not all of it has to be built again.
#pragma once

#include <cstddef>
#include <functional>

#include "springfold/model/mechanism.hpp"
#include "springfold/model/moved_parts.hpp"

namespace springfold::analysis {

/// What a parameter of a case moves, alone. Without functions: nothing is known of it.
struct MovingCase {
  /// All that the parameter with this number moves; nullptr: more than such parts, or the study.
  std::function<const model::MovedParts*(std::size_t)> moved{};
  /// Gives these parts their numbers for another value of this parameter alone. @param mechanism  of any value
  /// @returns false, and nothing is changed, where only CaseFamily::at tells what the case is
  std::function<bool(std::size_t, double, model::Mechanism&)> put{};
};

}  // namespace springfold::analysis
