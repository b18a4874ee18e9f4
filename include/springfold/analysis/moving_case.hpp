// A case of which a parameter moves few numbers, so that not all of it has to be built again.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "springfold/analysis/study.hpp"
#include "springfold/model/moved_parts.hpp"

namespace springfold::analysis {

/// What CaseFamily::at may hold: then it tells more than the call does (std::function::target).
struct MovingCase {
  /// As CaseFamily::at.
  std::function<Variant(const std::vector<std::pair<std::size_t, double>>&)> whole{};
  /// All that the parameter with this number moves; nullptr: more than such parts, or the study.
  std::function<const model::MovedParts*(std::size_t)> moved{};
  /// Gives these parts their numbers for another value of this parameter alone. @param mechanism  of any value
  /// @returns false, and nothing is changed, where only `whole` tells what the case is
  std::function<bool(std::size_t, double, model::Mechanism&)> put{};

  Variant operator()(const std::vector<std::pair<std::size_t, double>>& values) const {
    return whole(values);
  }
};

}  // namespace springfold::analysis
