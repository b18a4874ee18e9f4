// Stable parts of branches, followed from a landing to the next loss of stability.
#include <algorithm>
#include <cmath>
#include <set>

#include "frozen.hpp"
#include "snap_jumps.hpp"

namespace springfold::analysis {
namespace {

using Kind = QuantityDefinition::Kind;

class StableWalk {
 public:
  StableWalk(const std::vector<QuantityDefinition>& quantities, const StudyResult& result)
      : result_{result},
        index_{column_of(Kind::index, quantities)},
        lambda_{column_of(Kind::lambda, quantities)} {}

  /// The special point at which stability ends when lambda goes in this direction from between the rows
  /// `row` and `row` + 1 of a branch (numbers from 1); null where the range ends before.
  const Event* end_of(int branch, std::size_t row, int direction) const {
    if (branch < 1) return nullptr;
    auto b = static_cast<std::size_t>(branch - 1);
    const auto& rows = result_.branches[b].samples;
    if (row + 1 >= rows.size()) return nullptr;
    const bool grows = rows[row + 1].values[lambda_] > rows[row].values[lambda_];
    int step = grows == (direction > 0) ? 1 : -1;
    std::size_t at = step > 0 ? row : row + 1;
    constexpr int most_branches = 100;
    for (int k = 0; k < most_branches; ++k) {
      const Event* event = first_unstable(b, at, step);
      if (event == nullptr) return nullptr;
      const auto next = stable_branch_from(*event, b, direction);
      if (!next) return event;
      b = next->branch;
      at = next->row;
      step = next->step;
    }
    return nullptr;
  }

  struct Next {
    std::size_t branch = 0, row = 0;
    int step = 1;
    bool is_start = false;
  };

  /// A branch that leaves this point stably as lambda goes on.
  std::optional<Next> stable_branch_from(const Event& event, std::size_t from,
                                         int direction) const {
    if (event.kind != EventKind::branch_point && event.kind != EventKind::branching_kink &&
        event.kind != EventKind::touch)
      return std::nullopt;
    for (std::size_t b = 0; b < result_.branches.size(); ++b) {
      const Branch& branch = result_.branches[b];
      for (const Event& other : branch.events) {
        if (other.label != event.label) continue;
        for (const int step : {1, -1}) {
          const auto row = static_cast<std::ptrdiff_t>(other.row) + step;
          if (row < 0 || row >= std::ssize(branch.samples)) continue;
          const auto& values = branch.samples[static_cast<std::size_t>(row)].values;
          const double moved = values[lambda_] - branch.samples[other.row].values[lambda_];
          if (values[index_] == 0 && moved * direction > 0)
            return Next{b, static_cast<std::size_t>(row), step, b != from};
        }
      }
    }
    return std::nullopt;
  }

 private:
  const Event* event_at(std::size_t branch, std::size_t row) const {
    for (const Event& event : result_.branches[branch].events)
      if (event.row == row ||
          (event.row + 1 == row &&
           (event.kind == EventKind::switching || event.kind == EventKind::corner_limit_point ||
            event.kind == EventKind::branching_kink)))
        return &event;
    return nullptr;
  }

  /// The special point behind the last stable row.
  const Event* first_unstable(std::size_t branch, std::size_t row, int step) const {
    const auto& rows = result_.branches[branch].samples;
    const Event* last = nullptr;
    for (auto r = static_cast<std::ptrdiff_t>(row); r >= 0 && r < std::ssize(rows); r += step) {
      const auto k = static_cast<std::size_t>(r);
      const Event* event = event_at(branch, k);
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
                               last->kind == EventKind::branch_point)
               ? last
               : nullptr;
  }

  const StudyResult& result_;
  std::size_t index_, lambda_;
};

std::string towards(const StudyResult& result, const std::vector<QuantityDefinition>& quantities,
                    const StableWalk::Next& next, const Event& event) {
  const Branch& branch = result.branches[next.branch];
  const auto begin = std::find_if(branch.events.begin(), branch.events.end(),
                                  [&](const Event& e) { return e.label == event.label; });
  std::string name;
  double largest = 0;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const auto& q = quantities[i];
    if (q.kind != Kind::unknown || q.unit == Unit::force || q.unit == Unit::moment) continue;
    const double d =
        (branch.samples[next.row].values[i] - branch.samples[begin->row].values[i]) / q.scale;
    if (std::abs(d) <= largest * (1 + 1e-6)) continue;
    largest = std::abs(d);
    name = (d < 0 ? "-" : "+") + q.name;
  }
  return name;
}

}  // namespace

void close_loops(const std::vector<QuantityDefinition>& quantities, const StudyResult& result,
                 SnapReport& report) {
  const StableWalk walk(quantities, result);
  const auto jump_from = [&report](const Event* event, int loading) {
    if (event == nullptr) return 0;
    for (std::size_t i = 0; i < report.jumps.size(); ++i)
      if (report.jumps[i].from == event->label && report.jumps[i].loading == loading)
        return static_cast<int>(i) + 1;
    return 0;
  };
  for (Jump& jump : report.jumps) {
    const Event* back = walk.end_of(jump.landing.branch, jump.landing.row, -jump.loading);
    jump.back = jump_from(back, -jump.loading);
    if (jump.back == 0) continue;
    const Jump& other = report.jumps[static_cast<std::size_t>(jump.back - 1)];
    const Event* again = walk.end_of(other.landing.branch, other.landing.row, jump.loading);
    if (again != nullptr && again->label == jump.from) jump.loop = jump.released + other.released;
  }
  for (const Loss& loss : losses_of(result, quantities)) {
    const Event& event = result.branches[loss.branch].events[loss.event];
    const auto next = walk.stable_branch_from(event, loss.branch, loss.loading);
    if (next && next->branch != loss.branch)
      report.handovers.push_back({event.label, static_cast<int>(loss.branch) + 1,
                                  static_cast<int>(next->branch) + 1,
                                  towards(result, quantities, *next, event)});
  }
}

}  // namespace springfold::analysis
