#include "continuation/branches/junction_ways.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "continuation/kinks/kink.hpp"
#include "continuation/kinks/kink_passage.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/locate.hpp"
#include "continuation/points/normalised.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {
namespace {

/// Where to begin along a ray: where the engine says; a little further where lambda turns at the kink itself,
/// because a trace that begins there would find a turn at its own start.
CurvePoint start_on(const Walker& walker, const CurvePoint& leaving, const Ray& ray,
                    const Surfaces& surfaces) {
  constexpr double far_enough = 10 * told_apart, too_near = one_place;
  if (ray.start) return *ray.start;
  if (std::abs(leaving.tangent.dlambda) > flat_rate) return leaving;
  for (double distance = far_enough; distance > too_near; distance *= 0.5) {
    auto point = point_at(walker, leaving, distance);
    if (!point) continue;
    point->s = distance;
    if (before_next_surface(walker, leaving, surfaces, *point, ray.tangent)) return *point;
  }
  return leaving;
}

/// A ray that leaves at another point, next to this one: rounding does not tell the two.
bool leaves_beside(const Walker& walker, const Hit& hit, const Ray& ray) {
  return std::any_of(
      hit.leaving_beside.begin(), hit.leaving_beside.end(), [&](const CurvePoint& p) {
        return p.piece == ray.piece && cosine(walker, p.tangent, ray.tangent) > same_way;
      });
}

/// The ways out of a point, as many as were told where it was met, and the way back.
Rays rays_told(const Walker& walker, const Hit& hit, const std::vector<Index>& active) {
  const std::size_t told = hit.leaving.size() + hit.leaving_beside.size() + 1;
  if (hit.kind != HitKind::branching_kink)
    return rays_around(walker, hit.point, active, located_rank);
  std::vector<Piece> pieces{hit.point.piece};
  for (const auto* ways : {&hit.leaving, &hit.leaving_beside})
    for (const CurvePoint& way : *ways) pieces.push_back(way.piece);
  const bool are_known = hit.leaving.size() > 1;  // at a start they are not
  const auto among_them = [&](double full_rank) {
    return rays_around(walker, hit.point, active, full_rank, nullptr, false,
                       are_known ? &pieces : nullptr);
  };
  Rays rays = among_them(located_rank);
  if (rays.rays.size() >= told) return rays;
  rays = among_them(half_branch_rank);
  if (rays.complete && rays.rays.size() < told) {
    rays.complete = false;
    rays.why = "ways that lead on could not be found again";
  }
  return rays;
}

/// The ways out of a point on switching surfaces.
void add_rays(const Walker& walker, const Hit& hit, const std::vector<Index>& active,
              Junction& junction) {
  const CurvePoint& point = hit.point;
  Surfaces surfaces{.active = active};
  if (!walker.problem.switch_gradients(point.x, point.lambda, surfaces.dg_dx, surfaces.dg_dlambda))
    return;
  const Rays rays = rays_told(walker, hit, active);
  junction.complete = rays.complete;
  junction.why = rays.why;
  for (const Ray& ray : rays.rays) {
    if (leaves_beside(walker, hit, ray)) continue;
    const CurvePoint leaving = point_on_ray(walker, point, ray);
    junction.ways.push_back(
        {leaving, start_on(walker, leaving, ray, surfaces), -1, ray.beyond, ray.accuracy});
  }
}

/// Ways out of a singular point: of the reduced equation there, or only those along the curve.
void add_exits(const Walker& walker, const DiagramOptions& options, const Hit& hit,
               Junction& junction) {
  const std::string reason = options.left_out ? options.left_out(hit.point) : "";
  if (!reason.empty()) {
    junction.complete = false;
    junction.why = reason;
    if (hit.point.tangent.dx.size() == 0) return;
    CurvePoint back = hit.point;
    back.tangent = opposite(back.tangent);
    junction.ways = {{hit.point, hit.point}, {back, back}};
    return;
  }
  const int corank = hit.kind == HitKind::touch ? corank_of(walker, hit.point) : hit.multiplicity;
  const auto near_enough = [&](const CurvePoint& start, const Direction& tangent) {
    return before_next_surface(walker, hit.point, {}, start, tangent);
  };
  const Exits exits = exits_at(walker, hit.point, corank, near_enough);
  junction.complete = exits.complete;
  junction.why = exits.why;
  for (const Exit& exit : exits.exits) junction.ways.push_back(way_of(hit.point, exit));
}

}  // namespace

Way way_of(const CurvePoint& at, const Exit& exit) {
  CurvePoint point = at;
  point.tangent = exit.tangent;
  point.negative.reset();
  return {.point = std::move(point),
          .start = exit.start,
          .beyond = exit.beyond,
          .accuracy = exit.accuracy};
}

bool is_junction(const Hit& hit) {
  return hit.kind == HitKind::branch_point || hit.kind == HitKind::touch ||
         hit.kind == HitKind::branching_kink;
}

bool is_one_curve(const Rays& rays) {
  return rays.complete && rays.rays.size() == 2 &&
         std::none_of(rays.rays.begin(), rays.rays.end(), [](const Ray& r) { return r.start; });
}

void find_ways(const Walker& walker, const DiagramOptions& options, const Hit& hit,
               Junction& junction) {
  const std::vector<Index> active = active_switches(walker, hit.point.x, hit.point.lambda);
  const bool on_surfaces = !active.empty() && active.size() <= most_active;
  if (hit.kind == HitKind::branching_kink || on_surfaces)
    add_rays(walker, hit, active, junction);
  else
    add_exits(walker, options, hit, junction);
}

}  // namespace springfold::continuation
