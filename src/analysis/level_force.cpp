#include "level_force.hpp"

#include <algorithm>

#include "springfold/analysis/event_rows.hpp"

namespace springfold::analysis {
namespace {

/// A switching on the way along the branch: its rows on the side from which one comes and on that to which one goes,
/// and the force's rate there, 0 where it stands still.
struct Passed {
  Event* event = nullptr;
  std::size_t from = 0, to = 0;
  double before = 0, after = 0;
};

class LevelStretches {
 public:
  LevelStretches(const std::vector<Entry>& entries, const Evaluator& evaluator, Branch& branch)
      : entries_{entries}, evaluator_{evaluator}, branch_{branch} {}

  void tell() const {
    std::vector<Passed> ahead, back;
    for (Event& event : branch_.events) {
      if (event.kind != EventKind::switching && event.kind != EventKind::corner_limit_point)
        continue;
      if (!has_two_rows(branch_, event)) continue;
      const std::size_t row = event.row;
      const double before = rate_beside(row, row_back), after = rate_beside(row + 1, row_ahead);
      ahead.push_back({&event, row, row + 1, before, after});
      if (row < branch_.start_row) back.push_back({&event, row + 1, row, after, before});
    }
    std::reverse(back.begin(), back.end());
    tell_on(ahead, branch_.start_row);
    tell_on(back, 0);
  }

 private:
  double rate_at(std::size_t row) const {
    return evaluator_.force_rate(entries_[row].point).told();
  }

  /// At the switching itself a rate may vanish that does not beside it: where a law is smooth there.
  double rate_beside(std::size_t row, std::size_t step) const {
    const double here = rate_at(row);
    const std::size_t next = row + step;
    return here != 0 || next >= entries_.size() || entries_[next].hit != nullptr ? here
                                                                                 : rate_at(next);
  }

  bool stands_still(std::size_t a, std::size_t b) const {
    for (std::size_t row = std::min(a, b); row <= std::max(a, b); ++row)
      if (rate_at(row) != 0) return false;
    return true;
  }

  /// @param first  extrema at rows before this one are told on the other way
  void tell_on(const std::vector<Passed>& way, std::size_t first) const {
    const Passed* begin = nullptr;
    for (const Passed& at : way) {
      const bool ends = begin != nullptr && at.before == 0 && at.after != 0;
      if (ends && begin->before * at.after < 0 && at.event->row >= first &&
          stands_still(begin->to, at.from)) {
        at.event->kind = EventKind::corner_limit_point;
        at.event->detail += ", the force turns back";
      }
      if (at.after != 0)
        begin = nullptr;
      else if (at.before != 0)
        begin = &at;
    }
  }

  const std::vector<Entry>& entries_;
  const Evaluator& evaluator_;
  Branch& branch_;
};

}  // namespace

void tell_level_extrema(const std::vector<Entry>& entries, const Evaluator& evaluator,
                        Branch& branch) {
  if (!evaluator.force_is_lambda()) LevelStretches(entries, evaluator, branch).tell();
}

}  // namespace springfold::analysis
