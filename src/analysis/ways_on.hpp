// The ways that lead out of a point at which branches meet. Private to analysis.
#pragma once

#include <optional>
#include <vector>

#include "path_problem.hpp"
#include "springfold/continuation/options.hpp"
#include "springfold/continuation/ray.hpp"

namespace springfold::analysis {

/// One of them.
struct WayOn {
  continuation::CurvePoint from{};
  continuation::Ray ray{};  ///< with its `start`: on the way to it nothing else is met
};

/// All ways out of a point at which branches meet, that of arrival among them. Nothing: not all are known.
std::optional<std::vector<WayOn>> ways_from(const PathProblem& problem,
                                            const continuation::CurvePoint& at,
                                            const continuation::TraceOptions& options);

}  // namespace springfold::analysis
