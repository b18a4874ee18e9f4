#include "lambda_crawl.hpp"

#include <algorithm>
#include <cmath>

#include "settle_units.hpp"
#include "springfold/continuation/response.hpp"
#include "springfold/core/scaling.hpp"

namespace springfold::analysis {
namespace {

/// Lambda crawls where x moves by less than this share of it.
constexpr double barely_moves = 1.0 / 8;

/// A curve has become steeper by orders of magnitude.
constexpr double much_steeper = 16;

/// Over so many units of arc length, 160 of the longest default steps, before the unit is taken to be too small.
constexpr double long_way = 16;

/// Where x hardly moves up to the first critical load the unit comes from that, and everything else may be orders of
/// magnitude away: on a trivial branch, and where the curve begins just beside a critical point. After a long way the
/// unit grows by this factor, no farther than a finite range asks for.
constexpr double next_unit = 16;

/// Along a curve that runs to infinite lambda at a finite x, as c / (x_0 - x)^p does, |dlambda/dx| grows like lambda to
/// the power (p + 1) / p; along an exponential like lambda, along powers of x more slowly, and it stays where a member
/// is merely stiff. Between p = 4 and the exponential nothing is claimed.
constexpr double power_at_infinity = 1.25;

/// Of the unit of lambda, along such a curve: forces have then grown by some thousands, and nothing more happens.
constexpr double enough_at_infinity = 0x1p8;

double length_in(const Vector& weights, const Vector& dx) {
  return std::sqrt(dx.cwiseAbs2().dot(weights));
}

}  // namespace

void LambdaCrawl::begin(const continuation::Direction& tangent) {
  constexpr double rounding = 1e-12;
  const double slope = length_in(weights_, tangent.dx) / std::abs(tangent.dlambda);
  slope_at_start_ = slope > rounding ? slope : 0;
  counting_ = false;
}

void LambdaCrawl::count_from(const continuation::CurvePoint& point) {
  counting_ = true;
  last_ = point;
  by_x_ = by_lambda_ = quarter_ = 0;
}

double LambdaCrawl::slope_of(const continuation::CurvePoint& point) const {
  return std::abs(point.tangent.dlambda) / length_in(weights_, point.tangent.dx);
}

bool LambdaCrawl::runs_to_infinity(const continuation::CurvePoint& point) const {
  return quarter_ > 0 && std::log(slope_of(point) / slope_at_quarter_) >
                             power_at_infinity * std::log(by_lambda_ / quarter_);
}

Crawl LambdaCrawl::sees(const continuation::CurvePoint& point) {
  if (factor_ > 1) return Crawl::unit_too_small;
  if (!counting_ || !(point.s > last_.s)) {
    count_from(point);
    return Crawl::none;
  }
  const double dx = length_in(weights_, point.x - last_.x),
               dlambda = std::abs(point.lambda - last_.lambda);
  const bool trivial = !(slope_at_start_ > 0);
  if (!(dx < barely_moves * dlambda) || (!trivial && !(dx > 0))) {
    count_from(point);
    return Crawl::none;
  }
  by_x_ += dx;
  by_lambda_ += dlambda;
  last_ = point;
  if (!(quarter_ > 0) && by_lambda_ >= long_way / 4) {
    quarter_ = by_lambda_;
    slope_at_quarter_ = slope_of(point);
  }
  if (!trivial && by_lambda_ >= long_way && !std::isfinite(range_) && runs_to_infinity(point)) {
    if (largest_change_of_lambda_unit / largest_ >= enough_at_infinity) return Crawl::without_bound;
    factor_ = std::min(largest_, next_unit);
    return Crawl::unit_too_small;
  }
  const double by_response =
      trivial ? 1 : power_of_two_near(continuation::slopes_in_a_unit * by_lambda_ / by_x_);
  if (!trivial && by_lambda_ >= long_way && by_x_ <= slope_at_start_ / much_steeper * by_lambda_)
    factor_ = std::min(largest_, by_response);
  else if (by_lambda_ >= longest_straight_way) {
    goes_straight_ = true;
    factor_ = std::max(
        1.0, std::min({largest_, next_unit,
                       std::isfinite(range_) ? power_of_two_near(range_ / longest_straight_way)
                                             : by_response}));
  }
  return factor_ > 1 ? Crawl::unit_too_small : Crawl::none;
}

}  // namespace springfold::analysis
