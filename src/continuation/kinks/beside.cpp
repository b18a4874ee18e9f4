#include "continuation/kinks/beside.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>

#include "continuation/kinks/kink.hpp"
#include "continuation/locating/bordered_test.hpp"
#include "continuation/locating/singular.hpp"
#include "continuation/points/arc.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/locate.hpp"
#include "continuation/points/workspace.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/sampling.hpp"

namespace springfold::continuation {
namespace {

/// The branch near the singular point.
struct Continuation {
  const Walker& walker;
  const CurvePoint& junction;
  ArcModel model{};
  CurvePoint half{};  ///< corrected, between the singular point and the one farther out

  CurvePoint at(double t) const {
    CurvePoint point;
    model.point(walker.weights, junction, t, point);
    point.piece = junction.piece;
    return point;
  }

  /// Of every switch, positive on the side of the piece.
  std::optional<Vector> clearance(double t) const {
    const CurvePoint p = at(t);
    Vector g;
    if (!walker.problem.switches(p.x, p.lambda, g)) return std::nullopt;
    for (Index j = 0; j < g.size(); ++j) g[j] *= junction.piece[static_cast<std::size_t>(j)];
    return g;
  }
};

/// Is the model the curve, as far as corrected points can tell, and does nothing happen on it?
bool is_known(const Continuation& c, const CurvePoint& farther) {
  const auto check =
      point_at(c.walker, c.half, -0.5 * way_to(c.walker.weights, c.junction, c.half));
  if (!check || !told_from_zero(farther) || !told_from_zero(c.half)) return false;
  return distance_of(c.walker, c.model, c.junction, *check) <= promised_place &&
         sense_of(c.half) == sense_of(farther) && c.half.negative == farther.negative;
}

/// Way to the first surface; nothing where none is near, or clearances do not fall evenly towards it.
std::optional<double> first_surface(const Continuation& c) {
  const auto here = c.clearance(0);
  if (!here || !((*here).minCoeff() > c.walker.options.simultaneous)) return std::nullopt;
  const auto least = [&c](double t) {
    const auto g = c.clearance(t);
    return g ? g->minCoeff() : not_a_number;
  };
  double far = c.walker.options.simultaneous;
  while (far < told_apart && least(far) > 0) far *= 2;
  if (!(least(far) < 0)) return std::nullopt;
  std::uintmax_t most = 100;
  const auto [a, b] =
      boost::math::tools::toms748_solve(least, 0.0, far, here->minCoeff(), least(far),
                                        boost::math::tools::eps_tolerance<double>(), most);
  const double t = 0.5 * (a + b);
  // Half-way every switch that comes near its surface must be where a straight line would have it.
  const auto middle = c.clearance(0.5 * t), there = c.clearance(t);
  if (!middle || !there) return std::nullopt;
  for (Index j = 0; j < here->size(); ++j) {
    const double change = std::abs((*there)[j] - (*here)[j]);
    const double off = std::abs((*middle)[j] - 0.5 * ((*there)[j] + (*here)[j]));
    if (off > small_share * change && !((*here)[j] > 2 * change)) return std::nullopt;
  }
  return t;
}

bool satisfies(const Walker& walker, const CurvePoint& p) {
  Vector F;
  const double scale = std::max(1.0, size_of(p));
  return walker.problem.residual(p.x, p.lambda, p.piece, F) &&
         F.lpNorm<Eigen::Infinity>() <= residual_level * scale;
}

/// How much F changes with lambda at a point, by size.
double reliance_on_lambda(const Walker& walker, const CurvePoint& p) {
  constexpr double apart = 0x1p-10;
  Vector here, there;
  if (!walker.problem.residual(p.x, p.lambda, p.piece, here) ||
      !walker.problem.residual(p.x, p.lambda + apart, p.piece, there))
    return 0;
  return (there - here).lpNorm<Eigen::Infinity>() / apart;
}

/// Is the fold that a small rate of lambda at a kink announces another point than the kink? It lies as far away as the
/// rate says against its change on the way there.
bool fold_is_apart(const Walker& walker, const CurvePoint& at, int direction, double room) {
  const double rate = at.tangent.dlambda, way = direction * std::min(told_apart, 0.5 * room);
  const auto there = point_at(walker, at, way);
  if (!there) return false;
  const double change = std::abs((there->tangent.dlambda - rate) / way);
  if (!(std::abs(rate) > same_point * change)) return false;
  const LinearisedPoint* place =
      linearised_at(walker.problem, *walker.memory, at.x, at.lambda, at.piece);
  return place && std::abs(rate) > clear_of_rounding * rate_noise(extended_matrix(
                                                           place->at, walker.weights, at.tangent));
}

}  // namespace

std::optional<Opening> opening_of(const Walker& walker, const CurvePoint& junction,
                                  const CurvePoint& farther) {
  if (walker.problem.switch_count() == 0) return std::nullopt;
  Continuation c{.walker = walker, .junction = junction};
  auto half = point_at(walker, farther, -0.5 * way_to(walker.weights, junction, farther));
  if (!half) return std::nullopt;
  c.half = std::move(*half);
  const StepSamples nodes(junction, &c.half, farther);
  if (!c.model.go_through(walker.weights, junction, nodes) || !is_known(c, farther))
    return std::nullopt;
  const auto t = first_surface(c);
  if (!t) return std::nullopt;
  Opening opening{.middle = {c.at(0.5 * *t), sense_of(farther), true}};
  opening.middle.point.negative = farther.negative;
  opening.kink = {
      .status = KinkSearch::Status::found, .point = c.at(*t), .before = *t, .after = *t};
  const CurvePoint& end = opening.kink.point;
  opening.kink.active = active_switches(walker, end.x, end.lambda);
  const bool moves_on = end.tangent.dlambda * farther.tangent.dlambda >= 0;
  if (opening.kink.active.empty() || !moves_on || !satisfies(walker, end)) return std::nullopt;
  return opening;
}

bool same_level(const Walker& walker, const std::vector<const CurvePoint*>& points) {
  const CurvePoint* best = nullptr;
  double most = 0;
  for (const CurvePoint* p : points)
    if (const double reliance = reliance_on_lambda(walker, *p); reliance > most)
      best = p, most = reliance;
  if (best == nullptr) return false;
  Vector F;
  return std::all_of(points.begin(), points.end(), [&](const CurvePoint* p) {
    const double scale = std::max(1.0, size_of(*p));
    return walker.problem.residual(p->x, best->lambda, p->piece, F) &&
           F.lpNorm<Eigen::Infinity>() <=
               2 * residual_bound(walker.problem, p->piece, walker.options.newton, scale);
  });
}

bool is_level(const Walker& walker, const CurvePoint& at, int direction, double room) {
  if (std::abs(at.tangent.dlambda) > told_apart) return false;
  const double reach = direction * std::min(level_reach, 0.5 * room);
  const auto end = point_at(walker, at, reach),
             half = point_at(walker, at, uneven_share(4) * reach);
  if (!end || !half || !same_level(walker, {&at, &*half, &*end})) return false;
  // A fold is level to the residual's tolerance on any way that is short enough: there its rate must be as small as one
  // that leaves so much on the whole way.
  constexpr double most_rate = 2 * residual_level / level_reach;
  return std::abs(reach) >= level_reach ||
         std::max(std::abs(half->tangent.dlambda), std::abs(end->tangent.dlambda)) <= most_rate;
}

bool told_from_zero(const CurvePoint& p) { return std::abs(p.tangent.dlambda) > function_noise; }

Beside beside(const Walker& walker, const CurvePoint& at, int direction, double room) {
  if (is_level(walker, at, direction, room)) return {at, 0};
  if (std::abs(at.tangent.dlambda) > 10 * flat_rate || fold_is_apart(walker, at, direction, room))
    return {at, sense_of(at)};
  for (const double distance : decades<-6, -2>()) {
    const auto point = point_at(walker, at, direction * std::min(distance, 0.5 * room));
    if (point && told_from_zero(*point)) return {*point, sense_of(*point), true};
  }
  return {at, 0};
}

Beside before_singular(const Walker& walker, const CurvePoint& at, double room) {
  const bool flat = std::abs(at.tangent.dlambda) <= told_apart;  // a fold lies there too
  for (const double distance : decades<-6, -4>()) {
    if (flat && distance < told_apart) continue;
    const auto point = point_at(walker, at, -std::min(distance, 0.5 * room));
    if (point && cosine(walker, point->tangent, at.tangent) > same_way)
      return {*point, sense_of(*point), true};
  }
  return {at, 0};
}

}  // namespace springfold::continuation
