// The same branch followed in other ways must give the same events.
#pragma once

#include <array>

#include "follow.hpp"

namespace springfold::known_answers {

/// What is changed. See main.cpp for the meaning of each.
enum class Change {
  reversed,
  restarted,
  steps_quarter,
  steps_half,
  steps_double,
  steps_fourfold,
  rotated,
  mirrored,
  units_bitwise,
  units_binary,
  units_decimal,
  forces_binary,
};
constexpr std::size_t change_count = 12;
const char* name_of(Change change);

enum class Same { yes, no, not_compared };

struct Invariance {
  long number = 0;     ///< of the draw
  bool close = false;  ///< gap or separation so small that a cluster or a refusal is allowed
  std::array<Same, change_count> same{};
};

/// Repeats everything on one draw. Not compared: where the curve was refused in the first place.
/// @param tell  print what differs
Invariance check_invariance(const Embedded& problem, const Draw& draw, const Followed& followed,
                            Random& random, bool tell);

}  // namespace springfold::known_answers
