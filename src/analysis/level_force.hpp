// Stretches of a branch along which the force stands still. Private to analysis.
#pragma once

#include <vector>

#include "branch_entries.hpp"

namespace springfold::analysis {

/// Where the force rises to a stretch along which it stands still, and falls behind it, or the other way round, all of
/// the stretch is its extremum. It is told where limit points of the load are told behind a family: at the switching
/// with which the stretch ends, as seen from the start, which becomes a corner limit point.
/// @param branch  with the rows of the entries, its start_row and its events
void tell_level_extrema(const std::vector<Entry>& entries, const Evaluator& evaluator,
                        Branch& branch);

}  // namespace springfold::analysis
