#include "transition_access.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "nothing.hpp"
#include "result_access.hpp"
#include "springfold/analysis/snap.hpp"

namespace springfold::io {
namespace {

using analysis::Barrier;
using analysis::StableState;
using analysis::StudyResult;
using analysis::Transition;
using analysis::TransitionReport;

/// 12 of "S12"; 0 for anything else.
int state_number(std::string_view text) {
  if (text.size() < 2 || text.size() > 7 || text[0] != 'S' || text[1] == '0') return 0;
  int number = 0;
  for (const char c : text.substr(1)) {
    if (c < '0' || c > '9') return 0;
    number = 10 * number + (c - '0');
  }
  return number;
}

/// Both numbers of "S1-S2".
std::optional<std::pair<int, int>> pair_of(std::string_view text) {
  const std::size_t dash = text.find('-');
  if (dash == std::string_view::npos) return std::nullopt;
  const int first = state_number(text.substr(0, dash)),
            second = state_number(text.substr(dash + 1));
  return first > 0 && second > 0 ? std::optional{std::pair{first, second}} : std::nullopt;
}

double count_if(const std::vector<StableState>& states, bool StableState::*flag) {
  return static_cast<double>(
      std::count_if(states.begin(), states.end(), [flag](const auto& s) { return s.*flag; }));
}

double whole_value(const TransitionReport& report, const std::string& quantity) {
  if (quantity == "states") return static_cast<double>(report.states.size());
  if (quantity == "transitions" || quantity == "alternatives")
    return static_cast<double>(std::count_if(
        report.transitions.begin(), report.transitions.end(),
        [&](const Transition& t) { return t.is_alternative == (quantity == "alternatives"); }));
  if (quantity == "reached") return count_if(report.states, &StableState::reached);
  if (quantity == "garden_of_eden") return count_if(report.states, &StableState::is_garden_of_eden);
  if (quantity == "memory") return static_cast<double>(report.memory);
  if (quantity == "complete") return report.is_closed ? 1 : 0;
  if (quantity == "barriers") return static_cast<double>(report.barriers.size());
  if (quantity == "lowest_barrier") {
    double lowest = nothing;
    for (const Barrier& b : report.barriers)
      lowest = std::fmin(lowest, std::fmin(b.from_first, b.from_second));
    return lowest;
  }
  return nothing;
}

double state_value(const StudyResult& result, const TransitionReport& report, int number,
                   const std::string& quantity) {
  if (number > std::ssize(report.states)) return nothing;
  const StableState& state = report.states[static_cast<std::size_t>(number - 1)];
  if (quantity == "low") return state.low;
  if (quantity == "high") return state.high;
  if (quantity == "reached") return state.reached ? 1 : 0;
  if (quantity == "garden_of_eden") return state.is_garden_of_eden ? 1 : 0;
  if (quantity == "escape") {
    double lowest = nothing;
    for (const Barrier& b : report.barriers) {
      if (b.first == number) lowest = std::fmin(lowest, b.from_first);
      if (b.second == number) lowest = std::fmin(lowest, b.from_second);
    }
    return lowest;
  }
  for (const Transition& t : report.transitions) {
    if (t.from != number || t.is_alternative) continue;
    const bool up = t.loading > 0;
    if (quantity == (up ? "up" : "down")) return t.to;
    if (quantity == (up ? "up_released" : "down_released")) return t.released;
  }
  return column_value(result, state.found, quantity);
}

/// Of a saddle between both.
double direct_barrier(const TransitionReport& report, int from, int to, const Barrier** highest) {
  for (const Barrier& b : report.barriers) {
    if (b.lambda != report.barriers.front().lambda) continue;
    const bool forward = b.first == from && b.second == to;
    if (!forward && !(b.first == to && b.second == from)) continue;
    *highest = &b;
    return forward ? b.from_first : b.from_second;
  }
  return nothing;
}

/// The lowest way over saddles from one state to another: its highest saddle above the first state.
double barrier_between(const TransitionReport& report, int from, int to, const Barrier** highest) {
  if (report.barriers.empty()) return nothing;
  const double lambda = report.barriers.front().lambda;
  if (report.energy_counts_turns) return direct_barrier(report, from, to, highest);
  std::vector<const Barrier*> list;
  for (const Barrier& b : report.barriers)
    if (b.lambda == lambda && b.second > 0) list.push_back(&b);
  std::stable_sort(list.begin(), list.end(), [](const Barrier* a, const Barrier* b) {
    return a->saddle.energy < b->saddle.energy;
  });
  std::vector<int> group(report.states.size() + 1);
  for (std::size_t i = 0; i < group.size(); ++i) group[i] = static_cast<int>(i);
  double energy = nothing;  // of the first state
  for (const Barrier* b : list) {
    if (b->first == from) energy = b->saddle.energy - b->from_first;
    if (b->second == from) energy = b->saddle.energy - b->from_second;
  }
  for (const Barrier* b : list) {
    const int old = group[static_cast<std::size_t>(b->second)];
    const int now = group[static_cast<std::size_t>(b->first)];
    std::replace(group.begin(), group.end(), old, now);
    if (group[static_cast<std::size_t>(from)] != group[static_cast<std::size_t>(to)]) continue;
    *highest = b;
    return b->saddle.energy - energy;
  }
  return nothing;
}

}  // namespace

bool is_transition_place(const std::string& at) {
  return at == "transitions" || state_number(at) > 0 || pair_of(at);
}

double transition_value(const ExpectedValue& expected, const StudyResult& result) {
  if (!result.snap || !result.snap->transitions) return nothing;
  const TransitionReport& report = *result.snap->transitions;
  if (expected.at == "transitions") return whole_value(report, expected.quantity);
  if (const int number = state_number(expected.at))
    return state_value(result, report, number, expected.quantity);
  const auto [from, to] = *pair_of(expected.at);
  if (std::max(from, to) > std::ssize(report.states)) return nothing;
  const Barrier* highest = nullptr;
  const double barrier = barrier_between(report, from, to, &highest);
  if (expected.quantity == "barrier" || highest == nullptr) return barrier;
  if (expected.quantity.starts_with(saddle_prefix))
    return column_value(result, highest->saddle, expected.quantity.substr(saddle_prefix.size()));
  return nothing;
}

}  // namespace springfold::io
