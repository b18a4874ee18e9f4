#include "continuation/kinks/beside.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/kinks/level.hpp"
#include "continuation/numerics/numerics.hpp"
#include "continuation/numerics/sampling.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/locate.hpp"

namespace springfold::continuation {

bool told_from_zero(const CurvePoint& p) { return std::abs(p.tangent.dlambda) > function_noise; }

Beside beside(const Walker& walker, const CurvePoint& at, int direction, double room) {
  if (is_level(walker, at, direction, room)) return {at, 0};
  if (std::abs(at.tangent.dlambda) > turns_here) return {at, sense_of(at)};
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
