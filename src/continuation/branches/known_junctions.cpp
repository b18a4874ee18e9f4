#include "continuation/branches/known_junctions.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/branches/close_modes.hpp"
#include "continuation/points/coincide.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {

int junction_where(const Walker& walker, const std::vector<Junction>& junctions, const Hit& hit,
                   const std::vector<Met>& met, double same_place) {
  const CurvePoint& point = hit.point;
  const double same = same_place * scale_of(point);
  const auto just_passed = [&](int number) {
    return std::any_of(met.begin(), met.end(), [&](const Met& m) {
      return m.junction == number && std::abs(m.s - point.s) <= 2 * same;
    });
  };
  int best = -1;
  double nearest = infinity;
  for (std::size_t i = 0; i < junctions.size(); ++i) {
    const double distance = length_of(walker, between(walker, junctions[i].point, point));
    const bool is_here = distance <= same || belongs_to(walker, junctions[i], hit);
    if (!is_here || distance > nearest || just_passed(static_cast<int>(i)) ||
        are_in_different_pieces(walker, junctions[i].point, point))
      continue;
    best = static_cast<int>(i);
    nearest = distance;
  }
  return best;
}

int way_along(const Walker& walker, const Junction& junction, const Direction& direction,
              const Piece& piece) {
  int best = -1;
  double nearest = same_way;
  for (std::size_t w = 0; w < junction.ways.size(); ++w) {
    const CurvePoint& way = junction.ways[w].point;
    const double c =
        cosine(walker, way.tangent, direction) - (way.piece != piece ? nearly_same_line : 0.0);
    if (c > nearest) {
      nearest = c;
      best = static_cast<int>(w);
    }
  }
  return best;
}

}  // namespace springfold::continuation
