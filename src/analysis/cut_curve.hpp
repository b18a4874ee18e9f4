// Critical curves that end where the path no longer comes to their point. Private to analysis.
#pragma once

#include <optional>
#include <string>

#include "case_curves.hpp"

namespace springfold::analysis {

/// The critical point at this value of the parameter, between two points of its curve.
/// @param room  the last point serves this far beyond the curve, too [mu]
std::optional<continuation::CriticalPoint> point_of_curve(const CaseCurves& curves,
                                                          const continuation::CriticalStart& of,
                                                          const continuation::CriticalCurve& curve,
                                                          double mu, double room);

/// The curve ends at this point of it. @param why  in words
void end_curve_at(const continuation::CriticalPoint& last, const std::string& why,
                  continuation::CriticalCurve& curve);

/// The event of a jump in the last or the first row; there is one already where something else is located.
void mark_jump(Branch& branch, bool last, const std::string& text);

}  // namespace springfold::analysis
