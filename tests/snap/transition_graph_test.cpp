// What a graph of stable states says without any mechanics.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "analysis/transitions.hpp"

namespace springfold::analysis {
namespace {

/// Independent switches under one load, each with its own two thresholds: the model of Preisach. State s has bit
/// i set where switch i is up.
TransitionReport preisach(const std::vector<double>& up, const std::vector<double>& down,
                          double range) {
  TransitionReport report;
  const auto n = up.size();
  for (std::size_t s = 0; s < (std::size_t{1} << n); ++s) {
    StableState state{.low = -range, .high = range, .low_is_limit = true, .high_is_limit = true};
    std::size_t next_up = s, next_down = s;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t bit = std::size_t{1} << i;
      if ((s & bit) == 0 && up[i] < state.high) {
        state.high = up[i];
        state.high_is_limit = false;
        next_up = s | bit;
      }
      if ((s & bit) != 0 && down[i] > state.low) {
        state.low = down[i];
        state.low_is_limit = false;
        next_down = s & ~bit;
      }
    }
    const auto from = static_cast<int>(s) + 1;
    if (!state.high_is_limit)
      report.transitions.push_back(
          {.from = from, .to = static_cast<int>(next_up) + 1, .loading = 1, .lambda = state.high});
    if (!state.low_is_limit)
      report.transitions.push_back({.from = from,
                                    .to = static_cast<int>(next_down) + 1,
                                    .loading = -1,
                                    .lambda = state.low});
    report.states.push_back(std::move(state));
  }
  judge_transitions(report);
  return report;
}

TEST(TransitionGraph, OfIndependentSwitchesRemembersItsTurningPoints) {
  const auto report = preisach({1, 2, 3, 4}, {-1, -4, -2, -3}, 10);
  EXPECT_EQ(report.memory, TransitionReport::Memory::holds);
  EXPECT_GT(report.loops, 10);
  EXPECT_TRUE(report.is_closed);
}

/// The weaker of two switches cannot be up alone behind the stronger one: which goes up first comes back first or last.
TEST(TransitionGraph, NamesStatesToWhichNothingLeads) {
  // Both ways the first switch goes before the second: up alone is reached, the second one up alone too.
  const auto alike = preisach({1, 2}, {-1, -2}, 10);
  EXPECT_TRUE(std::none_of(alike.states.begin(), alike.states.end(),
                           [](const StableState& s) { return s.is_garden_of_eden; }));
  // The first one goes up first and comes back last: the second one is never up alone.
  const auto nested = preisach({1, 2}, {-2, -1}, 10);
  EXPECT_TRUE(nested.states[2].is_garden_of_eden);
  EXPECT_FALSE(nested.states[2].reached);
  EXPECT_EQ(std::count_if(nested.states.begin(), nested.states.end(),
                          [](const StableState& s) { return s.is_garden_of_eden; }),
            1);
}

/// After an excursion a loop ends elsewhere: a graph that no switches have.
TEST(TransitionGraph, SaysWhereALoopDoesNotComeBack) {
  TransitionReport report;
  report.states = {{.low = -5, .high = 1, .low_is_limit = true},
                   {.low = -1, .high = 5, .high_is_limit = true},
                   {.low = -3, .high = 0.5},
                   {.low = -4, .high = 5, .high_is_limit = true}};
  report.transitions = {{.from = 1, .to = 2, .loading = 1, .lambda = 1},
                        {.from = 2, .to = 3, .loading = -1, .lambda = -1},
                        {.from = 3, .to = 4, .loading = 1, .lambda = 0.5},
                        {.from = 3, .to = 1, .loading = -1, .lambda = -3},
                        {.from = 4, .to = 1, .loading = -1, .lambda = -4}};
  judge_transitions(report);
  EXPECT_EQ(report.memory, TransitionReport::Memory::fails);
}

TEST(TransitionGraph, IsOpenWhereATransitionLeadsNowhereKnown) {
  TransitionReport report;
  report.states = {{.low = -5, .high = 1, .low_is_limit = true}};
  report.transitions = {{.from = 1, .to = 0, .loading = 1, .lambda = 1}};
  judge_transitions(report);
  EXPECT_FALSE(report.is_closed);
  EXPECT_EQ(report.memory, TransitionReport::Memory::undecided);
}

}  // namespace
}  // namespace springfold::analysis
