// A study's bifurcation diagram as a result. Private to analysis.
#pragma once

#include "grow_diagram.hpp"

namespace springfold::analysis {

/// Traces the branches of the start and of all special points to the study's depth, searches where
/// the study says so, and writes branches, junctions, searches, doubts and the start's ways.
void trace_branches(const Tracing& tracing, const continuation::CurvePoint& start,
                    StudyResult& result);

}  // namespace springfold::analysis
