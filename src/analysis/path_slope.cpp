#include "path_slope.hpp"

#include <boost/math/tools/minima.hpp>
#include <cmath>

#include "springfold/continuation/newton.hpp"
#include "springfold/core/differences.hpp"

namespace springfold::analysis {
namespace {

using continuation::CurvePoint;
using continuation::Direction;
using continuation::Hit;
using continuation::HitKind;

constexpr double slope_step = 0x1p-9;  ///< of the six-point differences
/// Half of the digits of a number: a minimum is not better known from values.
constexpr int bits = 26;

bool switches_there(const Hit& hit) { return !hit.switches.empty() && !hit.leaving.empty(); }

/// A stretch of the path without switching springs.
struct Stretch {
  std::vector<CurvePoint> points{};
  const Hit *from = nullptr, *to = nullptr;  ///< switchings at its ends
};

std::vector<Stretch> stretches_of(const continuation::Curve& curve) {
  std::vector<Stretch> all(1);
  std::size_t h = 0;
  for (const CurvePoint& point : curve.points) {
    for (; h < curve.hits.size() && curve.hits[h].point.s <= point.s; ++h) {
      const Hit& hit = curve.hits[h];
      if (!switches_there(hit)) continue;
      all.back().points.push_back(hit.point);
      all.back().to = &hit;
      all.push_back({{hit.leaving.front()}, &hit, nullptr});
    }
    if (all.back().points.empty() || point.s > all.back().points.back().s)
      all.back().points.push_back(point);
  }
  return all;
}

/// The point of the curve between two others, at this part of the way.
std::optional<CurvePoint> between(const Member& member, const CurvePoint& a, const CurvePoint& b,
                                  double part) {
  const PathProblem& problem = *member.problem;
  const Direction chord{b.x - a.x, b.lambda - a.lambda};
  const auto found = continuation::correct(problem, problem.metric(), a.x + part * chord.dx,
                                           a.lambda + part * chord.dlambda, a.piece, chord, {});
  if (!continuation::converged(found)) return std::nullopt;
  return CurvePoint{.s = a.s + part * (b.s - a.s),
                    .x = found.x,
                    .lambda = found.lambda,
                    .tangent = chord,
                    .piece = a.piece};
}

/// The least slope between three neighbours of a stretch; the middle one need not be below the others.
void look_between(const Member& member, const CurvePoint& a, const CurvePoint& b,
                  LeastSlope& least) {
  const auto slope = [&](double part) {
    const auto point = between(member, a, b, part);
    const auto value = point ? slope_at(member, *point, point->tangent) : std::nullopt;
    return value.value_or(HUGE_VAL);
  };
  const auto [part, value] = boost::math::tools::brent_find_minima(slope, 0.0, 1.0, bits);
  if (!(value < least.value)) return;
  least = {value, *between(member, a, b, part), std::nullopt, false};
}

}  // namespace

std::optional<double> slope_at(const Member& member, const CurvePoint& point,
                               const Direction& reference) {
  const PathProblem& problem = *member.problem;
  continuation::Linearisation at;
  if (!continuation::linearise_densely(problem, point.x, point.lambda, point.piece, at))
    return std::nullopt;
  const auto tangent = continuation::tangent_at(at, problem.metric(), reference);
  if (!tangent) return std::nullopt;
  const ControlMode control = member.study.control;
  if (control != ControlMode::pose && control != ControlMode::mixed) return tangent->dlambda;
  CurvePoint along = point;
  along.tangent = *tangent;
  return member.evaluator().force_rate(along).told();
}

std::optional<LeastSlope> least_slope(const Member& member, const BasePath& path,
                                      const std::string& quantity, double end) {
  LeastSlope least{.value = HUGE_VAL};
  const QuantityDefinition* column = member.quantity(quantity);
  const auto beyond = [&](const CurvePoint& point) {
    return std::isfinite(end) && column != nullptr &&
           member.evaluator().value(*column, point) > end;
  };
  for (const Stretch& stretch : stretches_of(path.forward)) {
    const auto& points = stretch.points;
    std::size_t last = 0, lowest = 0;
    std::vector<double> slopes;
    for (; last < points.size(); ++last) {
      const auto slope = slope_at(member, points[last], points[last].tangent);
      if (!slope) return std::nullopt;
      slopes.push_back(*slope);
      if (*slope < slopes[lowest]) lowest = last;
      if (beyond(points[last])) break;
    }
    const std::size_t count = slopes.size();
    if (slopes[lowest] < least.value) {
      least = {slopes[lowest], points[lowest], std::nullopt, false};
      const Hit* hit = lowest == 0                   ? stretch.from
                       : lowest + 1 == points.size() ? stretch.to
                                                     : nullptr;
      for (const SpecialPoint& point : path.points)
        if (hit != nullptr && point.hit.point.s == hit->point.s) least.switching = point;
      least.behind = lowest == 0;
    }
    if (count > 1)
      look_between(member, points[lowest > 0 ? lowest - 1 : 0],
                   points[std::min(lowest + 1, count - 1)], least);
    if (last < points.size()) break;
  }
  if (!std::isfinite(least.value)) return std::nullopt;
  return least;
}

std::optional<double> rate_of(const CaseCurves& curves, const Member& base,
                              const LeastSlope& least) {
  const Direction reference = least.point.tangent;
  if (least.switching) {
    const Piece piece = least.point.piece;
    const auto values = [&](const Member& member,
                            const CurvePoint& point) -> std::optional<Vector> {
      CurvePoint there = point;
      there.piece = piece;
      const auto slope = slope_at(member, there, reference);
      return slope ? std::optional<Vector>{Vector::Constant(1, *slope)} : std::nullopt;
    };
    const auto rate = rates_at_special(curves, base, *least.switching, values);
    return rate ? std::optional<double>{(*rate)[0]} : std::nullopt;
  }
  // The slope is stationary along the path: where exactly its point moves to does not matter.
  const auto along = [&](double t) -> std::optional<Vector> {
    const Member* member = curves.at(base.mu + t);
    if (member == nullptr) return std::nullopt;
    const auto found =
        continuation::correct(*member->problem, member->problem->metric(), least.point.x,
                              least.point.lambda, least.point.piece, reference, {});
    if (!continuation::converged(found)) return std::nullopt;
    CurvePoint there = least.point;
    there.x = found.x;
    there.lambda = found.lambda;
    const auto slope = slope_at(*member, there, reference);
    return slope ? std::optional<Vector>{Vector::Constant(1, *slope)} : std::nullopt;
  };
  const auto rate = six_point_derivative(along, 0, slope_step);
  return rate ? std::optional<double>{(*rate)[0] / curves.scale()} : std::nullopt;
}

}  // namespace springfold::analysis
