// Special points between two points of a curve, found by re-solving on the curve, never by
// interpolation. Private to the engine.
#pragma once

#include <functional>
#include <numbers>
#include <optional>

#include "continuation/points/arc.hpp"

namespace springfold::continuation {

/// Cosine of the angle between a point's tangent and the expected one up to which the point is on its own branch.
inline constexpr double half_a_right_angle = 0.5 * std::numbers::sqrt2;

/// A point of the curve at distance ds from `from` along its tangent, without judging the step.
std::optional<CurvePoint> point_at(const Walker& walker, const CurvePoint& from, double ds);

/// A point of the curve near the model's point at the way t from its origin. Beside a branch point the corrector stays on
/// the curve so. @returns nothing also where the tangent found is not that of the model: another branch's
std::optional<CurvePoint> point_near(const Walker& walker, const ArcModel& model,
                                     const CurvePoint& origin, double t);

/// The same on a step whose end is known: predicted by the cubic through both ends and their tangents.
std::optional<CurvePoint> point_between(const Walker& walker, const CurvePoint& from,
                                        const CurvePoint& to, double ds);

/// A zero of `value` on the curve between step lengths a and b from `from`.
struct Located {
  CurvePoint point{};
  double before = 0, after = 0;  ///< step lengths of the final bracket
};

/// Bracketed root finding (TOMS 748) over the step length; every trial is a corrected point.
/// @pre value has opposite signs at the points of step length a and b
/// @returns nothing when a trial point cannot be corrected
std::optional<Located> locate(const Walker& walker, const CurvePoint& from, double a, double b,
                              const std::function<double(const CurvePoint&)>& value);

}  // namespace springfold::continuation
