// Tables of the campaign, and whether its requirements are met.
#pragma once

#include <vector>

#include "invariance.hpp"
#include "judge.hpp"

namespace springfold::known_answers {

struct Campaign {
  std::vector<Verdict> verdicts{};  ///< in the order of the draws
  std::vector<Invariance> invariance{};
};

/// Prints both tables and the requirements that are not met.
/// @returns true if all are met
bool report(const Campaign& campaign);

}  // namespace springfold::known_answers
