// A study's bifurcation diagram as a result. Private to analysis.
#pragma once

#include "grow_diagram.hpp"

namespace springfold::analysis {

/// Traces the branches of the start and of all special points to the study's depth, searches where
/// the study says so, and writes branches, junctions, searches, doubts and the start's ways.
/// @param landings  further starts, where jumps ended: numbers 1, 2, ... of `Branch::start`, before those of
/// the searches
void trace_branches(const Tracing& tracing, const continuation::CurvePoint& start,
                    StudyResult& result,
                    const std::vector<continuation::DiagramStart>& landings = {});

}  // namespace springfold::analysis
