#include "continuation/points/locate.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>

#include "continuation/points/coincide.hpp"
#include "continuation/points/working_memory.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {

bool find_point_at(const Walker& walker, const CurvePoint& from, double ds, CurvePoint& point) {
  StepMeasures measures;
  std::string refusal;
  point.x = from.x + ds * from.tangent.dx;
  point.lambda = from.lambda + ds * from.tangent.dlambda;
  point.s = from.s + ds;
  return find_point(walker, from.piece, from.tangent, point, measures, refusal);
}

std::optional<CurvePoint> point_at(const Walker& walker, const CurvePoint& from, double ds) {
  std::optional<CurvePoint> point(std::in_place);
  if (!find_point_at(walker, from, ds, *point)) point.reset();
  return point;
}

std::optional<CurvePoint> point_between(const Walker& walker, const CurvePoint& from,
                                        const CurvePoint& to, double ds) {
  const double h = to.s - from.s, t = ds / h;
  const double along = metric_product(walker.weights, to.tangent, from.tangent);
  if (!(h > 0) || !(along > 0)) return point_at(walker, from, ds);
  // u(t) = u_0 + h t (tau_0 + t (a + t b)), with the rates du/ds = tau_0 and tau_1 / (tau_1 . tau_0).
  const Vector rate = to.tangent.dx / along, chord = (to.x - from.x) / h;
  const double rate_l = to.tangent.dlambda / along, chord_l = (to.lambda - from.lambda) / h;
  const Vector a = 3 * chord - 2 * from.tangent.dx - rate, b = from.tangent.dx + rate - 2 * chord;
  const double a_l = 3 * chord_l - 2 * from.tangent.dlambda - rate_l,
               b_l = from.tangent.dlambda + rate_l - 2 * chord_l;
  const Vector x = from.x + ds * (from.tangent.dx + t * (a + t * b));
  const double lambda = from.lambda + ds * (from.tangent.dlambda + t * (a_l + t * b_l));
  StepResult result = point_on_curve(walker, x, lambda, from.piece, from.tangent);
  if (!result.point) return std::nullopt;
  const Direction slope{from.tangent.dx + t * (2 * a + 3 * t * b),
                        from.tangent.dlambda + t * (2 * a_l + 3 * t * b_l)};
  const double length = length_of(walker, slope);
  if (metric_product(walker.weights, result.point->tangent, slope) < half_a_right_angle * length)
    return std::nullopt;
  result.point->s = from.s + ds;
  return std::move(result.point);
}

std::optional<Located> locate(const Walker& walker, const CurvePoint& from, double a, double b,
                              const std::function<double(const CurvePoint&)>& value) {
  bool failed = false;
  const auto f = [&](double ds) -> double {
    const auto point = point_at(walker, from, ds);
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
