// From the engine's curves to the branch table. Private to analysis.
#pragma once

#include <optional>

#include "closure_rank.hpp"
#include "quantities.hpp"
#include "springfold/continuation/curve.hpp"

namespace springfold::analysis {

class Asking;

/// What the events are that a study watches for: their tags.
enum EventTag : int {
  plain_event,       ///< a limit or a mark
  force_limit,       ///< an extremum of the force under displacement control
  whole_turn,        ///< a rotation comes near a whole turn: the branch ends there, incomplete
  dead_load_change,  ///< the count of modes that dead loads would make unstable changes
  driven_change,     ///< under load control: the displacement along the load turns back
  column_extremum,   ///< a quantity of `extrema` is stationary
};

/// How the names of places begin at which only that count changes (stability_changes.hpp).
inline constexpr const char* stability_mark =
    "the stiffness is singular here: unstable modes under dead load ";

/// What becomes one branch: one or two curves that leave the same point.
struct BranchSource {
  continuation::Curve backward{}, forward{};  ///< with the same first point
  Stop backward_stop{}, forward_stop{};
  /// Further points of the curves, for rows between those of the steps.
  std::vector<continuation::CurvePoint> backward_between{}, forward_between{};
  std::vector<continuation::Hit> at_start{};  ///< what the first point of both is itself
  std::optional<int> origin{};                ///< the junction at which the branch begins
  EventKind origin_kind = EventKind::branch_point;
  bool is_thinned = false;  ///< an interruption left out points for rows between those of the steps
};

/// A branch whose special points have no labels yet.
struct BranchRows {
  Branch branch{};
  std::vector<int> junctions{};  ///< per event: the junction at which it is, or -1
};

/// Rows from the backward end through the start to the forward end, special points as rows of their own. Interrupted,
/// it keeps those of the special points and of the steps, and of the others as many as are soon written.
/// @param asking  whether the rows are still wanted; nullptr: they are
BranchRows join(BranchSource source, const Evaluator& evaluator,
                const std::vector<QuantityDefinition>& quantities, const PathProblem& problem,
                const Asking* asking = nullptr);

/// How a junction is called, and as what it is seen on the first branch that shows it.
struct JunctionLabel {
  std::string label{};
  EventKind kind = EventKind::branch_point;
};

/// Numbers the events of all branches, LP1, LP2, ..., each branch from its first row; all events of
/// a junction have one label. Then fills the indices at critical points.
/// @returns one per junction; without a label where no branch shows it
std::vector<JunctionLabel> label_events(std::vector<BranchRows>& all, std::size_t junctions,
                                        const std::vector<QuantityDefinition>& quantities);

EventKind kind_of(const continuation::Hit& hit);

/// The engine's reason; complete at a limit and on a closed curve.
/// @param follows_branches  the study does already: nobody is told to ask for it
Stop stop_of(const continuation::Curve& curve, bool follows_branches = false);

/// Why a trace could not go on, if the closures or the springs say so; otherwise what it was given. What the engine
/// took it for is in the step log.
Stop explained(Stop stop, const EndOfCurve& at, const continuation::Curve& curve,
               const PathProblem& problem);

/// Ends the curve where it would go on through an infinite force. The chains' wrenches are no part of the metric, so
/// that a curve in the coordinates may lead past a dead centre: what comes behind belongs to forces of the other sign.
/// @param between  further points of the curve
void end_at_reach(continuation::Curve& curve, std::vector<continuation::CurvePoint>& between,
                  Stop& stop, const PathProblem& problem);

/// The other side of a curve that is all there is: closed, or a single point.
continuation::Curve nothing_behind(const continuation::Curve& curve);

/// The start point alone.
Branch single_point(const continuation::CurvePoint& start, const Evaluator& evaluator,
                    const std::vector<QuantityDefinition>& quantities, const PathProblem& problem);

/// Segment numbers of all springs with breakpoints: "0.1".
std::string piece_text(const statics::System& system, const Piece& piece);

}  // namespace springfold::analysis
