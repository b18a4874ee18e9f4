#include "continuation/branches/close_modes.hpp"

#include <utility>

#include "continuation/branches/known_junctions.hpp"
#include "continuation/kinks/kink.hpp"
#include "continuation/kinks/kink_passage.hpp"
#include "continuation/locating/exits.hpp"
#include "continuation/points/coincide.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {
namespace {

/// The ways of a junction with those of its exits: each one that it had is among them.
std::vector<Way> ways_of(const Walker& walker, const Junction& junction, const Exits& exits) {
  Junction with = junction;
  std::size_t known = 0;
  for (const Exit& exit : exits.exits) {
    CurvePoint point = junction.point;
    point.tangent = exit.tangent;
    point.negative.reset();
    const int same = way_along(walker, junction, exit.tangent, point.piece);
    if (same < 0) {
      with.ways.push_back({.point = point, .start = exit.start, .beyond = exit.beyond});
      continue;
    }
    Way& way = with.ways[static_cast<std::size_t>(same)];
    way.start = exit.start;
    way.beyond = exit.beyond;
    ++known;
  }
  return known == junction.ways.size() ? std::move(with.ways) : std::vector<Way>{};
}

}  // namespace

bool belongs_to(const Walker& walker, const Junction& junction, const CurvePoint& point) {
  return junction.reach > 0 &&
         length_of(walker, between(walker, junction.point, point)) <= junction.reach;
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
  // Branches on which both take part begin on the others, at about the root of the distance at most.
  const double nearest = told_apart * told_apart * scale_of(point);
  const TakenIn otherwise = apart <= nearest ? TakenIn::untold : TakenIn::no;
  const Exits exits =
      exits_of_close_modes(walker, point, [&](const CurvePoint& start, const Direction& tangent) {
        return before_next_surface(walker, point, {}, start, tangent);
      });
  if (!exits.complete) return otherwise;
  std::vector<Way> ways = ways_of(walker, junction, exits);
  if (ways.empty()) return otherwise;
  junction.ways = std::move(ways);
  junction.multiplicity = 2;
  junction.reach = blurred * scale_of(point);
  junction.complete = true;
  junction.why.clear();
  return TakenIn::yes;
}

}  // namespace springfold::continuation
