// Turns of lambda on steps at whose ends its rate cannot be told from rounding. Private to the engine.
#pragma once

#include <optional>
#include <vector>

#include "continuation/locating/zeros.hpp"
#include "continuation/points/step.hpp"

namespace springfold::continuation {

/// Rates of lambda this many times their rounding have a sign beyond doubt.
inline constexpr double clear_of_rounding = 100;

/// A regular step of the curve, as long as need be, on which lambda's rate rises clear of its rounding on
/// both sides of a shorter one: it is given by the curve, not by the length of the shorter step.
struct WideStep {
  CurvePoint from{}, to{};
};

/// @param noise  rounding of lambda's rate
/// @returns nothing where lambda stands still for longer than a regular step can be, or the evidence for a step
/// is missing
std::optional<WideStep> widened(const Walker& walker, const CurvePoint& from, const CurvePoint& to,
                                double noise);

/// Zeros of lambda's rate on the widened step, those of them that lie between `from` and `high` beyond
/// it; places as distances from `from` along its tangent.
/// @returns nothing where there is no such step or its zeros are too close together
std::optional<std::vector<ZeroOf>> turns_on_widened(const Walker& walker, const CurvePoint& from,
                                                    const CurvePoint& to, double high,
                                                    double noise);

}  // namespace springfold::continuation
