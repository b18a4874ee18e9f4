// Energy barriers between stable states at one lambda. Private to analysis.
#pragma once

#include "stretches.hpp"

namespace springfold::analysis {

/// All states of rest of one lambda that can be found: uphill from all minima, from random states, and along strings
/// between minima that nothing else joins.
void search_all(StateBook& book, const SnapSettings& settings);

/// All saddles with one unstable mode that a search finds at a dimensionless lambda, with the stretches whose states
/// are beside them; for each pair of states the lowest one, and the lowest way over several of them. Doubts go to the
/// result.
/// @param stretches  with all minima that are known at this lambda
void find_barriers(const Stretches& stretches, const Tracing& tracing, const Scales& scales,
                   const SnapSettings& settings, double lambda, StudyResult& result,
                   TransitionReport& found);

/// Fills what follows from the saddles between pairs of states: the lowest ways and the escapes.
/// @param from  the first of the barriers that belong to one lambda; all behind it do too
void find_lowest_ways(TransitionReport& report, std::size_t from);

}  // namespace springfold::analysis
