#include "stable_walk.hpp"

#include <cmath>

#include "frozen.hpp"
#include "springfold/analysis/event_rows.hpp"

namespace springfold::analysis {

StableWalk::StableWalk(const std::vector<QuantityDefinition>& quantities, const StudyResult& result)
    : result_{result},
      index_{column_of(QuantityDefinition::Kind::index, quantities)},
      lambda_{column_of(QuantityDefinition::Kind::lambda, quantities)} {}

std::vector<const Event*> StableWalk::ends_of(int branch, std::size_t row, int direction) const {
  if (branch < 1) return {};
  const auto first = static_cast<std::size_t>(branch - 1);
  const auto& rows = result_.branches[first].samples;
  if (row + 1 >= rows.size()) return {};
  const bool grows = rows[row + 1].values[lambda_] > rows[row].values[lambda_];
  const int step = grows == (direction > 0) ? 1 : -1;
  std::vector<Next> open{{first, step > 0 ? row : row + 1, step}};
  std::vector<const Event*> ends;
  constexpr std::size_t most_branches = 100;
  for (std::size_t k = 0; k < open.size() && k < most_branches; ++k) {
    const Next at = open[k];
    const Event* event = first_unstable(at.branch, at.row, at.step);
    if (event == nullptr) continue;
    const auto next = stable_branches_from(*event, at.branch, direction);
    if (next.empty()) ends.push_back(event);
    open.insert(open.end(), next.begin(), next.end());
  }
  return ends;
}

std::optional<StableWalk::Next> StableWalk::stable_branch_from(const Event& event, std::size_t from,
                                                               int direction) const {
  const auto all = stable_branches_from(event, from, direction);
  return all.empty() ? std::nullopt : std::optional(all.front());
}

std::vector<StableWalk::Next> StableWalk::stable_branches_from(const Event& event, std::size_t from,
                                                               int direction) const {
  if (!is_meeting_of_branches(event.kind)) return {};
  std::vector<Next> list;
  for (std::size_t b = 0; b < result_.branches.size(); ++b) {
    const Branch& branch = result_.branches[b];
    for (const Event& other : branch.events) {
      if (other.label != event.label) continue;
      for (const int step : {1, -1}) {
        const bool behind_both = step > 0 && has_two_rows(branch, other);
        const auto row = static_cast<std::ptrdiff_t>(other.row) + (behind_both ? 2 : step);
        if (row < 0 || row >= std::ssize(branch.samples)) continue;
        const auto& values = branch.samples[static_cast<std::size_t>(row)].values;
        const double moved = values[lambda_] - branch.samples[other.row].values[lambda_];
        if (values[index_] == 0 && moved * direction > 0)
          list.push_back({b, static_cast<std::size_t>(row), step, b != from});
      }
    }
  }
  return list;
}

const Event* StableWalk::event_at(std::size_t branch, std::size_t row) const {
  const Branch& on = result_.branches[branch];
  for (const Event& event : on.events)
    if (event.row == row || (event.row + 1 == row && has_two_rows(on, event))) return &event;
  return nullptr;
}

bool StableWalk::turns_at(std::size_t branch, const Event& event) const {
  const Branch& on = result_.branches[branch];
  const std::size_t last = event.row + (has_two_rows(on, event) ? 1 : 0);
  if (event.row == 0 || last + 1 >= on.samples.size()) return false;
  const double here = on.samples[event.row].values[lambda_];
  return (here - on.samples[event.row - 1].values[lambda_]) *
             (on.samples[last + 1].values[lambda_] - here) <
         0;
}

const Event* StableWalk::first_unstable(std::size_t branch, std::size_t row, int step) const {
  const auto& rows = result_.branches[branch].samples;
  const Event* last = nullptr;
  const Event* const left = row < rows.size() ? event_at(branch, row) : nullptr;
  for (auto r = static_cast<std::ptrdiff_t>(row); r >= 0 && r < std::ssize(rows); r += step) {
    const auto k = static_cast<std::size_t>(r);
    const Event* event = event_at(branch, k);
    // A bent branch comes back to where it left a straight one: with lambda going on, it ends there.
    if (event != nullptr && event != left && is_meeting_of_branches(event->kind) &&
        turns_at(branch, *event))
      return event;
    const double index = rows[k].values[index_];
    if (event != nullptr && event->kind != EventKind::user_value &&
        event->kind != EventKind::end_of_range)
      last = event;
    else if (index > 0)
      return last;
    else if (index == 0)
      last = nullptr;
  }
  return last != nullptr && (last->kind == EventKind::branching_kink ||
                             last->kind == EventKind::branch_point ||
                             last->kind == EventKind::kinematic_singularity)
             ? last
             : nullptr;
}

}  // namespace springfold::analysis
