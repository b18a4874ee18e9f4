// How functions of special points move with a parameter. Private to analysis.
#pragma once

#include "base_path.hpp"

namespace springfold::analysis {

/// Some numbers of a state of a member's curve; nothing where they are not defined.
using StateValues = std::function<std::optional<Vector>(const Member& member,
                                                        const continuation::CurvePoint& point)>;

/// Total derivatives of `values` at a point of a followed kind by the parameter of `curves`; nothing where it is
/// degenerate.
std::optional<Vector> rates_at_followed(const CaseCurves& curves, const Member& base,
                                        const continuation::CriticalStart& start,
                                        const StateValues& values);

/// Total derivatives of `values` at a special point by the parameter of `curves`, the point being kept special; nothing
/// where it is degenerate or of a kind that is not followed.
/// @param why_none  set: why it is not followed; empty where it is
std::optional<Vector> rates_at_special(const CaseCurves& curves, const Member& base,
                                       const SpecialPoint& point, const StateValues& values,
                                       std::string* why_none = nullptr);

/// The same at the start.
std::optional<Vector> rates_at_start(const CaseCurves& curves, const StateValues& values);

/// Values of columns, by their numbers in Member::quantities.
StateValues column_values(std::vector<std::size_t> columns);

}  // namespace springfold::analysis
