// What a transition graph says without any mechanics.
#include <algorithm>
#include <optional>

#include "transitions.hpp"

namespace springfold::analysis {
namespace {

/// The graph as a machine: one successor at each end of every state.
class Machine {
 public:
  explicit Machine(const TransitionReport& report) : report_{report} {
    up_.assign(report.states.size(), several);
    down_ = up_;
    std::vector<int> ups(report.states.size(), 0), downs = ups;
    for (const Transition& t : report.transitions) {
      if (t.is_alternative) continue;
      const auto from = static_cast<std::size_t>(t.from - 1);
      (t.loading > 0 ? up_ : down_)[from] = t.to - 1;
      ++(t.loading > 0 ? ups : downs)[from];
    }
    for (std::size_t s = 0; s < ups.size(); ++s) {
      if (ups[s] != 1) up_[s] = several;
      if (downs[s] != 1) down_[s] = several;
    }
  }

  /// The state behind the end of this one; negative: none that is known, or one of several.
  int next(int state, int direction) const {
    return (direction > 0 ? up_ : down_)[static_cast<std::size_t>(state)];
  }
  double end(int state, int direction) const {
    const StableState& s = report_.states[static_cast<std::size_t>(state)];
    return direction > 0 ? s.high : s.low;
  }
  bool is_limit(int state, int direction) const {
    const StableState& s = report_.states[static_cast<std::size_t>(state)];
    return direction > 0 ? s.high_is_limit : s.low_is_limit;
  }
  /// The state after lambda has gone to `target`.
  std::optional<int> go(int state, double target, int direction) const {
    for (std::size_t k = 0; k <= report_.states.size(); ++k) {
      const double reach = (end(state, direction) - target) * direction;
      if (reach > 0 || (reach == 0 && is_limit(state, direction))) return state;
      state = next(state, direction);
      if (state < 0) return std::nullopt;
    }
    return std::nullopt;
  }

 private:
  static constexpr int several = -2;
  const TransitionReport& report_;
  std::vector<int> up_{}, down_{};
};

/// Goes through loops within loops. Thresholds are compared exactly: each is the same number of its state.
class Loops {
 public:
  explicit Loops(const Machine& machine) : machine_{machine} {}

  /// From a state at the turning point `turn`: excursions in a direction up to `bound`, each back again.
  void explore(int state, double turn, double bound, int direction, int depth) {
    constexpr int most_loops = 100000;
    int s = state;
    while (loops < most_loops) {
      const double at = machine_.end(s, direction);
      if (machine_.is_limit(s, direction) || (at - bound) * direction >= 0) return;
      s = machine_.next(s, direction);
      if (s < 0) {
        undecided = true;
        return;
      }
      const auto back = machine_.go(s, turn, -direction);
      ++loops;
      if (!back)
        undecided = true;
      else if (*back != state)
        fails = true;
      if (depth > 1) explore(s, at, turn, -direction, depth - 1);
    }
  }

  int loops = 0;
  bool fails = false, undecided = false;

 private:
  const Machine& machine_;
};

void mark_reached(TransitionReport& report) {
  std::vector<int> open{1};
  if (!report.states.empty()) report.states.front().reached = true;
  while (!open.empty()) {
    const int from = open.back();
    open.pop_back();
    for (const Transition& t : report.transitions) {
      if (t.from != from || t.to == 0 || t.is_alternative) continue;
      StableState& to = report.states[static_cast<std::size_t>(t.to - 1)];
      if (!to.reached) open.push_back(t.to);
      to.reached = true;
    }
  }
}

}  // namespace

void judge_transitions(TransitionReport& report) {
  mark_reached(report);
  report.is_closed = true;
  for (const Transition& t : report.transitions) report.is_closed &= t.to > 0;
  for (std::size_t s = 0; s < report.states.size(); ++s)
    report.states[s].is_garden_of_eden = std::none_of(
        report.transitions.begin(), report.transitions.end(),
        [&](const Transition& t) { return !t.is_alternative && t.to == static_cast<int>(s) + 1; });
  if (report.states.empty()) return;
  const Machine machine(report);
  // Both ends of the range are turning points that nothing lies beyond: from each, loops nested three deep.
  constexpr int depth = 3;
  Loops loops(machine);
  for (const int direction : {1, -1}) {
    double far = machine.end(0, -direction);
    for (std::size_t s = 0; s < report.states.size(); ++s) {
      const double end = machine.end(static_cast<int>(s), -direction);
      if ((end - far) * direction < 0) far = end;
    }
    const auto saturated = machine.go(0, far, -direction);
    if (!saturated) {
      loops.undecided = true;
      continue;
    }
    // The first way out is no loop: every place on it is a turning point of its own.
    int s = *saturated;
    for (std::size_t k = 0; k < report.states.size() && !machine.is_limit(s, direction); ++k) {
      const double turn = machine.end(s, direction);
      s = machine.next(s, direction);
      if (s < 0) {
        loops.undecided = true;
        break;
      }
      loops.explore(s, turn, far, -direction, depth);
    }
  }
  report.loops = loops.loops;
  report.memory = loops.fails       ? TransitionReport::Memory::fails
                  : loops.undecided ? TransitionReport::Memory::undecided
                                    : TransitionReport::Memory::holds;
}

}  // namespace springfold::analysis
