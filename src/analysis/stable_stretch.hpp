// One stable stretch of a branch, traced both ways until stability ends. Private to analysis.
#pragma once

#include "grow_diagram.hpp"

namespace springfold::analysis {

struct StableStretch {
  BranchRows rows{};
  /// Stability, the growth of lambda or the curve itself ends there, and not the study's range.
  bool ends_low = false, ends_high = false;
};

/// No unstable mode; where springs rest at their thresholds, in no piece beside the state.
bool is_stable(const Tracing& tracing, const continuation::CurvePoint& point);

/// Traces from a stable state. Beyond each end there is one row more.
/// @returns nothing where not one curve leads through the state
std::optional<StableStretch> trace_stable(const Tracing& tracing,
                                          const continuation::DiagramStart& from);

}  // namespace springfold::analysis
