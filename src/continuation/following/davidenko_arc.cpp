#include "continuation/following/davidenko_arc.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>

#include "continuation/points/working_memory.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {
namespace {

constexpr double largest_return =
    root_of_rounding;  ///< farther from the curve the flow is not trusted

using Value = std::function<double(const CurvePoint&)>;

/// Values of the switches on the side of the point's piece, and their slopes along the curve.
struct SwitchSides {
  Vector values{}, slopes{};
};

std::optional<SwitchSides> sides_of(ProblemView problem, const CurvePoint& point) {
  SwitchSides sides;
  Matrix dg_dx;
  Vector dg_dlambda;
  if (!problem.switches(point.x, point.lambda, sides.values) ||
      !problem.switch_gradients(point.x, point.lambda, dg_dx, dg_dlambda))
    return std::nullopt;
  sides.slopes = dg_dx * point.tangent.dx + point.tangent.dlambda * dg_dlambda;
  for (Index j = 0; j < sides.values.size(); ++j) {
    sides.values[j] *= point.piece[static_cast<std::size_t>(j)];
    sides.slopes[j] *= point.piece[static_cast<std::size_t>(j)];
  }
  return sides;
}

/// Where switch j leaves its side between two samples, or dips below zero and comes back.
ArcSurface surface_between(const Walker& walker, const FlowArc& arc, const CurvePoint& a,
                           const CurvePoint& b, Index j, bool left) {
  const std::string doubt = "close to " + walker.problem.switch_name(j);
  const auto read = [&walker, j](Vector SwitchSides::*what) {
    return [&walker, j, what](const CurvePoint& point) {
      const auto sides = sides_of(walker.problem, point);
      return sides ? ((*sides).*what)[j] : not_a_number;
    };
  };
  const Value value = read(&SwitchSides::values), slope = read(&SwitchSides::slopes);
  double begin = a.s - arc.from.s, end = b.s - arc.from.s;
  if (!(value(b) < 0)) {
    if (!(slope(a) < 0 && slope(b) > 0)) return {.doubt = std::isnan(value(b)) ? doubt : ""};
    const auto lowest = zero_on_arc(walker, arc, begin, end, slope);
    if (!lowest) return {.doubt = doubt};
    if (!(value(lowest->point) < 0)) return {};
    end = lowest->point.s - arc.from.s;
  }
  if (left) {  // it starts at zero: begin where it is clearly on its side
    begin += tiny_share * (end - begin);
    const auto beside = point_on_arc(walker, arc, begin);
    if (!beside || !(value(*beside) > 0)) return {.doubt = doubt};
  }
  auto met = zero_on_arc(walker, arc, begin, end, value);
  if (!met) return {.doubt = doubt};
  return {.met = std::move(met)};
}

}  // namespace

std::optional<Direction> flow_at(const Walker& walker, const Vector& u, const CurvePoint& from) {
  const Index n = u.size() - 1;
  Linearisation linear;
  if (!linearise(walker.problem, u.head(n), u[n], from.piece, linear)) return std::nullopt;
  return tangent_at(linear, walker.weights, from.tangent);
}

std::optional<CurvePoint> point_on_arc(const Walker& walker, const FlowArc& arc, double t) {
  if (t == 0) return arc.from;
  const Vector u = arc.dense(t);
  const Index n = u.size() - 1;
  const auto border = flow_at(walker, u, arc.from);
  if (!border) return std::nullopt;
  NewtonResult& newton = walker.memory->newton;
  newton.x = u.head(n);
  newton.lambda = u[n];
  correct(walker.problem, walker.weights, arc.from.piece, *border, walker.options.newton,
          *walker.memory);
  if (!converged(newton)) return std::nullopt;
  Vector v(n + 1);
  v << newton.x, newton.lambda;
  const double scale = std::max(1.0, u.lpNorm<Eigen::Infinity>());
  if (!((v - u).lpNorm<Eigen::Infinity>() <= largest_return * scale)) return std::nullopt;
  Linearisation linear;
  if (!linearise(walker.problem, newton.x, newton.lambda, arc.from.piece, linear))
    return std::nullopt;
  const auto tangent = tangent_at(linear, walker.weights, *border);
  if (!tangent) return std::nullopt;
  CurvePoint point{.s = arc.from.s + t,
                   .x = newton.x,
                   .lambda = newton.lambda,
                   .tangent = *tangent,
                   .piece = arc.from.piece};
  if (walker.problem.symmetric()) point.negative = negative_eigenvalues(linear);
  return point;
}

std::optional<ArcZero> zero_on_arc(const Walker& walker, const FlowArc& arc, double a, double b,
                                   const Value& value) {
  bool failed = false;
  const auto f = [&](double t) -> double {
    const auto point = point_on_arc(walker, arc, t);
    const double v = point ? value(*point) : not_a_number;
    failed = failed || !std::isfinite(v);
    return failed ? 0 : v;
  };
  const double f_a = f(a), f_b = f(b);
  if (failed || f_a * f_b > 0) return std::nullopt;
  double low = a, high = b;
  if (f_a == 0 || f_b == 0) {
    low = high = f_a == 0 ? a : b;
  } else {
    const double tolerance = walker.options.location_tolerance * arc.h;
    const auto close = [tolerance](double l, double r) { return r - l <= tolerance; };
    std::uintmax_t most = 100;
    std::tie(low, high) = boost::math::tools::toms748_solve(f, a, b, f_a, f_b, close, most);
  }
  auto point = point_on_arc(walker, arc, 0.5 * (low + high));
  if (failed || !point) return std::nullopt;
  return ArcZero{std::move(*point), low, high};
}

ArcSurface first_surface(const Walker& walker, const FlowArc& arc,
                         const std::vector<CurvePoint>& samples, const std::vector<Index>& left) {
  for (std::size_t k = 1; k < samples.size(); ++k) {
    ArcSurface first;
    for (Index j = 0; j < walker.problem.switch_count(); ++j) {
      const bool leaves = k == 1 && std::find(left.begin(), left.end(), j) != left.end();
      ArcSurface next = surface_between(walker, arc, samples[k - 1], samples[k], j, leaves);
      if (!next.doubt.empty()) return next;
      if (next.met && (!first.met || next.met->point.s < first.met->point.s))
        first = std::move(next);
    }
    if (first.met) return first;
  }
  return {};
}

}  // namespace springfold::continuation
