// Curves that become much steeper than they are at their start: when the unit of lambda has to follow. Private to
// analysis.
#pragma once

#include "path_problem.hpp"
#include "springfold/continuation/curve.hpp"

namespace springfold::analysis {

/// Watches a curve while it is traced. The arc length measures lambda in a unit from the response at the start
/// (settle_units); where a curve then hardens by orders of magnitude (a cable that becomes taut, a truss of slack members)
/// lambda alone fills the arc length, and the curve would take a point for every tenth of a unit. A larger unit changes
/// nothing where x responds: lengths are measured by x there. So the curve is begun again with one.
/// Not without bounds: a curve may run to infinity, and where x responds the rate of lambda must stay clear of rounding.
inline constexpr double largest_change_of_lambda_unit = 0x1p32;

class LambdaCrawl {
 public:
  /// @param largest  factor that is still allowed
  /// @param range    of lambda that is asked for, in its unit; infinity: none
  LambdaCrawl(const PathProblem& problem, double largest, double range)
      : weights_{problem.metric()}, largest_{largest}, range_{range} {}

  /// @param tangent  at the start: a curve that is as steep there as later (a trivial branch) is left alone
  void begin(const continuation::Direction& tangent);

  /// @returns whether a larger unit of lambda is needed; `factor` says which
  bool sees(const continuation::CurvePoint& point);

  /// How many times larger the unit of lambda should be, a power of two; 1: the unit serves.
  double factor() const { return factor_; }

 private:
  void count_from(const continuation::CurvePoint& point);

  Vector weights_{};
  double largest_ = 1, range_;
  double slope_at_start_ = 0;  ///< |dx| over |dlambda|
  bool counting_ = false;
  continuation::CurvePoint last_{};
  double by_x_ = 0, by_lambda_ = 0;  ///< lengths since counting began
  double factor_ = 1;
};

}  // namespace springfold::analysis
