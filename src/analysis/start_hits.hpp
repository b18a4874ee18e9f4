// What the start of a branch itself is: limit points, switchings, corners and changes of stability that lie on it.
// Private to analysis.
#pragma once

#include "branch_rows.hpp"
#include "within_limits.hpp"

namespace springfold::analysis {

/// Neither of the two curves that leave an ordinary start meets what lies on the start. A short curve through it does:
/// from a point of the backward curve, nearer than its first special point, to beyond the start. What both curves meet
/// in an interval that reaches back to the start is the start as well, and is taken from them. A flat limit point,
/// which rounding does not place, is told by the rates of lambda beside it, or said to be unresolved. A closed curve
/// that begins on a special point becomes two halves (closed_start.hpp).
/// @returns the special points at the start, s = 0, in the direction of the forward curve, switchings of springs on
/// whose thresholds it lies among them; marks, which start_marks.hpp tells, are left out
std::vector<continuation::Hit> hits_at_start(const Following& with, BranchSource& source);

bool is_same_kind(const continuation::Hit& a, const continuation::Hit& b);

/// The special point as one of the start: s = 0.
continuation::Hit moved_to_start(continuation::Hit hit);

/// Nothing but a spring that begins or ends to act.
bool only_switches(const continuation::Hit& hit, const Evaluator& evaluator);

}  // namespace springfold::analysis
