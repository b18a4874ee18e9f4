// Runs one study.
#pragma once

#include <functional>
#include <optional>

#include "springfold/analysis/result.hpp"
#include "springfold/analysis/study.hpp"

namespace springfold::analysis {

/// Called after every accepted step with the number of points so far and the arc length reached;
/// for maps several times a second with the number of nodes so far and the part that they are.
/// Returning false stops the trace there; what was traced is kept and marked incomplete.
using Observer = std::function<bool(int points, double s)>;

/// Rows of a map, in the order of its nodes; only those that are done mean anything.
struct PartialRows {
  std::vector<Sample> rows{};
  std::vector<bool> done{};
};

/// How a study is run; nothing here changes results.
struct RunOptions {
  int threads = 0;  ///< maps: 0 stands for all cores
  /// Maps: rows of an earlier run of the same study that need not be computed again.
  const PartialRows* known = nullptr;
  /// Maps: called now and then, and at the end if the map is not complete, from the calling thread.
  std::function<void(const PartialRows&)> checkpoint{};
};

/// First equilibrium, then the branch through it in both directions; kinds control, map and
/// workspace: their rows as the only branch.
/// @param family needed for control mode `parameter` only, otherwise nullptr
/// Never throws for numerical reasons: what could not be done is said in the result.
/// @throws std::invalid_argument with all that problems_in() says of the mechanism and of the study
StudyResult run_study(const model::Mechanism& mechanism, const Study& study,
                      const ParameterFamily* family = nullptr, const Observer& observer = {},
                      const RunOptions& options = {});

/// Closes the chains and solves the start of a study as run_study does, and traces nothing; of a study
/// of kind control its first target. @returns nothing for maps and workspaces, which have no start
std::optional<StartReport> solve_start(const model::Mechanism& mechanism, const Study& study,
                                       const ParameterFamily* family = nullptr);

/// The mechanism `now` (the same, or that of another value of a parameter) with the springs that are
/// counted from the start pose moved there, as they act in the study. Unchanged where there are none, or
/// where the chains cannot be closed in the start pose.
model::Mechanism with_springs_from_start(const model::Mechanism& mechanism, const Study& study,
                                         const model::Mechanism& now);

}  // namespace springfold::analysis
