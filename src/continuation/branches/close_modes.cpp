#include "continuation/branches/close_modes.hpp"

#include <algorithm>
#include <utility>

#include "continuation/branches/junction_ways.hpp"
#include "continuation/branches/known_junctions.hpp"
#include "continuation/kinks/kink.hpp"
#include "continuation/kinks/kink_passage.hpp"
#include "continuation/locating/exits.hpp"
#include "continuation/points/coincide.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {
namespace {

/// Is every way told from every other one by its direction?
bool are_told_apart(const Walker& walker, const std::vector<Way>& ways) {
  for (std::size_t i = 0; i < ways.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (cosine(walker, ways[i].point.tangent, ways[j].point.tangent) > same_way) return false;
  return true;
}

/// The ways of a junction with those of its exits; empty where they do not fit: each one that it had is one exit's.
std::vector<Way> ways_of(const Walker& walker, const Junction& junction, const Exits& exits) {
  std::vector<Way> ways = junction.ways;
  std::vector<bool> is_found(ways.size(), false);
  for (const Exit& exit : exits.exits) {
    const int same = way_along(walker, junction, exit.tangent, junction.point.piece);
    if (same < 0) {
      ways.push_back(way_of(junction.point, exit));
      continue;
    }
    const auto number = static_cast<std::size_t>(same);
    if (is_found[number]) return {};
    is_found[number] = true;
    ways[number].start = exit.start;
    ways[number].beyond = exit.beyond;
  }
  const bool are_all = std::find(is_found.begin(), is_found.end(), false) == is_found.end();
  return are_all && are_told_apart(walker, ways) ? ways : std::vector<Way>{};
}

}  // namespace

bool belongs_to(const Walker& walker, const Junction& junction, const Hit& hit) {
  return junction.reach > 0 && hit.kind == HitKind::branch_point && hit.multiplicity == 1 &&
         hit.point.piece == junction.point.piece &&
         length_of(walker, between(walker, junction.point, hit.point)) <= junction.reach;
}

TakenIn take_in(const Walker& walker, const DiagramOptions& options, const Hit& hit,
                Junction& junction) {
  const CurvePoint& point = junction.point;
  const bool are_simple = junction.kind == HitKind::branch_point && junction.multiplicity == 1 &&
                          hit.kind == HitKind::branch_point && hit.multiplicity == 1;
  const double apart = length_of(walker, between(walker, point, hit.point));
  if (!are_simple || apart > together || !active_switches(walker, point.x, point.lambda).empty() ||
      (options.left_out && !options.left_out(point).empty()))
    return TakenIn::no;
  // On the spheres stiffness is of the size of their square: residuals must be far below it.
  constexpr double square = told_apart * told_apart;
  if (residual_level * scale_of(point) > tiny_share * square) return TakenIn::untold;
  const Exits exits =
      exits_of_close_modes(walker, point, [&](const CurvePoint& start, const Direction& tangent) {
        return before_next_surface(walker, point, {}, start, tangent);
      });
  // Branches on which both take part begin on the others, at about the root of the distance where cubic terms tell.
  const bool may_be_near = exits.of_quadratic || apart <= blurred * blurred;
  const TakenIn otherwise = may_be_near ? TakenIn::untold : TakenIn::no;
  if (!exits.complete) return otherwise;
  std::vector<Way> ways = ways_of(walker, junction, exits);
  if (ways.empty()) return otherwise;
  junction.ways = std::move(ways);
  junction.multiplicity = 2;
  junction.reach = blurred;
  junction.complete = true;
  junction.why.clear();
  return TakenIn::yes;
}

}  // namespace springfold::continuation
