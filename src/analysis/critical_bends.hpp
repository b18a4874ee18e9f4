// Critical curves where numbers of the case bend with the parameter, and nothing switches: their slope jumps there.
// Private to analysis.
#pragma once

#include <optional>

#include "case_curves.hpp"

namespace springfold::analysis {

/// Where the slope of a curve jumps near its end: there lines through its points before and behind meet, and their
/// slopes go on to differ where these are taken nearer. The parameter's value, in units of the family; nothing where it
/// does not.
std::optional<double> bend_near_end(const CaseCurves& curves,
                                    const continuation::CriticalStart& start,
                                    const continuation::CriticalCurve& curve);

}  // namespace springfold::analysis
