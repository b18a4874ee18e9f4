// Rows that belong to a special point.
#pragma once

#include "springfold/analysis/result.hpp"

namespace springfold::analysis {

/// From a row of a branch to the next one that way.
inline constexpr std::size_t row_ahead = 1, row_back = static_cast<std::size_t>(-1);

/// Do branches meet in an event of this kind? A chain that is stretched out where its branch meets another (KS) changes
/// nothing about that.
inline bool is_meeting_of_branches(EventKind kind) {
  return kind == EventKind::branch_point || kind == EventKind::branching_kink ||
         kind == EventKind::touch || kind == EventKind::kinematic_singularity;
}

/// Has the event two rows of its branch, `row` and `row` + 1, one for each side of a switching spring? A kink at which
/// half-branches leave a spring that rests has one.
inline bool has_two_rows(const Branch& branch, const Event& event) {
  if (event.kind != EventKind::switching && event.kind != EventKind::corner_limit_point &&
      event.kind != EventKind::branching_kink)
    return false;
  // Both rows are the same place of the curve: the first column is the arc length.
  const std::size_t next = event.row + 1;
  return next < branch.samples.size() &&
         branch.samples[next].values.front() == branch.samples[event.row].values.front();
}

}  // namespace springfold::analysis
