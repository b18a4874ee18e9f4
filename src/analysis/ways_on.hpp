// Where branches meet: the ways out, and the one that a growing load takes. Private to analysis.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "path_problem.hpp"
#include "springfold/continuation/diagram.hpp"

namespace springfold::analysis {

/// No path is handed over from branch to branch more often: each time at a greater load.
inline constexpr int most_handovers = 50;

/// One of the ways out of a point at which branches meet.
struct WayOn {
  continuation::CurvePoint from{};  ///< that point, with the tangent outwards
  continuation::CurvePoint
      beside{};  ///< half-way to what comes next: nothing is lost or won before
};

/// What is asked of a state: its load, and how many of its modes are unstable; nothing where that is not known.
struct LoadedState {
  std::function<double(const continuation::CurvePoint&)> load{};
  std::function<std::optional<Index>(const continuation::CurvePoint&)> unstable{};
};

/// The way on behind a point at which branches meet where just one of all ways leads on with a load that changes as it
/// did on the way to the point, and is stable as that was: a load that straightens what was bent loses nothing there.
/// @param at  with the tangent of the arriving side
/// @returns nothing where it is otherwise, or not all ways are known
std::optional<WayOn> taken_over_at(const PathProblem& problem, const continuation::CurvePoint& at,
                                   const LoadedState& state,
                                   const continuation::TraceOptions& options);

/// The curve along a way from the point on, with its special points and those of the caller.
/// @param options  depth and number of branches are not used
continuation::Curve curve_along(const PathProblem& problem, const WayOn& way,
                                const std::vector<continuation::Event>& events,
                                continuation::DiagramOptions options,
                                const continuation::StepObserver& observer);

}  // namespace springfold::analysis
