// All stable states that jumps and searches lead to, and the transitions between them. Private to analysis.
#pragma once

#include "grow_diagram.hpp"
#include "scales.hpp"
#include "springfold/analysis/snap.hpp"

namespace springfold::analysis {

/// Follows the start's stable stretch and those that searches find until stability ends, jumps, follows the
/// stretches on which jumps end, and so on, until none is new. Writes branches, jumps and transitions.
void find_transitions(const Tracing& tracing, const Scales& scales,
                      const continuation::CurvePoint& start, const SnapSettings& settings,
                      StudyResult& result, SnapReport& report);

/// Fills what follows from states and transitions: reached, Garden of Eden, return-point memory.
void judge_transitions(TransitionReport& report);

}  // namespace springfold::analysis
