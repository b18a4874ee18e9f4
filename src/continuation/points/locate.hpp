// Special points between two points of a curve, found by re-solving on the curve, never by
// interpolation. Private to the engine.
#pragma once

#include <functional>
#include <optional>

#include "continuation/points/arc.hpp"

namespace springfold::continuation {

/// A point of the curve at distance ds from `from` along its tangent, without judging the step.
std::optional<CurvePoint> point_at(const Walker& walker, const CurvePoint& from, double ds);

/// A point of the curve near the model's point at the way t from its origin. Beside a branch point the corrector stays
/// on the curve so. @returns nothing also where the tangent found is not that of the model: another branch's
std::optional<CurvePoint> point_near(const Walker& walker, const ArcModel& model,
                                     const CurvePoint& origin, double t);

/// A zero of `value` on the curve between step lengths a and b from `from`.
struct Located {
  CurvePoint point{};
  double before = 0, after = 0;  ///< step lengths of the final bracket
};

/// Bracketed root finding (TOMS 748) over the step length; every trial is a corrected point.
/// @param point_at   the point at a step length, if it can be corrected
/// @param tolerance  of the step length
/// @returns nothing where the value has no opposite signs at a and b, or a trial point cannot be corrected
std::optional<Located> locate(const std::function<std::optional<CurvePoint>(double)>& point_at,
                              double a, double b, double tolerance,
                              const std::function<double(const CurvePoint&)>& value);

/// The same of the points that point_at() finds.
std::optional<Located> locate(const Walker& walker, const CurvePoint& from, double a, double b,
                              const std::function<double(const CurvePoint&)>& value);

}  // namespace springfold::continuation
