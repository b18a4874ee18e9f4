#include "continuation/kinks/kink_passage.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "continuation/kinks/kink_half_branches.hpp"
#include "continuation/kinks/kink_numerics.hpp"
#include "continuation/kinks/kink_rays.hpp"
#include "continuation/kinks/level.hpp"
#include "continuation/locating/bordered_test.hpp"
#include "continuation/locating/flat_turns.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/locate.hpp"
#include "continuation/points/numerics.hpp"
#include "continuation/points/working_memory.hpp"
#include "springfold/core/inertia.hpp"

namespace springfold::continuation {
namespace {

constexpr double vertical = 1e-12;   // lambda does not change along the curve at all
constexpr double turns_here = 1e-7;  // lambda's rate at a kink that is taken for zero

/// The curve on one side of a kink, as near as lambda's rate can be told from zero.
struct Beside {
  CurvePoint point{};
  int sense = 0;       ///< sign of lambda's rate; 0: it stays zero
  bool moved = false;  ///< `point` is not the kink itself
};

int sense_of(const CurvePoint& p) { return p.tangent.dlambda > 0 ? 1 : -1; }
bool told_from_zero(const CurvePoint& p) { return std::abs(p.tangent.dlambda) > 1e-11; }

/// @param direction  +1: ahead along the tangent, -1: back
/// @param room       no further away than this
Beside beside(const Walker& walker, const CurvePoint& at, int direction, double room) {
  if (is_level(walker, at, direction, room)) return {at, 0};
  if (std::abs(at.tangent.dlambda) > turns_here) return {at, sense_of(at)};
  for (const double distance : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    const auto point = point_at(walker, at, direction * std::min(distance, 0.5 * room));
    if (point && told_from_zero(*point)) return {*point, sense_of(*point), true};
  }
  return {at, 0};
}

/// The curve just before a kink at which its own piece is singular: the branch point belongs to the kink.
Beside before_singular(const Walker& walker, const CurvePoint& at, double room) {
  for (const double distance : {1e-6, 1e-5, told_apart}) {
    const auto point = point_at(walker, at, -std::min(distance, 0.5 * room));
    if (point && cosine(walker, point->tangent, at.tangent) > same_way)
      return {*point, sense_of(*point), true};
  }
  return {at, 0};
}

/// Is this ray in the piece on which the curve arrived, or one that it shares with it?
bool on_piece(const Ray& ray, const Piece& piece) {
  for (std::size_t j = 0; j < ray.piece.size(); ++j)
    if (ray.piece[j] != piece[j] && std::find(ray.resting.begin(), ray.resting.end(),
                                              static_cast<Index>(j)) == ray.resting.end())
      return false;
  return true;
}

/// The ray along which the curve arrived. At a branch point of the arriving piece its tangent is known only
/// roughly: then that of the ray is taken.
void take_way_back(const Walker& walker, CurvePoint& arrived, std::vector<Ray>& rays) {
  const Direction back = opposite(arrived.tangent);
  const auto off = [&](const Ray& ray) {
    return on_piece(ray, arrived.piece) ? 1 - metric_product(walker.weights, ray.tangent, back)
                                        : HUGE_VAL;
  };
  const auto best = std::min_element(rays.begin(), rays.end(),
                                     [&](const Ray& a, const Ray& b) { return off(a) < off(b); });
  if (best == rays.end()) return;
  const bool singular = best->start.has_value();
  if (!(singular ? off(*best) <= nearly_same_line
                 : same_direction(walker.weights, best->tangent, back, 1e-6)))
    return;
  if (singular) arrived.tangent = opposite(best->tangent);
  rays.erase(best);
}

/// The family that reaches as far as this point.
Hit* open_family(const CurvePoint& from, Curve& curve) {
  for (auto hit = curve.hits.rbegin(); hit != curve.hits.rend(); ++hit)
    if (hit->kind == HitKind::family && hit->s_after >= from.s) return &*hit;
  return nullptr;
}

/// Does lambda stand still along the step? On a short one its rate must vanish to rounding, or an
/// inflection would do; not so where it has been seen to stand still. Where its rate rises clear of its rounding
/// on both sides of a step, it does not stand still, but turns, or almost does.
bool stands_still(const Walker& walker, const CurvePoint& from, const CurvePoint* middle,
                  const CurvePoint& to, bool seen) {
  if (seen) {
    const auto inside = middle ? std::nullopt : point_at(walker, from, 0.4 * (to.s - from.s));
    if (!middle && inside) middle = &*inside;
    return middle && same_level(walker, {&from, middle, &to});
  }
  double rate = std::max(std::abs(from.tangent.dlambda), std::abs(to.tangent.dlambda));
  if (middle) rate = std::max(rate, std::abs(middle->tangent.dlambda));
  if (rate > (to.s - from.s >= level_reach ? vertical : 1e-1 * vertical)) return false;
  const Place* at = place_at(walker.problem, *walker.memory, from.x, from.lambda, from.piece);
  if (!at) return true;
  const double noise = rate_noise(extended_matrix(at->at, walker.weights, from.tangent));
  return rate <= clear_of_rounding * noise && !widened(walker, from, to, noise);
}

/// Negative eigenvalues of dF/dx + tau tau^T: within a family tau is in the kernel of dF/dx, and this
/// counts the others.
std::optional<Index> other_negatives(const Walker& walker, const CurvePoint& p) {
  Linearisation at;
  if (!walker.problem.symmetric() || !linearise_densely(walker.problem, p.x, p.lambda, p.piece, at))
    return std::nullopt;
  const double scale = std::max(1e-300, at.dF_dx.cwiseAbs().maxCoeff());
  const auto inertia = inertia_of(at.dF_dx + scale * p.tangent.dx * p.tangent.dx.transpose());
  return inertia && inertia->zero == 0 ? std::optional<Index>(inertia->negative) : std::nullopt;
}

/// Where the trace leaves off on this step: at its end, or at a stopping event.
double last_s(const CurvePoint& to, const StepEvents& found) {
  for (std::size_t i = 0; i < found.hits.size(); ++i)
    if (found.stops[i]) return found.hits[i].point.s;
  return to.s;
}

/// Extends the family that ends at `from`, or begins one there.
void note_family(const CurvePoint& from, const CurvePoint& to, StepEvents& found, Curve& curve) {
  const double end = last_s(to, found);
  if (Hit* family = open_family(from, curve)) {
    family->s_after = end;
    return;
  }
  Hit hit{.kind = HitKind::family,
          .name = "family at one lambda",
          .point = from,
          .s_before = from.s,
          .s_after = end};
  hit.point.negative.reset();
  found.hits.insert(found.hits.begin(), std::move(hit));
  found.stops.insert(found.stops.begin(), false);
}

/// Does a kink lie at this place of the curve?
bool kink_at(const Curve& curve, double s) {
  return std::any_of(curve.hits.begin(), curve.hits.end(), [s](const Hit& hit) {
    return !hit.switches.empty() && std::abs(hit.point.s - s) < 1e-9;
  });
}

Walker without_special_points(const Walker& walker) {
  Walker plain = walker;
  plain.options.limit_points = plain.options.branch_points = false;
  return plain;
}

StepEvents family_events(const Walker& walker, const CurvePoint& from, CurvePoint& to,
                         const CurvePoint* middle, const std::vector<Event>& events, Curve& curve) {
  to.negative.reset();
  StepEvents found = events_on_step(without_special_points(walker), from, to, middle, events);
  const auto before = other_negatives(walker, from), after = other_negatives(walker, to);
  if (before && after && *before != *after) {
    found.doubt = "an eigenvalue changes its sign within a family";
    found.unexplained = static_cast<int>(std::abs(*after - *before));
  }
  note_family(from, to, found, curve);
  return found;
}

/// Special points between `from` and `to`, just before a kink at kink_s that may itself be special.
/// A search also sees what lies just beyond its own end: each one stops at a twentieth of what is left.
StepEvents special_points(const Walker& walker, const CurvePoint& from, const CurvePoint& to,
                          double kink_s, const CurvePoint* middle) {
  if (to.s >= kink_s) return events_on_step(walker, from, to, middle, {});
  StepEvents all;
  CurvePoint start = from;
  while (start.s < to.s) {
    const double left = 0.05 * (kink_s - start.s);
    auto next = left > kink_s - to.s ? point_at(walker, start, kink_s - left - start.s) : to;
    if (!next) {
      all.doubt = "the curve could not be followed up to a kink";
      return all;
    }
    StepEvents part = events_on_step(walker, start, *next, nullptr, {});
    all.hits.insert(all.hits.end(), part.hits.begin(), part.hits.end());
    all.stops.insert(all.stops.end(), part.stops.begin(), part.stops.end());
    if (all.doubt.empty() && !part.doubt.empty()) {
      all.doubt = part.doubt;
      all.unexplained = part.unexplained;
      all.passing = part.passing;
    }
    start = std::move(*next);
  }
  return all;
}

/// Adds special points in their order.
void add_special(StepEvents special, StepEvents& found) {
  for (std::size_t i = 0; i < special.hits.size(); ++i) {
    const auto after = std::find_if(found.hits.begin(), found.hits.end(), [&](const Hit& hit) {
      return hit.point.s > special.hits[i].point.s;
    });
    found.stops.insert(found.stops.begin() + (after - found.hits.begin()), special.stops[i]);
    found.hits.insert(after, std::move(special.hits[i]));
  }
  if (special.doubt.empty()) return;
  if (found.doubt.empty()) found.doubt = special.doubt;
  found.unexplained = special.unexplained;
}

/// A stretch on which the rate of lambda is lost in rounding: a fold there belongs to the kink, branches that cross do not.
void add_crossings(const Walker& walker, const CurvePoint& from, const CurvePoint& to,
                   StepEvents& found) {
  if (!(to.s > from.s)) return;
  Walker plain = walker;
  plain.options.limit_points = false;
  add_special(events_on_step(plain, from, to, nullptr, {}), found);
}

/// Special points between the bounds, branches that cross also beside them, events of the caller on the whole step.
StepEvents events_between(const Walker& walker, const CurvePoint& from, const CurvePoint& to,
                          const CurvePoint& end, const CurvePoint& begin, const CurvePoint* middle,
                          const std::vector<Event>& events, bool ends_singular) {
  StepEvents found = events_on_step(without_special_points(walker), begin, end, middle, events);
  const CurvePoint& last = ends_singular ? to : end;
  if (!(to.s > from.s)) {
    add_crossings(walker, begin, last, found);
    return found;
  }
  add_crossings(walker, begin, from, found);
  const bool inside = middle && middle->s > from.s && middle->s < to.s;
  add_special(special_points(walker, from, to, end.s, inside ? middle : nullptr), found);
  add_crossings(walker, to, last, found);
  return found;
}

/// Once where the curve begins to rest: what the pieces beside it say of stability.
void note_resting(const Walker& walker, const CurvePoint& at, const std::vector<Index>& resting,
                  std::vector<StepNote>& log) {
  StepNote note{at.s, 0, "stays on the surface of " + names_of(walker.problem, resting)};
  CurvePoint p = at;
  std::string counts;
  for (const Index j : resting) {
    auto& side = p.piece[static_cast<std::size_t>(j)];
    side = side > 0 ? -1 : 1;
    const CurvePoint other = point_on_ray(walker, p, {p.piece, p.tangent});
    if (at.negative && other.negative && *at.negative != *other.negative)
      counts += ", " + std::to_string(*other.negative) + " beyond " + walker.problem.switch_name(j);
    side = side > 0 ? -1 : 1;
  }
  if (!counts.empty())
    note.reason += "; negative eigenvalues: " + std::to_string(*at.negative) + counts;
  const bool known = std::any_of(log.begin(), log.end(),
                                 [&](const StepNote& n) { return n.reason == note.reason; });
  if (!known) log.push_back(std::move(note));
}

/// Switches of a kink that do not only rest on their surfaces before and after it.
std::vector<Index> crossed(const KinkSearch& kink, const std::vector<Index>& rested,
                           const std::vector<Ray>& ways) {
  std::vector<Index> switches;
  for (const Index j : kink.active) {
    const auto rests = [j](const std::vector<Index>& list) {
      return std::find(list.begin(), list.end(), j) != list.end();
    };
    const bool all = rests(rested) && std::all_of(ways.begin(), ways.end(), [&](const Ray& ray) {
                       return rests(ray.resting);
                     });
    if (!all) switches.push_back(j);
  }
  return switches;
}

/// @param arrived  the kink on the piece that the curve comes from
Rays ways_out(const Walker& walker, const KinkSearch& kink, CurvePoint& arrived) {
  if (kink.active.size() > most_active)
    return {.complete = false, .why = "too many switches act at one point"};
  Rays rays = rays_at(walker, arrived.x, arrived.lambda, arrived.piece, kink.active);
  take_way_back(walker, arrived, rays.rays);
  return rays;
}

/// Adds the ways out to a hit, each with what lambda does along it.
std::vector<Beside> add_leaving(const Walker& walker, const std::vector<Ray>& rays, bool together,
                                Hit& hit) {
  constexpr double any_distance = 1;
  std::vector<Beside> after;
  for (const Ray& ray : rays) {
    CurvePoint point = point_on_ray(walker, hit.point, ray);
    // Switches that act together need not be zero to rounding: back onto the piece's own curve.
    const auto corrected = together ? point_at(walker, point, 0) : std::nullopt;
    if (corrected) {
      point.x = corrected->x;
      point.lambda = corrected->lambda;
    }
    after.push_back(beside(walker, point, 1, any_distance));
    if (after.back().moved) point.negative = after.back().point.negative;
    if (after.back().sense == 0) point.negative.reset();
    hit.leaving.push_back(std::move(point));
  }
  return after;
}

/// Why the trace ends at this kink, if it does; labels the hit.
std::optional<StopReason> dead_end(const KinkSearch& kink, const Rays& rays, Hit& hit) {
  if (hit.leaving.empty() && kink.active.size() <= most_active) return StopReason::no_way_out;
  if (!rays.complete) {
    hit.kind = HitKind::unresolved;
    hit.name = "unresolved kink: " + hit.name + ": " + rays.why;
    return StopReason::several_ways;
  }
  if (hit.leaving.size() == 1) return std::nullopt;
  hit.kind = HitKind::branching_kink;
  return StopReason::several_ways;
}

}  // namespace

std::string names_of(ProblemView problem, const std::vector<Index>& switches) {
  std::string names;
  for (const Index j : switches) names += (names.empty() ? "" : ", ") + problem.switch_name(j);
  return names;
}

CurvePoint point_on_ray(const Walker& walker, const CurvePoint& at, const Ray& ray) {
  CurvePoint point = at;
  point.tangent = ray.tangent;
  point.piece = ray.piece;
  point.negative.reset();
  Linearisation linear;
  if (walker.problem.symmetric() && linearise(walker.problem, at.x, at.lambda, ray.piece, linear))
    point.negative = negative_eigenvalues(linear);
  return point;
}

Outcome pass_kink(const Walker& walker, const KinkSearch& kink, Progress& progress, Curve& curve) {
  Hit hit{.kind = HitKind::kink,
          .point = kink.point,
          .s_before = progress.here.s + kink.before,
          .s_after = progress.here.s + kink.after};
  const Rays rays = ways_out(walker, kink, hit.point);
  hit.switches = crossed(kink, resting_switches(walker, progress.here, kink.point), rays.rays);
  hit.name = names_of(walker.problem, hit.switches);
  const Beside before = beside(walker, hit.point, -1, hit.point.s - progress.here.s);
  if (before.moved) hit.point.negative = before.point.negative;
  if (before.sense == 0) hit.point.negative.reset();
  const std::vector<Beside> after = add_leaving(walker, rays.rays, kink.active.size() > 1, hit);
  if (const auto reason = dead_end(kink, rays, hit)) {
    curve.stop = *reason;
    curve.stop_detail = *reason == StopReason::no_way_out ? "no way out at " + hit.name
                        : hit.kind == HitKind::unresolved
                            ? hit.name
                            : std::to_string(hit.leaving.size()) + " ways out at " + hit.name;
    if (*reason == StopReason::no_way_out && !rays.complete) curve.stop_detail += ": " + rays.why;
    curve.hits.push_back(std::move(hit));
    return Outcome::stop;
  }
  const int arrived = before.sense != 0               ? before.sense
                      : told_from_zero(progress.here) ? sense_of(progress.here)
                                                      : progress.sense;
  const Beside& next = after.front();
  if (arrived * next.sense < 0) hit.kind = HitKind::corner;
  progress.sense = next.sense != 0 ? next.sense : arrived;
  progress.flat = next.sense == 0;
  progress.clear_of = next.moved ? next.point.s : -1;
  progress.here = hit.leaving.front();
  progress.left = kink.active;
  progress.ds = walker.options.step.initial;  // another curve begins
  curve.hits.push_back(std::move(hit));
  return Outcome::go_on;
}

void settle_families(Curve& curve) {
  constexpr double certain = 0.1;  // longer than any inflection stays flat to rounding
  for (Hit& hit : curve.hits) {
    if (hit.kind != HitKind::family || hit.s_after - hit.s_before >= certain) continue;
    if (kink_at(curve, hit.s_before) || kink_at(curve, hit.s_after)) continue;
    hit.kind = HitKind::unresolved;
    hit.name = "unresolved: lambda stands still to rounding, it may turn here several times";
  }
}

StepEvents passage_events(const Walker& walker, const Progress& progress, const KinkSearch& kink,
                          CurvePoint& end, const CurvePoint* middle,
                          const std::vector<Event>& events, Curve& curve) {
  const CurvePoint& begin = progress.here;
  const double length = end.s - begin.s;
  const bool inside = middle && middle->s < end.s;
  for (const Index j : kink.touched)
    curve.log.push_back(
        {begin.s, length, walker.problem.switch_name(j) + " is touched, not crossed"});
  const bool seen = progress.flat || open_family(begin, curve) != nullptr;
  if (stands_still(walker, begin, inside ? middle : nullptr, end, seen))
    return family_events(walker, begin, end, middle, events, curve);
  std::optional<Beside> from, to;  // where they are not the ends of the step
  if (progress.clear_of > begin.s) {
    const auto clear = point_at(walker, begin, std::min(progress.clear_of - begin.s, length));
    from = Beside{clear ? *clear : end, 0, true};
  }
  if (kink.status == KinkSearch::Status::found) {
    to = kink.singular ? before_singular(walker, end, length) : beside(walker, end, -1, length);
    if (to->sense == 0) to = Beside{begin, 0, true};  // too flat and short for anything
  }
  const CurvePoint &first = from ? from->point : begin, &last = to ? to->point : end;
  StepEvents found = from || (to && to->moved) ? events_between(walker, first, last, end, begin,
                                                                middle, events, kink.singular)
                                               : events_on_step(walker, begin, end, middle, events);
  const std::vector<Index> resting = resting_switches(walker, begin, end);
  if (resting.empty()) return found;
  if (!progress.left.empty()) note_resting(walker, begin, resting, curve.log);
  add_half_branches(walker, StepSamples(first, inside ? middle : nullptr, last), resting, found,
                    curve);
  return found;
}

}  // namespace springfold::continuation
