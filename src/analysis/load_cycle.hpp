// Load cycles over traced branches and their jumps. Private to analysis.
#pragma once

#include "grow_diagram.hpp"
#include "scales.hpp"
#include "springfold/analysis/snap.hpp"

namespace springfold::analysis {

/// @param report  with the jumps of all branches of `result`
LoadCycle run_cycle(const Tracing& tracing, const Scales& scales, const CycleSettings& settings,
                    const StudyResult& result, const SnapReport& report);

}  // namespace springfold::analysis
