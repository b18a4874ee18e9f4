#include "continuation/branches/piece_before.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "continuation/branches/close_modes.hpp"
#include "continuation/branches/without_surfaces.hpp"
#include "continuation/kinks/beside.hpp"
#include "continuation/kinks/kink.hpp"
#include "continuation/kinks/kink_passage.hpp"
#include "continuation/locating/reduced_equation.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/normalised.hpp"
#include "continuation/points/workspace.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {
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
    return hit.kind != HitKind::unresolved && hit.kind != HitKind::limit_point &&
           hit.kind != HitKind::user;
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

/// The junction is known and need not be seen as a special point: where springs switch just beside it, or along a
/// family, it cannot be told. The trace back has arrived if it passes the very place.
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

/// Surfaces on which the junction lies, and to which the way is tangential there: what the switches are at its start is
/// not what their rates make of the way to it, or these are none to the accuracy of the tangent, and the switch grows
/// with more than the distance. On which side it lies was seen when it was found.
std::vector<Index> tangential_surfaces(const Walker& walker, const CurvePoint& junction,
                                       const Way& way, double gap) {
  std::vector<Index> list = active_switches(walker, junction.x, junction.lambda);
  constexpr double more_than_linear = 1.5;
  Workspace::Switches at_junction, at_start;
  if (list.empty() || !read_switches(walker, junction, at_junction) ||
      !read_switches(walker, way.start, at_start))
    return {};
  const Vector root = metric_roots(walker.weights);
  std::erase_if(list, [&](Index j) {
    const double g = at_start.g[j];
    const auto moves = [&] { return sure_rate(walker, at_start, j, way.start); };
    if (std::abs(g) <= walker.options.simultaneous && moves() == 0)
      return true;  // it rests: both sides are looked at
    const double leaves =
        std::abs(switch_rate(at_junction.dg_dx, at_junction.dg_dlambda, j, way.point.tangent));
    Vector gradient(root.size());
    gradient << at_junction.dg_dx.row(j).transpose(), at_junction.dg_dlambda[j];
    const double unknown = between_samples * way.accuracy * gradient.cwiseQuotient(root).norm();
    if (leaves * gap <= small_share * std::abs(g)) return false;
    const bool grows = leaves <= unknown && g != 0 && moves() * gap / g > more_than_linear;
    return !grows;
  });
  return list;
}

/// Something unresolved at the junction hides more than the junction, if it begins farther from it than rounding blurs
/// its place.
bool reaches_out(const Hit& hit, double junction, double gap) {
  return hit.kind == HitKind::unresolved && junction - hit.s_before > small_share * gap;
}

/// The trace from the start of a way back to its junction.
struct WayBack {
  Curve curve{};
  std::vector<Hit> met{};  ///< what lies between
  bool reached = false;    ///< the last hit of `curve` is the junction itself
};

/// Its steps depend on the length of the gap only, so that it is the same at every step length of the caller.
WayBack trace_back(const Walker& walker, const std::vector<Event>& events,
                   const DiagramOptions& options, const Junction& at, const Way& way, double gap) {
  const CurvePoint& junction = at.point;
  WayBack back;
  // Rounding blurs the place of a multiple point, and beside a degenerate one lambda is flat to
  // rounding; nothing else can be as near.
  const auto is_junction_itself = [&](const Hit& hit) {
    if (hit.kind == HitKind::user || are_in_different_pieces(walker, junction, hit.point) ||
        !lies_on(walker, junction, hit.switches) || reaches_out(hit, hit.point.s, gap))
      return false;
    const double scale = scale_of(hit.point);
    const double distance = length_of(walker, between(walker, junction, hit.point));
    const bool level = std::abs(hit.point.lambda - junction.lambda) <= residual_level * scale;
    const double blur = level                             ? aside_share
                        : hit.kind == HitKind::unresolved ? small_share
                                                          : tiny_share;
    return distance <= std::max(options.same_place * scale, blur * gap) ||
           belongs_to(walker, at, hit);
  };
  const auto at_hit = [&](const Hit& hit) {
    back.reached = is_junction_itself(hit);
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
                         events, near, not_too_far, at_hit);
  // A kink ends the trace by itself.
  if (!back.reached && !back.curve.hits.empty())
    back.reached = is_junction_itself(back.curve.hits.back());
  back.met = back.curve.hits;  // what is unresolved, too
  if (back.reached) back.met.pop_back();
  return back;
}

/// Nearer to the junction than can be told apart, what the trace meets on the junction's surfaces is the junction
/// itself.
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

/// What lies beyond the junction is not on the way.
void leave_beyond(double junction, double tolerance, double gap, std::vector<Hit>& met) {
  std::erase_if(met, [&](const Hit& hit) {
    const bool hides_it = hit.kind == HitKind::unresolved && hit.s_after >= junction - tolerance;
    if (hides_it) return !reaches_out(hit, junction, gap);
    return hit.kind == HitKind::family || hit.point.s >= junction - tolerance;
  });
  for (Hit& hit : met) {
    hit.point.s = std::min(hit.point.s, junction);
    hit.s_after = std::min(hit.s_after, junction);
  }
}

/// Length of the way to the junction; takes out of `back` what belongs to the junction.
std::optional<double> length_back(const Walker& walker, const CurvePoint& junction, const Way& way,
                                  double gap, double tolerance, WayBack& back) {
  if (back.reached) return back.curve.hits.back().point.s;
  if (const auto passed = passage(walker, junction, back.curve, tolerance)) {
    leave_beyond(*passed, tolerance, gap, back.met);
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

/// The caller's events seen from the other side: none of them ends the way back, and each hit tells which event it is.
std::vector<Event> seen_from_behind(std::vector<Event> events) {
  for (std::size_t i = 0; i < events.size(); ++i) {
    Event& event = events[i];
    event.action = EventAction::record;
    event.tag = static_cast<int>(i);
    const auto outwards = [](CurvePoint p) {
      p.tangent = opposite(p.tangent);
      return p;
    };
    if (event.of_place) continue;
    event.value = [value = event.value, outwards](const CurvePoint& p) {
      return value(outwards(p));
    };
    if (event.noise)
      event.noise = [noise = event.noise, outwards](const CurvePoint& p) {
        return noise(outwards(p));
      };
  }
  return events;
}

/// A special point of the way back as the branch meets it.
Hit turned(Hit hit, double length, const std::vector<Event>& events) {
  // Half-branches leave as they do; the way straight on is the one back.
  for (auto* ways : {&hit.leaving, &hit.leaving_beside})
    for (CurvePoint& p : *ways) p.s = length - p.s;
  const CurvePoint back = turned(hit.point, length);
  if (!hit.leaving.empty()) hit.leaving.front().tangent = opposite(hit.leaving.front().tangent);
  hit.point = hit.leaving.empty() ? back : std::exchange(hit.leaving.front(), back);
  std::swap(hit.s_before, hit.s_after);
  hit.s_before = length - hit.s_before;
  hit.s_after = length - hit.s_after;
  if (hit.kind == HitKind::user) {
    const Event& event = events[static_cast<std::size_t>(hit.tag)];
    hit.tag = event.tag;
    hit.stops = event.action == EventAction::stop;
  }
  return hit;
}

/// A family on which the curve begins reaches to the junction itself, and is not told once more on the way back, where
/// lambda stands still as well.
void begin_families_at(const CurvePoint& junction, double length, Curve& curve,
                       std::vector<Hit>& met) {
  for (Hit& hit : curve.hits) {
    if (hit.kind != HitKind::family || hit.s_before != 0) continue;
    hit.point = junction;
    hit.point.s = hit.s_before = -length;
    std::erase_if(met, [&](const Hit& h) {
      const double off = std::abs(h.point.lambda - junction.lambda);
      return h.kind == HitKind::family ||
             (h.kind == HitKind::unresolved && off <= residual_level * scale_of(junction));
    });
  }
}

}  // namespace

Begin begin_along(const Walker& walker, const CurvePoint& junction, const Way& way) {
  const auto from = [](const CurvePoint& p, const std::optional<CurvePoint>& farther) {
    return Ray{p.piece, p.tangent, {}, {}, farther};
  };
  if (way.beyond && opening_of(walker, way.point, *way.beyond))
    return {way.point, from(way.point, way.beyond)};
  Begin begin{way.start, from(way.start, {}), false};
  const double gap = length_of(walker, between(walker, junction, way.start));
  if (gap > 0) begin.ray.start = way.start;
  if (gap > 0) begin.ray.start->s = gap;
  return begin;
}

PieceBefore piece_before(const Walker& walker, const std::vector<Event>& events,
                         const DiagramOptions& options, const Junction& at, const Way& way) {
  const CurvePoint& junction = at.point;
  const double gap = length_of(walker, between(walker, junction, way.start));
  if (!(gap > 0)) return {};
  PieceBefore piece{.points = {way.point}, .length = gap};
  piece.points.front().s = 0;
  const double tolerance = options.same_place * scale_of(junction);
  if (gap <= tolerance) return piece;
  WayBack back = trace_back(walker, seen_from_behind(events), options, at, way, gap);
  const auto found = length_back(walker, junction, way, gap, tolerance, back);
  if (!found) {
    piece.reached = gap <= std::max(told_apart, at.reach);
    return piece;
  }
  piece.length = *found;
  std::erase_if(back.met, [&](const Hit& hit) {
    return hit.kind == HitKind::user && hit.point.s >= *found - tolerance;
  });
  // As near to the junction as its place is told the last point may lie on any of its branches.
  for (auto p = back.curve.points.rbegin(); p != back.curve.points.rend(); ++p)
    if (p->s > 0 && p->s < *found - tolerance) piece.points.push_back(turned(*p, *found));
  for (auto h = back.met.rbegin(); h != back.met.rend(); ++h)
    piece.hits.push_back(turned(*h, *found, events));
  return piece;
}

Curve end_at(const PieceBefore& piece, std::size_t hit, StopReason stop) {
  Curve curve{.points = piece.points, .stop = stop};
  const auto end = piece.hits.begin() + static_cast<std::ptrdiff_t>(hit);
  curve.hits.assign(piece.hits.begin(), end + 1);
  curve.hits.back().stops = true;
  const double last = curve.hits.back().point.s;
  std::erase_if(curve.points, [&](const CurvePoint& p) { return p.s >= last && p.s > 0; });
  curve.stop_detail = curve.hits.back().name;
  return curve;
}

void prepend(const CurvePoint& junction, PieceBefore piece, Curve& curve) {
  if (piece.points.empty()) return;
  const double length = piece.length;
  begin_families_at(junction, length, curve, piece.hits);
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
  curve.points.insert(curve.points.begin(), piece.points.begin(), piece.points.end());
  curve.hits.insert(curve.hits.begin(), piece.hits.begin(), piece.hits.end());
}

}  // namespace springfold::continuation
