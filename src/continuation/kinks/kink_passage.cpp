#include "continuation/kinks/kink_passage.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "continuation/kinks/beside.hpp"
#include "continuation/kinks/kink.hpp"
#include "continuation/locating/bordered_test.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/locate.hpp"
#include "continuation/points/words.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/equilibration.hpp"
#include "springfold/core/extended_matrix.hpp"

namespace springfold::continuation {
namespace {

/// The ray along which the curve arrived. At a branch point of the arriving piece its tangent is known only
/// roughly: then that of the ray is taken.
void take_way_back(const Walker& walker, CurvePoint& arrived, std::vector<Ray>& rays) {
  const Direction back = opposite(arrived.tangent);
  const auto off = [&](const Ray& ray) {
    return differ_only(ray.piece, arrived.piece, ray.resting)
               ? 1 - metric_product(walker.weights, ray.tangent, back)
               : infinity;
  };
  const auto best = std::min_element(rays.begin(), rays.end(),
                                     [&](const Ray& a, const Ray& b) { return off(a) < off(b); });
  if (best == rays.end()) return;
  const bool singular = best->start.has_value();
  if (!(singular ? off(*best) <= nearly_same_line
                 : length_of(walker, difference(best->tangent, back)) <= one_direction))
    return;
  if (singular) arrived.tangent = opposite(best->tangent);
  rays.erase(best);
}

/// Does a kink lie at this place of the curve?
bool kink_at(const Curve& curve, double s) {
  return std::any_of(curve.hits.begin(), curve.hits.end(), [s](const Hit& hit) {
    return !hit.switches.empty() && std::abs(hit.point.s - s) < one_place;
  });
}

/// Switches of a kink that do not only rest on their surfaces before and after it.
std::vector<Index> crossed(const KinkSearch& kink, const std::vector<Index>& rested,
                           const std::vector<Ray>& ways) {
  std::vector<Index> switches;
  for (const Index j : kink.active) {
    const auto rests_on = [j](const Ray& ray) { return contains(ray.resting, j); };
    if (!contains(rested, j) || !std::all_of(ways.begin(), ways.end(), rests_on))
      switches.push_back(j);
  }
  return switches;
}

/// @param arrived  the kink on the piece that the curve comes from
Rays ways_out(const Walker& walker, const KinkSearch& kink, CurvePoint& arrived) {
  if (kink.active.size() > most_active)
    return {.complete = false, .why = too_many_act(kink.active.size())};
  const Direction along = arrived.tangent;
  Rays rays =
      rays_around(walker, arrived, kink.active, one_place, kink.singular ? nullptr : &along);
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

/// Where one switch acts, its pieces differ by a multiple of dg: (dg . tau) det E is the same before and after, with
/// E = | dF/dx dF/dlambda ; tau |. So lambda turns where the sign of det dF/dx changes, and only there.
/// @returns false where what was seen of lambda and of the eigenvalues contradict each other
bool fits(const KinkSearch& kink, const Hit& hit, int before, int after) {
  const std::optional<Index>&first = hit.point.negative, &last = hit.leaving.front().negative;
  if (kink.active.size() != 1 || before * after == 0 || !first || !last) return true;
  return (before != after) == (std::abs(*last - *first) % 2 == 1);
}

/// Not where dF/dx vanishes but for what rounding of lambda makes of it, as on a family in a bent coordinate.
bool is_surely_counted(const Walker& walker, const CurvePoint& p) {
  if (!p.negative) return false;
  const double off = few_roundings * std::max(1.0, std::abs(p.lambda));
  for (const double side : {-1.0, 0.0, 1.0}) {
    Linearisation at;
    if (!linearise_densely(walker.problem, p.x, p.lambda + side * off, p.piece, at) ||
        corank(at.dF_dx) > 0 || negative_eigenvalues(at) != p.negative)
      return false;
  }
  return true;
}

/// Does lambda turn at a kink beside which it seems to stand still, as the identity of fits() has it? In a large unit
/// of lambda soft pieces look level; the numbers of negative eigenvalues are as sure as ever, where dF/dx is regular.
std::optional<bool> turns_by_counts(const Walker& walker, const KinkSearch& kink,
                                    const std::vector<Ray>& rays) {
  if (kink.active.size() != 1 || kink.singular || rays.size() != 1 || walker.problem.structured() ||
      !walker.problem.symmetric())
    return std::nullopt;
  const CurvePoint before =
                       point_on_ray(walker, kink.point, {kink.point.piece, kink.point.tangent}),
                   after = point_on_ray(walker, kink.point, rays.front());
  if (!is_surely_counted(walker, before) || !is_surely_counted(walker, after)) return std::nullopt;
  return std::abs(*after.negative - *before.negative) % 2 == 1;
}

/// Sign of the determinant of E, as in fits(), for the curve of a piece at its point; 0 where that is singular.
int sense_of_piece(const Walker& walker, const CurvePoint& p) {
  Linearisation at;
  if (!linearise_densely(walker.problem, p.x, p.lambda, p.piece, at)) return 0;
  const ExtendedMatrix E = extended_matrix(at, walker.weights, p.tangent);
  if (is_singular(E, located_rank)) return 0;
  return Lu(E.dense).sign();
}

/// Along a curve on which a switch rests run those of the two pieces beside it. Where they pass in opposite senses they
/// are the two halves of one curve: displaced by next to nothing it comes along one of them and goes back along the
/// other, or along each of them and on, once for each. So there are two ways on, or none.
bool may_turn_upon_itself(const Walker& walker, const CurvePoint& arrived,
                          const std::vector<Index>& resting) {
  if (resting.size() != 1 || walker.problem.structured()) return false;
  return sense_of_piece(walker, arrived) * sense_of_piece(walker, behind(arrived, resting)) < 0;
}

/// Why the trace ends at this kink, if it does; labels the hit.
/// @param resting  switches that rest along the curve that arrives
std::optional<StopReason> dead_end(const Walker& walker, const KinkSearch& kink,
                                   const std::vector<Index>& resting, const Rays& rays, Hit& hit) {
  if (hit.leaving.empty() && kink.active.size() <= most_active)
    return rays.complete &&
                   std::ranges::all_of(resting,
                                       [&](Index j) { return contains(kink.active, j); }) &&
                   may_turn_upon_itself(walker, hit.point, resting)
               ? StopReason::turns_upon_itself
               : StopReason::no_way_out;
  if (!rays.complete) {
    hit.kind = HitKind::unresolved;
    hit.name = "unresolved kink: " + hit.name + ": " + rays.why;
    return StopReason::several_ways;
  }
  if (hit.leaving.size() == 1) return std::nullopt;
  hit.kind = HitKind::branching_kink;
  return StopReason::several_ways;
}

std::string why_it_ends(StopReason reason, const Rays& rays, const Hit& hit) {
  if (reason == StopReason::turns_upon_itself)
    return "at " + hit.name + "; what rests along it allows two ways on or none, and here none";
  if (reason == StopReason::no_way_out)
    return "no way out at " + hit.name + (rays.complete ? "" : ": " + rays.why);
  return hit.kind == HitKind::unresolved
             ? hit.name
             : std::to_string(hit.leaving.size()) + " ways out at " + hit.name;
}

}  // namespace

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

Outcome pass_kink(const Walker& walker, const KinkSearch& kink, Progress& progress, Curve& curve,
                  const Beside* arriving) {
  Hit hit{.kind = HitKind::kink,
          .point = kink.point,
          .s_before = progress.here.s + kink.before,
          .s_after = progress.here.s + kink.after};
  const Rays rays = ways_out(walker, kink, hit.point);
  const std::vector<Index> resting = resting_switches(walker, progress.here, kink.point);
  hit.switches = crossed(kink, resting, rays.rays);
  hit.name = names_of(walker.problem, hit.switches);
  // Along a family lambda stands still, whatever rounding makes of its rate.
  const bool ends_family = open_family(hit.point, curve) != nullptr;
  const Beside before = arriving ? *arriving
                        : ends_family
                            ? Beside{hit.point, 0}
                            : beside(walker, hit.point, -1, hit.point.s - progress.here.s);
  if (before.moved) hit.point.negative = before.point.negative;
  if (before.sense == 0) hit.point.negative.reset();
  const std::vector<Beside> after = add_leaving(walker, rays.rays, kink.active.size() > 1, hit);
  if (const auto reason = dead_end(walker, kink, resting, rays, hit)) {
    curve.stop = *reason;
    curve.stop_detail = why_it_ends(*reason, rays, hit);
    hit.stops = true;
    curve.hits.push_back(std::move(hit));
    return Outcome::stop;
  }
  const bool has_sense = !ends_family && told_from_zero(progress.here);
  const int arrived = before.sense != 0 ? before.sense
                      : has_sense       ? sense_of(progress.here)
                                        : progress.sense;
  const Beside& next = after.front();
  const auto turns = before.sense * next.sense == 0 ? turns_by_counts(walker, kink, rays.rays)
                                                    : std::optional<bool>{};
  if (turns.value_or(arrived * next.sense < 0)) hit.kind = HitKind::corner;
  progress.sense = next.sense != 0 ? next.sense : turns.value_or(false) ? -arrived : arrived;
  progress.flat = next.sense == 0 && !turns;
  progress.clear_of = next.moved ? next.point.s : -1;
  progress.here = hit.leaving.front();
  progress.left = kink.active;
  progress.ds = walker.options.step.initial;  // another curve begins
  if (!fits(kink, hit, before.sense, next.sense)) {
    Hit doubt = hit;
    doubt.kind = HitKind::unresolved;
    doubt.name = "unresolved: number of negative eigenvalues beside " + hit.name +
                 " and the turn of lambda do not fit together";
    curve.hits.push_back(std::move(doubt));
  }
  curve.hits.push_back(std::move(hit));
  return Outcome::go_on;
}

void settle_families(Curve& curve) {
  constexpr double certain = 10 * level_reach;  // longer than any inflection stays flat to rounding
  for (Hit& hit : curve.hits) {
    if (hit.kind != HitKind::family || hit.s_after - hit.s_before >= certain) continue;
    if (kink_at(curve, hit.s_before) || kink_at(curve, hit.s_after)) continue;
    hit.kind = HitKind::unresolved;
    hit.name = "unresolved: lambda stands still to rounding, it may turn here several times";
  }
}

}  // namespace springfold::continuation
