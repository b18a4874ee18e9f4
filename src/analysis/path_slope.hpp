// How steeply a path climbs. Private to analysis.
#pragma once

#include "special_rates.hpp"

namespace springfold::analysis {

/// Where the slope of a path is least.
struct LeastSlope {
  double value = 0;                  ///< dimensionless
  continuation::CurvePoint point{};  ///< on its piece, with its tangent
  std::optional<SpecialPoint>
      switching{};  ///< at a switching spring: there; `behind`: on the leaving side
  bool behind = false;
};

/// d(lambda)/ds of the path through a point along `reference`, under control of poses d(force)/ds; dimensionless.
std::optional<double> slope_at(const Member& member, const continuation::CurvePoint& point,
                               const continuation::Direction& reference);

/// The least one on the traced path before `quantity` passes `end`.
std::optional<LeastSlope> least_slope(const Member& member, const BasePath& path,
                                      const std::string& quantity, double end);

/// How it moves with the parameter of `curves`.
std::optional<double> rate_of(const CaseCurves& curves, const Member& base,
                              const LeastSlope& least);

}  // namespace springfold::analysis
