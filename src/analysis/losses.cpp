// Where stability under a study's control ends on its traced branches.
#include <cmath>
#include <limits>
#include <set>

#include "frozen.hpp"
#include "snap_jumps.hpp"
#include "springfold/analysis/event_rows.hpp"

namespace springfold::analysis {
namespace {

using Kind = QuantityDefinition::Kind;

bool may_lose_stability(const Event& event) {
  return event.kind == EventKind::limit_point || event.kind == EventKind::switching ||
         event.kind == EventKind::corner_limit_point || is_meeting_of_branches(event.kind);
}

/// The row from which those are reached whose count is not known, as along a family, none of whose states is more
/// stable than the next: stability that is there before it is lost where it ends.
std::size_t known_from(const Branch& branch, std::size_t row, std::size_t step, std::size_t index) {
  while (row < branch.samples.size() && std::isnan(branch.samples[row].values[index])) row += step;
  return row;
}

}  // namespace

std::vector<Loss> losses_of(const StudyResult& result,
                            const std::vector<QuantityDefinition>& quantities) {
  const std::size_t index = column_of(Kind::index, quantities);
  const std::size_t lambda = column_of(Kind::lambda, quantities);
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  std::vector<Loss> losses;
  std::set<std::string> seen;
  for (std::size_t b = 0; b < result.branches.size(); ++b) {
    const Branch& branch = result.branches[b];
    const auto value = [&](std::size_t row, std::size_t column) {
      return row < branch.samples.size() ? branch.samples[row].values[column] : nothing;
    };
    for (std::size_t e = 0; e < branch.events.size(); ++e) {
      const Event& event = branch.events[e];
      // A point in the first row ends the branch as one in the last row does. Where branches cross it is told once, on
      // the branch that passes if that loses its stability there, otherwise on one that begins stable.
      const bool begins = event.row == 0;
      if (!may_lose_stability(event)) continue;
      const std::size_t last = event.row + (has_two_rows(branch, event) ? 1 : 0);
      const double before = begins ? nothing : value(event.row - 1, index);
      const double after = value(last + 1, index);
      const bool ends = last + 1 >= branch.samples.size();
      const std::size_t stable_before = known_from(branch, event.row - 1, row_back, index),
                        stable_after = known_from(branch, last + 1, row_ahead, index);
      const bool from_before = value(stable_before, index) == 0 && (after > 0 || ends);
      const bool from_after = value(stable_after, index) == 0 && (before > 0 || begins);
      if (!from_before && !from_after) continue;
      const double here = value(event.row, lambda);
      const std::size_t beside = from_before ? stable_before : stable_after;
      const int loading = here >= value(beside, lambda) ? 1 : -1;
      if (is_meeting_of_branches(event.kind) && !seen.insert(event.label).second) continue;
      losses.push_back({b, e, loading, beside});
    }
  }
  return losses;
}

}  // namespace springfold::analysis
