// Judges a run against the closed forms of its draw.
#pragma once

#include <string>
#include <vector>

#include "draw.hpp"
#include "springfold/analysis/result.hpp"

namespace springfold::guyed {

enum class Outcome {
  right,
  unresolved,  ///< nothing that is told is wrong, and what is missing is said to be
  wrong,
};

struct Verdict {
  Outcome outcome = Outcome::right;
  std::vector<std::string> reasons{};  ///< of the engine, if it left something open
  std::vector<std::string> faults{};   ///< what is wrong or missing
};

/// Loads at which branches leave the upright state, how many and in which directions, the number of unstable modes in
/// every row of that state, and nothing else there. Cables stretched or slack by less than `told_as_resting` may be
/// told as such or as just at rest, all of them in one way.
Verdict judge(const Draw& draw, const analysis::StudyResult& result);

}  // namespace springfold::guyed
