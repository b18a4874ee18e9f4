// Energy barriers between stable states at one lambda. Private to analysis.
#pragma once

#include "stretches.hpp"

namespace springfold::analysis {

/// Why a search left something out.
struct SearchEnd {
  bool is_full = false;      ///< it found `most_states`
  bool left_bounds = false;  ///< states lie beyond `lengths_away` or `turns_away`
};

/// Ten bistable units have 1,024 minima and 5,120 saddles between neighbours; more is a continuum of states.
inline constexpr int most_states = 20'000;

/// All states of rest of one lambda that can be found: uphill from all minima, from random states, and along strings
/// between minima that nothing else joins. What was searched around before is not searched around again.
/// @param is_within  the study's range, beyond which nothing is searched around
SearchEnd search_all(StateBook& book, const SnapSettings& settings,
                     const std::function<bool(const RestState&)>& is_within);

/// All saddles of a search with one unstable mode, with the stretches whose states are beside them; for each pair of
/// states the lowest one, and the lowest way over several of them. Doubts go to the result.
/// @param frozen  of the lambda at which the book's states are
/// @param book    after a search around all minima that are known there
void find_barriers(const Stretches& stretches, const Tracing& tracing, const Scales& scales,
                   const Frozen& frozen, StateBook& book, StudyResult& result,
                   TransitionReport& found);

/// Fills what follows from the saddles between pairs of states: the lowest ways and the escapes.
/// @param from  the first of the barriers that belong to one lambda; all behind it do too
void find_lowest_ways(TransitionReport& report, std::size_t from);

}  // namespace springfold::analysis
