#include "continuation/kinks/beside.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/locating/bordered_test.hpp"
#include "continuation/locating/flat_turns.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/locate.hpp"
#include "continuation/points/working_memory.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/sampling.hpp"

namespace springfold::continuation {
namespace {

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
  const Place* place = place_at(walker.problem, *walker.memory, at.x, at.lambda, at.piece);
  return place && std::abs(rate) > clear_of_rounding * rate_noise(extended_matrix(
                                                           place->at, walker.weights, at.tangent));
}

}  // namespace

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
  if (std::abs(at.tangent.dlambda) > perhaps_singular) return false;
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
  if (std::abs(at.tangent.dlambda) > turns_here || fold_is_apart(walker, at, direction, room))
    return {at, sense_of(at)};
  for (const double distance : decades<-6, -2>()) {
    const auto point = point_at(walker, at, direction * std::min(distance, 0.5 * room));
    if (point && told_from_zero(*point)) return {*point, sense_of(*point), true};
  }
  return {at, 0};
}

Beside before_singular(const Walker& walker, const CurvePoint& at, double room) {
  const bool flat = std::abs(at.tangent.dlambda) <= perhaps_singular;  // a fold lies there too
  for (const double distance : decades<-6, -4>()) {
    if (flat && distance < told_apart) continue;
    const auto point = point_at(walker, at, -std::min(distance, 0.5 * room));
    if (point && cosine(walker, point->tangent, at.tangent) > same_way)
      return {*point, sense_of(*point), true};
  }
  return {at, 0};
}

}  // namespace springfold::continuation
