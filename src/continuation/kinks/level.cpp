#include "continuation/kinks/level.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/points/locate.hpp"
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
    const double scale = std::max({1.0, p->x.lpNorm<Eigen::Infinity>(), std::abs(p->lambda)});
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

}  // namespace springfold::continuation
