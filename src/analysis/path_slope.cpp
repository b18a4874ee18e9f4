#include "path_slope.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>

#include "curve_chord.hpp"
#include "first_unwanted.hpp"
#include "limits.hpp"
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

/// Springs switch there, or the path goes on along another branch.
bool breaks_there(const Hit& hit) {
  return !hit.leaving.empty() && (!hit.switches.empty() || hit.kind == HitKind::branch_point);
}

/// A stretch of the path without switching springs.
struct Stretch {
  std::vector<CurvePoint> points{};
  const Hit *from = nullptr, *to = nullptr;  ///< switchings at its ends
};

/// To the limit that ends the curve, which lies behind its last point.
std::vector<Stretch> stretches_of(const continuation::Curve& curve) {
  std::vector<Stretch> all(1);
  std::size_t h = 0;
  const auto add = [&](const CurvePoint& point) {
    for (; h < curve.hits.size() && curve.hits[h].point.s <= point.s; ++h) {
      const Hit& hit = curve.hits[h];
      if (!breaks_there(hit)) continue;
      all.back().points.push_back(hit.point);
      all.back().to = &hit;
      all.push_back({{hit.leaving.front()}, &hit, nullptr});
    }
    if (all.back().points.empty() || point.s > all.back().points.back().s)
      all.back().points.push_back(point);
  };
  for (const CurvePoint& point : curve.points) add(point);
  if (curve.stop == continuation::StopReason::event && !curve.hits.empty() &&
      curve.hits.back().stops)
    add(curve.hits.back().point);
  return all;
}

Direction in_sense(double sense, const Direction& tangent) {
  return {sense * tangent.dx, sense * tangent.dlambda};
}

/// The point of the curve between two others, at this part of the way.
std::optional<CurvePoint> between(const Member& member, const CurvePoint& a, const CurvePoint& b,
                                  double part) {
  const CurveChord chord(*member.problem, {a.x, a.lambda}, {b.x, b.lambda});
  const auto found = chord.at(part, a.piece);
  if (!found) return std::nullopt;
  return CurvePoint{.s = a.s + part * (b.s - a.s),
                    .x = found->x,
                    .lambda = found->lambda,
                    .tangent = chord.chord,
                    .piece = a.piece};
}

/// The least slope between three neighbours of a stretch; the middle one need not be below the others.
void look_between(const Member& member, const CurvePoint& a, const CurvePoint& b, double sense,
                  LeastSlope& least) {
  const auto point_at = [&](double part) {
    auto point = between(member, a, b, part);
    if (point) point->tangent = in_sense(sense, point->tangent);
    return point;
  };
  const auto slope = [&](double part) {
    const auto point = point_at(part);
    const auto value =
        point ? slope_at(member, *point, point->tangent, least.units, least.climb) : std::nullopt;
    return value.value_or(HUGE_VAL);
  };
  const auto [part, value] = boost::math::tools::brent_find_minima(slope, 0.0, 1.0, bits);
  if (!(value < least.value)) return;
  least = {value, least.units, least.climb, *point_at(part), std::nullopt, false};
}

/// In which sense the slope of a path is told: -1 against its own. With an odd number of unstable modes at the start
/// lambda grows along the path where it falls along the one that leaves a stable start.
double sense_of(const Member& member, const BasePath& path, Climb climb) {
  const bool turns = std::any_of(path.points.begin(), path.points.end(), [](const auto& point) {
    return point.kind == EventKind::limit_point || point.kind == EventKind::corner_limit_point;
  });
  if (climb == Climb::force || !turns) return 1;
  const auto modes = unstable_at_start(member, CriticalPointSettings{});
  return modes && *modes % 2 != 0 ? -1 : 1;
}

/// The limit that the point lies on.
std::optional<EndLimit> limit_at(const Member& member, const CurvePoint& point) {
  for (const Limit& limit : member.study.until)
    for (double Limit::*side : {&Limit::low, &Limit::high}) {
      Study one = member.study;
      one.until = {Limit{.quantity = limit.quantity}};
      one.until.front().*side = limit.*side;
      if (is_on_limit(one, member.evaluator(), member.quantities(), point))
        return EndLimit{limit.quantity, side};
    }
  return std::nullopt;
}

/// How far a state is from the limit that a member has.
continuation::StateFunction distance_from(const CaseCurves& curves, const EndLimit& end,
                                          const Piece& piece) {
  return [&curves, end, piece](const Vector& x, double lambda, double mu) -> std::optional<double> {
    const Member* member = curves.equations_at(mu);
    if (member == nullptr) return std::nullopt;
    const QuantityDefinition& q = *member->quantity(end.quantity);
    for (const Limit& limit : member->study.until)
      if (limit.quantity == end.quantity)
        return (member->evaluator().value(q, {.x = x, .lambda = lambda, .piece = piece}) -
                limit.*end.side) /
               q.scale;
    return std::nullopt;
  };
}

}  // namespace

Climb climb_of(const Member& member, const CriticalPointSettings& settings) {
  const ControlMode control = member.study.control;
  const bool is_driven = control == ControlMode::pose || control == ControlMode::mixed;
  return is_driven && settings.stability == StabilityOf::dead_load ? Climb::force : Climb::lambda;
}

std::optional<double> slope_at(const Member& member, const CurvePoint& point,
                               const Direction& reference, const SlopeUnits& units, Climb climb) {
  const PathProblem& problem = *member.problem;
  continuation::Linearisation at;
  if (!continuation::linearise_densely(problem, point.x, point.lambda, point.piece, at))
    return std::nullopt;
  const auto tangent = continuation::tangent_at(at, problem.metric(), reference);
  if (!tangent) return std::nullopt;
  const double dlambda = member.setup.lambda_scale / units.lambda * tangent->dlambda;
  const double ds =
      std::sqrt(problem.metric().dot(tangent->dx.cwiseAbs2().eval()) + dlambda * dlambda);
  if (climb == Climb::lambda) return dlambda / ds;
  CurvePoint along = point;
  along.tangent = *tangent;
  const double force = member.setup.scales.force / units.force;
  return force * member.evaluator().force_rate(along).told() / ds;
}

std::optional<LeastSlope> least_slope(const Member& member, const BasePath& path,
                                      const std::string& quantity, double end,
                                      const SlopeUnits& units, Climb climb) {
  LeastSlope least{.value = HUGE_VAL, .units = units, .climb = climb};
  const QuantityDefinition* column = member.quantity(quantity);
  const auto beyond = [&](const CurvePoint& point) {
    return std::isfinite(end) && column != nullptr &&
           member.evaluator().value(*column, point) > end;
  };
  const double sense = sense_of(member, path, climb);
  bool is_first = true;
  for (const Stretch& stretch : stretches_of(path.forward)) {
    const auto& points = stretch.points;
    std::size_t last = 0, lowest = 0;
    std::vector<double> slopes;
    for (; last < points.size(); ++last) {
      const auto slope =
          slope_at(member, points[last], in_sense(sense, points[last].tangent), units, climb);
      if (!slope) return std::nullopt;
      slopes.push_back(*slope);
      if (*slope < slopes[lowest]) lowest = last;
      if (beyond(points[last])) break;
    }
    const std::size_t count = slopes.size();
    if (slopes[lowest] < least.value) {
      least = {slopes[lowest], units, climb, points[lowest], std::nullopt, false};
      least.point.tangent = in_sense(sense, least.point.tangent);
      const Hit* hit = lowest == 0                   ? stretch.from
                       : lowest + 1 == points.size() ? stretch.to
                                                     : nullptr;
      for (const SpecialPoint& point : path.points)
        if (hit != nullptr && point.hit.point.s == hit->point.s) least.switching = point;
      least.behind = lowest == 0;
      least.at_start = is_first && lowest == 0;
      if (stretch.to == nullptr && lowest + 1 == points.size())
        least.end = limit_at(member, points[lowest]);
    }
    if (count > 1)
      look_between(member, points[lowest > 0 ? lowest - 1 : 0],
                   points[std::min(lowest + 1, count - 1)], sense, least);
    if (last < points.size()) break;
    is_first = false;
  }
  if (!std::isfinite(least.value)) return std::nullopt;
  return least;
}

std::optional<double> rate_of(const CaseCurves& curves, const Member& base,
                              const LeastSlope& least) {
  const Direction reference = least.point.tangent;
  const auto values = [&](const Member& member, CurvePoint there) -> std::optional<Vector> {
    there.piece = least.point.piece;
    const auto slope = slope_at(member, there, reference, least.units, least.climb);
    return slope ? std::optional<Vector>{Vector::Constant(1, *slope)} : std::nullopt;
  };
  if (least.switching) {
    const auto rate = rates_at_special(curves, base, *least.switching, values);
    return rate ? std::optional<double>{(*rate)[0]} : std::nullopt;
  }
  if (least.at_start) {
    const auto rate = rates_at_start(curves, values);
    return rate ? std::optional<double>{(*rate)[0]} : std::nullopt;
  }
  if (least.end) {
    const auto rate =
        rates_at_followed(curves, base,
                          {.kind = continuation::CriticalKind::zero,
                           .x = least.point.x,
                           .lambda = least.point.lambda,
                           .mu = base.mu,
                           .piece = least.point.piece,
                           .value = distance_from(curves, *least.end, least.point.piece)},
                          values);
    if (rate) return (*rate)[0];
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
    return values(*member, there);
  };
  const auto rate = six_point_derivative(along, 0, slope_step);
  return rate ? std::optional<double>{(*rate)[0] / curves.scale()} : std::nullopt;
}

}  // namespace springfold::analysis
