#include "springfold/continuation/locate.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>

namespace springfold::continuation {

std::optional<CurvePoint> point_at(const Walker& walker, const CurvePoint& from, double ds) {
  StepResult result =
      point_on_curve(walker, from.x + ds * from.tangent.dx, from.lambda + ds * from.tangent.dlambda,
                     from.piece, from.tangent);
  if (!result.point) return std::nullopt;
  result.point->s = from.s + ds;
  return std::move(result.point);
}

std::optional<Located> locate(const Walker& walker, const CurvePoint& from, double a, double b,
                              const std::function<double(const CurvePoint&)>& value) {
  bool failed = false;
  const auto f = [&](double ds) -> double {
    const auto point = point_at(walker, from, ds);
    const double v = point ? value(*point) : std::numeric_limits<double>::quiet_NaN();
    failed = failed || !std::isfinite(v);
    return failed ? 0.0 : v;
  };
  const double fa = f(a), fb = f(b);
  if (failed || (fa > 0 && fb > 0) || (fa < 0 && fb < 0)) return std::nullopt;
  double low = a, high = b;
  if (fa == 0 || fb == 0) {
    low = high = fa == 0 ? a : b;
  } else {
    const double tolerance = walker.options.location_tolerance * std::abs(b - a);
    const auto close = [tolerance](double l, double h) { return std::abs(h - l) <= tolerance; };
    std::uintmax_t most = 100;
    std::tie(low, high) = boost::math::tools::toms748_solve(f, a, b, fa, fb, close, most);
  }
  if (failed) return std::nullopt;
  auto point = point_at(walker, from, 0.5 * (low + high));
  if (!point) return std::nullopt;
  return Located{std::move(*point), std::min(low, high), std::max(low, high)};
}

}  // namespace springfold::continuation
