#include "continuation/branches/junction_ways.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/branches/without_surfaces.hpp"
#include "continuation/kinks/kink.hpp"
#include "continuation/kinks/kink_passage.hpp"
#include "continuation/locating/exits.hpp"
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
    junction.ways.push_back({leaving, start_on(walker, leaving, ray, surfaces), -1, ray.beyond});
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
  for (const Exit& exit : exits.exits) {
    CurvePoint point = hit.point;
    point.tangent = exit.tangent;
    point.negative.reset();
    junction.ways.push_back({.point = point, .start = exit.start, .beyond = exit.beyond});
  }
}

}  // namespace

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

namespace {

/// Where a point is nearly as symmetric as a circle, branches are hard to tell from each other beside it,
/// and a trace back ends before it. It has arrived all the same if most of the way lies behind it, no other branch
/// was met, and the rest leads straight to the junction along the way's own tangent.
/// @returns length of the rest
std::optional<double> rest_of_way_back(const Walker& walker, const Way& way, const Curve& back,
                                       double gap) {
  constexpr double most = 0.5, straight = 1 - negligible_share;
  const CurvePoint& last = back.points.back();
  const Direction rest = between(walker, way.point, last);
  const double length = length_of(walker, rest);
  const bool met = std::any_of(back.hits.begin(), back.hits.end(), [](const Hit& hit) {
    return hit.kind != HitKind::unresolved && hit.kind != HitKind::limit_point;
  });
  if (met || back.stop == StopReason::observer || !(length > 0) || length > most * gap ||
      cosine(walker, rest, way.point.tangent) < straight)
    return std::nullopt;
  return length;
}

/// How far a curve is from the chord between two of its points, from their tangents; on a family of equilibria at one
/// lambda, whose tangents may be rough, a bound.
double off_chord(const Walker& walker, const CurvePoint& a, const CurvePoint& b, double length) {
  constexpr double sure = 2;
  if (std::max(std::abs(a.tangent.dlambda), std::abs(b.tangent.dlambda)) <= flat_rate)
    return length * length;
  const Direction turn{b.tangent.dx - a.tangent.dx, b.tangent.dlambda - a.tangent.dlambda};
  return sure * length_of(walker, turn) * length / 8;
}

/// The junction is known and need not be seen as a special point: where springs switch just beside it, or along a family,
/// it cannot be told. The trace back has arrived if it passes the very place.
/// @returns length of the way to the junction
std::optional<double> passage(const Walker& walker, const CurvePoint& junction, const Curve& back,
                              double tolerance) {
  for (std::size_t i = 0; i + 1 < back.points.size(); ++i) {
    const CurvePoint &a = back.points[i], &b = back.points[i + 1];
    const Direction to_junction = between(walker, a, junction), step = between(walker, a, b);
    const double length = length_of(walker, step);
    const double share =
        length > 0 ? cosine(walker, to_junction, step) * length_of(walker, to_junction) / length
                   : 0.0;
    if (share < 0 || share > 1) continue;
    const Direction off{to_junction.dx - share * step.dx,
                        to_junction.dlambda - share * step.dlambda};
    if (length_of(walker, off) > tolerance + off_chord(walker, a, b, length)) return std::nullopt;
    return a.s + share * (b.s - a.s);
  }
  return std::nullopt;
}

/// Puts a piece of this length before the first point of a curve.
void prepend(std::vector<CurvePoint> points, const std::vector<Hit>& hits, double length,
             Curve& curve) {
  points.front().s = 0;
  for (CurvePoint& p : curve.points) p.s += length;
  for (Hit& h : curve.hits) {
    h.point.s += length;
    for (CurvePoint& p : h.leaving) p.s += length;
    h.s_before += length;
    h.s_after += length;
  }
  for (StepNote& note : curve.log) note.s += length;
  for (Arc& arc : curve.arcs) {
    arc.s_begin += length;
    arc.s_end += length;
  }
  if (!curve.arcs.empty())
    curve.arcs.insert(curve.arcs.begin(), Arc{.s_begin = 0, .s_end = length});
  curve.points.insert(curve.points.begin(), points.begin(), points.end());
  curve.hits.insert(curve.hits.begin(), hits.begin(), hits.end());
}

/// Surfaces on which the junction lies, and to which the way is tangential there: what the switches are at its start is not
/// what their rates make of the way to it. On which side it lies was seen when it was found.
std::vector<Index> tangential_surfaces(const Walker& walker, const CurvePoint& junction,
                                       const Way& way, double gap) {
  std::vector<Index> list = active_switches(walker, junction.x, junction.lambda);
  Matrix dg_dx;
  Vector dg_dlambda, g;
  if (list.empty() ||
      !walker.problem.switch_gradients(junction.x, junction.lambda, dg_dx, dg_dlambda) ||
      !walker.problem.switches(way.start.x, way.start.lambda, g))
    return {};
  std::erase_if(list, [&](Index j) {
    const double rate = switch_rate(dg_dx, dg_dlambda, j, way.point.tangent);
    return std::abs(rate) * gap > small_share * std::abs(g[j]);
  });
  return list;
}

/// The trace from the start of a way back to its junction.
struct WayBack {
  Curve curve{};
  std::vector<Hit> met{};  ///< what lies between
  bool reached = false;    ///< the last hit of `curve` is the junction itself
};

/// Its steps depend on the length of the gap only, so that it is the same at every step length of the caller.
WayBack trace_back(const Walker& walker, const DiagramOptions& options, const CurvePoint& junction,
                   const Way& way, double gap) {
  WayBack back;
  // Rounding blurs the place of a multiple point, and beside a degenerate one lambda is flat to
  // rounding; nothing else can be as near.
  const auto is_junction_itself = [&](const Hit& hit) {
    if (are_in_different_pieces(walker, junction, hit.point) ||
        !lies_on(walker, junction, hit.switches))
      return false;
    const double scale = scale_of(hit.point);
    const double distance = length_of(walker, between(walker, junction, hit.point));
    const bool level = std::abs(hit.point.lambda - junction.lambda) <= residual_level * scale;
    const double blur = level                             ? aside_share
                        : hit.kind == HitKind::unresolved ? small_share
                                                          : tiny_share;
    return distance <= std::max(options.same_place * scale, blur * gap);
  };
  const auto at_hit = [&](const Hit& hit) {
    back.reached = is_junction_itself(hit);
    if (!back.reached) back.met.push_back(hit);
    return !back.reached;
  };
  const auto not_too_far = [&](const CurvePoint& p) { return p.s < 3 * gap; };
  TraceOptions near = options.trace;
  near.maximum_points = 500;
  near.verify_arcs = false;       // the piece is too near to the junction to be shown
  near.step.initial = 0.6 * gap;  // what is left is the smaller part: rest_of_way_back
  near.step.maximum = gap;
  near.step.minimum = std::min(near.step.minimum, tiny_share * gap);
  const Direction inwards = opposite(way.start.tangent);
  const WithoutSurfaces problem(walker.problem, tangential_surfaces(walker, junction, way, gap),
                                way.start.piece);
  back.curve =
      trace_in_own_units(problem, way.start.x, way.start.lambda, {way.start.piece, inwards, {}, {}},
                         {}, near, not_too_far, at_hit);
  // A kink ends the trace by itself.
  if (!back.reached && !back.curve.hits.empty())
    back.reached = is_junction_itself(back.curve.hits.back());
  return back;
}

/// Nearer to the junction than can be told apart, what the trace meets on the junction's surfaces is the junction itself.
void leave_to_junction(const Walker& walker, const CurvePoint& junction, WayBack& back) {
  const auto is_near = [&](const CurvePoint& p) {
    return length_of(walker, between(walker, junction, p)) <= told_apart * scale_of(junction);
  };
  const auto is_its_own = [&](const Hit& hit) {
    return is_near(hit.point) && lies_on(walker, junction, hit.switches);
  };
  std::erase_if(back.met, is_its_own);
  std::erase_if(back.curve.hits, is_its_own);
}

/// Length of the way to the junction; takes out of `back` what belongs to the junction.
std::optional<double> length_back(const Walker& walker, const CurvePoint& junction, const Way& way,
                                  double gap, double tolerance, WayBack& back) {
  if (back.reached) return back.curve.hits.back().point.s;
  if (const auto passed = passage(walker, junction, back.curve, tolerance)) {
    std::erase_if(back.met, [&](const Hit& hit) {
      return hit.kind == HitKind::family || hit.point.s >= *passed - tolerance;
    });
    return passed;
  }
  leave_to_junction(walker, junction, back);
  const auto rest = rest_of_way_back(walker, way, back.curve, gap);
  if (!rest) return std::nullopt;
  std::erase_if(back.met, [](const Hit& hit) { return hit.kind == HitKind::unresolved; });
  return back.curve.points.back().s + *rest;
}

CurvePoint turned(CurvePoint p, double length) {
  p.s = length - p.s;
  p.tangent = opposite(p.tangent);
  return p;
}

/// A family on which the curve begins reaches to the junction itself, and is not told once more on the way back.
void begin_families_at(const CurvePoint& junction, double length, Curve& curve,
                       std::vector<Hit>& met) {
  for (Hit& hit : curve.hits) {
    if (hit.kind != HitKind::family || hit.s_before != 0) continue;
    hit.point = junction;
    hit.point.s = hit.s_before = -length;
    std::erase_if(met, [](const Hit& h) { return h.kind == HitKind::family; });
  }
}

}  // namespace

bool attach_to_junction(const Walker& walker, const DiagramOptions& options,
                        const CurvePoint& junction, const Way& way, Curve& curve) {
  const double gap = length_of(walker, between(walker, junction, way.start));
  if (!(gap > 0)) return true;
  const double tolerance = options.same_place * scale_of(junction);
  std::vector<CurvePoint> points{way.point};
  std::vector<Hit> hits;
  double length = gap;
  if (gap > tolerance) {
    WayBack back = trace_back(walker, options, junction, way, gap);
    const auto found = length_back(walker, junction, way, gap, tolerance, back);
    if (!found && gap > told_apart) return false;
    if (!found) back = {};
    length = found.value_or(gap);
    for (auto p = back.curve.points.rbegin(); p != back.curve.points.rend(); ++p)
      if (p->s > 0 && p->s < length) points.push_back(turned(*p, length));
    for (auto h = back.met.rbegin(); h != back.met.rend(); ++h) {
      Hit hit = *h;
      hit.point = turned(hit.point, length);
      std::swap(hit.s_before, hit.s_after);
      hit.s_before = length - hit.s_before;
      hit.s_after = length - hit.s_after;
      hits.push_back(std::move(hit));
    }
  }
  begin_families_at(way.point, length, curve, hits);
  prepend(points, hits, length, curve);
  return true;
}

}  // namespace springfold::continuation
