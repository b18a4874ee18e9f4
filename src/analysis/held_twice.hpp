// Poses that hold what the joints hold already. Private to analysis.
#pragma once

#include "path_problem.hpp"
#include "springfold/analysis/study.hpp"
#include "springfold/continuation/curve.hpp"

namespace springfold::analysis {

inline constexpr const char* held_twice =
    "the pose holds a direction that the joints hold already, wherever the body goes: which of the "
    "two takes the "
    "force is not determined";
inline constexpr const char* held_twice_advice =
    "control = \"mixed\" drives the body along the direction alone";

/// Under control = "pose": are the closures dependent at every pose, and no longer where the pose is
/// prescribed along the direction alone, as control = "mixed" does?
bool holds_twice(const PathProblem& problem, const Study& study,
                 const continuation::CurvePoint& start);

}  // namespace springfold::analysis
