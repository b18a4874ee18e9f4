// Curves that become much steeper than they are at their start: when the unit of lambda has to follow. Private to
// analysis.
#pragma once

#include "path_problem.hpp"
#include "springfold/continuation/curve.hpp"

namespace springfold::analysis {

/// Watches a curve while it is traced. The arc length measures lambda in a unit from the response at the start
/// (settle_units); where a curve then hardens by orders of magnitude (a cable that becomes taut, a truss of slack
/// members) lambda alone fills the arc length, and the curve would take a point for every tenth of a unit. A larger
/// unit changes nothing where x responds: lengths are measured by x there. So the curve is begun again with one. Not
/// without bounds: where x responds the rate of lambda must stay clear of rounding. And a curve may run to infinite
/// lambda while x comes to rest (a chain that is pulled straight): no unit is large enough for that.
inline constexpr double largest_change_of_lambda_unit = 0x1p32;

enum class Crawl {
  none,
  unit_too_small,  ///< begin again with a larger unit of lambda
  without_bound,   ///< lambda runs to infinity while x comes to rest: the curve ends here
};

/// What is said of a curve that ends so.
inline constexpr const char* grows_without_bound =
    "lambda grows without bound while hardly anything moves: a limit of lambda in until says how "
    "far it is to be followed";

/// Did its observer end the curve, for whatever reason?
inline bool was_ended(const continuation::Curve& curve) {
  return curve.stop == continuation::StopReason::observer ||
         curve.stop == continuation::StopReason::unbounded ||
         curve.stop == continuation::StopReason::pole;
}

/// At this point, which it saw?
inline bool was_ended_at(const continuation::Curve& curve, const continuation::CurvePoint& seen) {
  return curve.stop == continuation::StopReason::observer &&
         seen.lambda == curve.points.back().lambda && seen.x == curve.points.back().x;
}

/// The observer of this curve ended it there.
inline void end_without_bound(continuation::Curve& curve) {
  curve.stop = continuation::StopReason::unbounded;
  curve.stop_detail = grows_without_bound;
}

class LambdaCrawl {
 public:
  /// @param largest  factor that is still allowed
  /// @param range    of lambda that is asked for, in its unit; infinity: none
  LambdaCrawl(const PathProblem& problem, double largest, double range)
      : weights_{problem.metric()}, largest_{largest}, range_{range} {}

  /// @param tangent  at the start: a curve that is as steep there as later (a trivial branch) is left alone
  void begin(const continuation::Direction& tangent);

  /// Where a larger unit of lambda is needed, `factor` says which.
  Crawl sees(const continuation::CurvePoint& point);

  /// Has lambda alone filled a long way, and the curve not become steeper? Its unit came from the first critical load
  /// then.
  bool goes_straight() const { return goes_straight_; }

  /// How many times larger the unit of lambda should be, a power of two; 1: the unit serves.
  double factor() const { return factor_; }

 private:
  void count_from(const continuation::CurvePoint& point);
  double slope_of(const continuation::CurvePoint& point) const;
  bool runs_to_infinity(const continuation::CurvePoint& point) const;

  Vector weights_{};
  double largest_ = 1, range_;
  double slope_at_start_ = 0;  ///< |dx| over |dlambda|
  bool goes_straight_ = false;
  bool counting_ = false;
  continuation::CurvePoint last_{};
  double by_x_ = 0, by_lambda_ = 0;  ///< lengths since counting began
  double quarter_ = 0,
         slope_at_quarter_ = 0;  ///< length by lambda, and slope, a quarter of the long way on
  double factor_ = 1;
};

}  // namespace springfold::analysis
