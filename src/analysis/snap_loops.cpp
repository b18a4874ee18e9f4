// Stable parts of branches, followed from a landing to the next loss of stability.
#include <algorithm>
#include <cmath>
#include <set>

#include "frozen.hpp"
#include "snap_jumps.hpp"
#include "stable_walk.hpp"

namespace springfold::analysis {
namespace {

using Kind = QuantityDefinition::Kind;

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

bool leads_to(const std::vector<const Event*>& ends, const std::string& label) {
  return std::any_of(ends.begin(), ends.end(),
                     [&](const Event* end) { return end->label == label; });
}

}  // namespace

void close_loops(const std::vector<QuantityDefinition>& quantities, const StudyResult& result,
                 SnapReport& report) {
  const StableWalk walk(quantities, result);
  // Several jumps may leave one point, to sides that mirror each other: that which closes the loop counts.
  for (Jump& jump : report.jumps) {
    const auto back = walk.ends_of(jump.landing.branch, jump.landing.row, -jump.loading);
    for (std::size_t i = 0; i < report.jumps.size() && std::isnan(jump.loop); ++i) {
      const Jump& other = report.jumps[i];
      if (other.loading != -jump.loading || !leads_to(back, other.from)) continue;
      const bool closes =
          leads_to(walk.ends_of(other.landing.branch, other.landing.row, jump.loading), jump.from);
      if (jump.back == 0 || closes) jump.back = static_cast<int>(i) + 1;
      if (closes) jump.loop = jump.released + other.released;
    }
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
