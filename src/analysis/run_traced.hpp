// A study from its start, with another way to trace it. Private to analysis.
#pragma once

#include "grow_diagram.hpp"
#include "scales.hpp"

namespace springfold::analysis {

/// Traces from the start point and writes branches and junctions.
using TraceBy = std::function<void(const Tracing&, const Scales&,
                                   const continuation::CurvePoint& start, StudyResult& result)>;

/// What a case file is told with its places, a caller of the library is told here.
/// @throws std::invalid_argument with all that is wrong with the mechanism, or with the study
void require_usable(const model::Mechanism& mechanism, const Study& study);

/// As run_study, for studies that have a start point.
/// @param trace_by  in place of the study's own way to trace; empty: that
StudyResult run_from_start(const model::Mechanism& mechanism, const Study& study,
                           const ParameterFamily* family, const Observer& observer,
                           const TraceBy& trace_by);

/// Where no curve leaves the start: a branch of this one point that says why.
void add_branch_of_start(const Tracing& tracing, const continuation::CurvePoint& start,
                         StudyResult& result);

}  // namespace springfold::analysis
