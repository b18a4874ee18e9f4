// Who is eliminated in which front, before there are numbers. Private to core.
#pragma once

#include "springfold/core/frontal.hpp"

namespace springfold {

/// A front before there are numbers. Its variables: those that end here, those that stay.
struct Plan {
  Index ending = 0, staying = 0;
  std::size_t ids = 0;  ///< where its ending + staying variables begin in Plans::ids
};

struct Plans {
  std::vector<Plan> fronts{};
  std::vector<Index> ids{};
  std::vector<Index> element_places{};       ///< per entry of pattern.variables: place in its front
  std::vector<Index> carried_places{};       ///< per variable that stays: place in the next front
  std::vector<std::size_t> first_carried{};  ///< per front
  std::vector<Index> loose{};                ///< variables of no front
};

Plans plan_fronts(const FrontalPattern& pattern);

}  // namespace springfold
