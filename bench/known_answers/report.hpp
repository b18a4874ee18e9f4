// Tables of the campaign, and whether its requirements are met.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "invariance.hpp"
#include "judge.hpp"

namespace springfold::known_answers {

struct Campaign {
  std::vector<Verdict> verdicts{};  ///< in the order of the draws
  std::vector<Invariance> invariance{};
};

/// A draw that breaks a requirement.
struct Failure {
  std::string family{};       ///< of the draw
  std::string requirement{};  ///< one of those that it breaks
};

struct Outcomes {
  bool met = true;                     ///< known gaps do not count
  std::map<long, Failure> failures{};  ///< by the number of the draw
};

/// Prints both tables and the requirements that are not met.
Outcomes report(const Campaign& campaign);

}  // namespace springfold::known_answers
