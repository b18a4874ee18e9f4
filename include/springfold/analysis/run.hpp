// Runs one study.
#pragma once

#include <functional>

#include "springfold/analysis/result.hpp"
#include "springfold/analysis/study.hpp"

namespace springfold::analysis {

/// Called after every accepted step with the number of points so far and the arc length reached.
/// Returning false stops the trace there; what was traced is kept and marked incomplete.
using Observer = std::function<bool(int points, double s)>;

/// First equilibrium, then the branch through it in both directions.
/// @param family needed for control mode `parameter` only, otherwise nullptr
/// @pre problems_in(study, mechanism).empty()
/// Never throws for numerical reasons: what could not be done is said in the result.
StudyResult run_study(const model::Mechanism& mechanism, const Study& study,
                      const ParameterFamily* family = nullptr, const Observer& observer = {});

}  // namespace springfold::analysis
