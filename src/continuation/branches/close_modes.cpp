#include "continuation/branches/close_modes.hpp"

#include <algorithm>
#include <cmath>
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

/// Is it a simple branch point, beside no surface, whose ways are looked for?
bool may_take_in(const Walker& walker, const DiagramOptions& options, const Junction& junction) {
  const CurvePoint& point = junction.point;
  return junction.kind == HitKind::branch_point && junction.multiplicity == 1 &&
         active_switches(walker, point.x, point.lambda).empty() &&
         (!options.left_out || options.left_out(point).empty());
}

/// @param near  branches on which both modes take part may begin so near to the junction that no trace tells them
TakenIn take_in_second_mode(const Walker& walker, Junction& junction, bool near) {
  const CurvePoint& point = junction.point;
  // On the spheres stiffness is of the size of their square: residuals must be far below it.
  constexpr double square = told_apart * told_apart;
  if (residual_level * scale_of(point) > tiny_share * square) return TakenIn::untold;
  const Exits exits =
      exits_of_close_modes(walker, point, [&](const CurvePoint& start, const Direction& tangent) {
        return before_next_surface(walker, point, {}, start, tangent);
      });
  const TakenIn otherwise = exits.of_quadratic || near ? TakenIn::untold : TakenIn::no;
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

}  // namespace

bool belongs_to(const Walker& walker, const Junction& junction, const Hit& hit) {
  return junction.reach > 0 && hit.kind == HitKind::branch_point && hit.multiplicity == 1 &&
         hit.point.piece == junction.point.piece &&
         length_of(walker, between(walker, junction.point, hit.point)) <= junction.reach;
}

TakenIn take_in(const Walker& walker, const DiagramOptions& options, const Hit& hit,
                Junction& junction) {
  const bool is_simple = hit.kind == HitKind::branch_point && hit.multiplicity == 1;
  const double apart = length_of(walker, between(walker, junction.point, hit.point));
  if (!is_simple || apart > together || !may_take_in(walker, options, junction)) return TakenIn::no;
  // Branches on which both take part begin on the others, at about the root of the distance where cubic terms tell.
  return take_in_second_mode(walker, junction, apart <= blurred * blurred);
}

TakenIn take_in_beside_start(const Walker& walker, const DiagramOptions& options,
                             Junction& junction) {
  if (!may_take_in(walker, options, junction) || junction.ways.empty()) return TakenIn::no;
  const auto steepest =
      std::max_element(junction.ways.begin(), junction.ways.end(), [](const Way& a, const Way& b) {
        return std::abs(a.point.tangent.dlambda) < std::abs(b.point.tangent.dlambda);
      });
  junction.point.tangent = steepest->point.tangent;
  if (modes_within(walker, junction.point, together) < 2) return TakenIn::no;
  return take_in_second_mode(walker, junction, true);
}

}  // namespace springfold::continuation
