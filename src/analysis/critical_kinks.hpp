// Critical curves across values of the parameter at which a spring switches at the start of the path itself. Private to
// analysis.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "case_curves.hpp"

namespace springfold::analysis {

/// Where between two values do starts change their piece? The place, and which switch it is.
std::optional<std::pair<double, std::string>> switching_start(const CaseCurves& curves, double mu,
                                                              double beyond);

/// follow_critical(). Where what a start fixes (commands, held forces) bends with the parameter since a spring switches
/// at the start, the curve has a kink there: it is followed up to it, and on from it, as one curve.
continuation::CriticalCurve follow_over_kinks(
    const CaseCurves& curves, const continuation::CriticalStart& start, bool growing,
    const std::vector<continuation::CriticalEvent>& events,
    const continuation::TraceOptions& options,
    const std::function<bool(const continuation::CriticalPoint&)>& observer,
    const continuation::FurtherPoints& further = {});

}  // namespace springfold::analysis
