// Events of the reaction to a prescribed displacement: extrema of the force, and changes of stability under dead load.
// Private to analysis.
#pragma once

#include "branch_rows.hpp"

namespace springfold::analysis {

/// Name of the engine's event where, the pose being held, the number of modes that dead loads would make unstable
/// changes.
inline constexpr const char* dead_load_change_name =
    "under the same loads, not held, another number of modes is unstable";

/// Name of the engine's event where under load control the displacement along the load turns back.
inline constexpr const char* driven_change_name =
    "the displacement along the load turns back: if it were driven, stability would change";

/// The second of these as an event: the determinant of the equilibrium matrix with all bodies free is zero. @pre the
/// problem is symmetric; the evaluator outlives the event
continuation::Event dead_load_event(const Evaluator& evaluator);

/// Where a curve crosses another one at its tip, force and lambda turn back at the branch point itself: it says so, and
/// the extremum of the force is no point of its own. Neither is a change of stability under dead load where the force
/// has its extremum, or where another special point lies. A switching on one side of which the force stands still is no
/// extremum.
continuation::Curve with_merged_force_events(continuation::Curve curve, const Evaluator& evaluator);

/// Does the curve begin or end at a branch point near this one? Nearer than points are told apart, rates and
/// determinants of a branch are those of the point where it begins, and rounding has their sign.
bool is_beside_branch_end(const continuation::Curve& curve, const continuation::CurvePoint& point,
                          const PathProblem& problem);

}  // namespace springfold::analysis
