#include "continuation/points/locate.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <numbers>

#include "continuation/points/workspace.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {

bool find_point_at(const Walker& walker, const CurvePoint& from, double ds, CurvePoint& point) {
  point.x = from.x + ds * from.tangent.dx;
  point.lambda = from.lambda + ds * from.tangent.dlambda;
  point.s = from.s + ds;
  return find_point(walker, from.piece, from.tangent, point);
}

std::optional<CurvePoint> point_at(const Walker& walker, const CurvePoint& from, double ds) {
  std::optional<CurvePoint> point(std::in_place);
  if (!find_point_at(walker, from, ds, *point)) point.reset();
  return point;
}

std::optional<CurvePoint> point_near(const Walker& walker, const ArcModel& model,
                                     const CurvePoint& origin, double t) {
  std::optional<CurvePoint> point(std::in_place);
  constexpr double half_a_right_angle = 0.5 * std::numbers::sqrt2;  // its cosine
  model.point(walker.weights, origin, t, *point);
  const Direction expected = point->tangent;
  if (!find_point(walker, origin.piece, origin.tangent, *point) ||
      metric_product(walker.weights, point->tangent, expected) < half_a_right_angle)
    point.reset();
  return point;
}

std::optional<Located> locate(const std::function<std::optional<CurvePoint>(double)>& point_at,
                              double a, double b, double tolerance,
                              const std::function<double(const CurvePoint&)>& value) {
  bool failed = false;
  const auto f = [&](double ds) -> double {
    const auto point = point_at(ds);
    const double v = point ? value(*point) : not_a_number;
    failed = failed || !std::isfinite(v);
    return failed ? 0.0 : v;
  };
  const double fa = f(a), fb = f(b);
  if (failed || (fa > 0 && fb > 0) || (fa < 0 && fb < 0)) return std::nullopt;
  double low = a, high = b;
  if (fa == 0 || fb == 0) {
    low = high = fa == 0 ? a : b;
  } else {
    if (!(a < b) || !std::isfinite(a) || !std::isfinite(b)) return std::nullopt;
    const auto close = [tolerance](double l, double h) { return std::abs(h - l) <= tolerance; };
    std::uintmax_t most = 100;
    std::tie(low, high) = boost::math::tools::toms748_solve(f, a, b, fa, fb, close, most);
  }
  if (failed) return std::nullopt;
  auto point = point_at(0.5 * (low + high));
  if (!point) return std::nullopt;
  return Located{std::move(*point), std::min(low, high), std::max(low, high)};
}

std::optional<Located> locate(const Walker& walker, const CurvePoint& from, double a, double b,
                              const std::function<double(const CurvePoint&)>& value) {
  return locate([&](double ds) { return point_at(walker, from, ds); }, a, b,
                walker.options.location_tolerance * std::abs(b - a), value);
}

}  // namespace springfold::continuation
