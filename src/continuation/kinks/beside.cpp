#include "continuation/kinks/beside.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/kinks/level.hpp"
#include "continuation/locating/bordered_test.hpp"
#include "continuation/locating/flat_turns.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/locate.hpp"
#include "continuation/points/working_memory.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/sampling.hpp"

namespace springfold::continuation {

namespace {

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
