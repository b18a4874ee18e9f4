// How steeply a path climbs. Private to analysis.
#pragma once

#include "special_rates.hpp"

namespace springfold::analysis {

/// Slopes of all designs are told in the units of the case, so that they can be compared: curves have units that suit
/// the response at their own start.
struct SlopeUnits {
  double lambda = 1, force = 1;  ///< physical
};

/// What climbs: lambda, or on paths that lambda drives, under dead load, the force.
enum class Climb { lambda, force };
/// Of which of both limit points are asked for.
Climb climb_of(const Member& member, const CriticalPointSettings& settings);

/// The limit that ends a path.
struct EndLimit {
  std::string quantity{};
  double Limit::*side = &Limit::high;
};

/// Where the slope of a path is least.
struct LeastSlope {
  double value = 0;  ///< in `units`
  SlopeUnits units{};
  Climb climb = Climb::lambda;
  continuation::CurvePoint point{};  ///< on its piece, with its tangent
  std::optional<SpecialPoint>
      switching{};  ///< at a switching spring: there; `behind`: on the leaving side
  bool behind = false;
  bool at_start = false;          ///< at the start of the path, an edge: it moves as that does
  std::optional<EndLimit> end{};  ///< at the path's end, another edge: on this limit
};

/// d(lambda)/ds or d(force)/ds of the path through a point along `reference`.
std::optional<double> slope_at(const Member& member, const continuation::CurvePoint& point,
                               const continuation::Direction& reference, const SlopeUnits& units,
                               Climb climb);

/// The least one on the traced path before `quantity` passes `end`. Towards growing lambda a path leaves an unstable
/// start the other way than a stable one: if it turns back, its slope is told in the sense of the latter, and grows
/// through zero where the start becomes stable.
std::optional<LeastSlope> least_slope(const Member& member, const BasePath& path,
                                      const std::string& quantity, double end,
                                      const SlopeUnits& units, Climb climb);

/// How it moves with the parameter of `curves`.
std::optional<double> rate_of(const CaseCurves& curves, const Member& base,
                              const LeastSlope& least);

}  // namespace springfold::analysis
