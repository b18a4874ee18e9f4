#include "springfold/continuation/trace.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "continuation/following/keep_hits.hpp"
#include "continuation/following/many_points.hpp"
#include "continuation/following/narrow_places.hpp"
#include "continuation/following/own_branch.hpp"
#include "continuation/kinks/kink_passage.hpp"
#include "continuation/locating/cluster.hpp"
#include "continuation/locating/events.hpp"
#include "continuation/locating/evidence.hpp"
#include "continuation/locating/unexplained.hpp"
#include "continuation/locating/watched_step.hpp"
#include "continuation/numerics/numerics.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/entry_checks.hpp"
#include "continuation/points/normalised.hpp"
#include "continuation/points/samples.hpp"
#include "continuation/points/working_memory.hpp"
#include "springfold/continuation/verification.hpp"

namespace springfold::continuation {
namespace {

/// Share of the anchor's step: a cluster is not crossed from nearer to it.
constexpr double near_cluster = 0.2;

/// Where special points made a step too long first: from there a cluster of them is crossed.
struct Anchor {
  Progress before{};
  std::size_t points = 0, hits = 0;
  bool set = false, tried = false;
  bool passing = false;  ///< branches pass each other there: nothing is crossed in one step
};

/// Crosses a cluster of special points in one step from `before.here`, looking for the caller's events only.
bool cross_from(const Walker& walker, const std::vector<Event>& events, const Progress& before,
                double ds, Progress& progress, Curve& curve) {
  Walker plain = walker;
  plain.options.limit_points = plain.options.branch_points = false;
  const CurvePoint& from = before.here;
  const StepResult step = try_step(walker, from, ds);
  if (!step.point) return false;
  const Evidence evidence = examine(walker, from, *step.point);
  if (!evidence.doubt.empty() || !step.point->negative != !from.negative) return false;
  if (start_again(walker, curve.points.front(), from, *step.point)) return false;
  if (first_kink(walker, from, *step.point, {}).status != KinkSearch::Status::none) return false;
  auto cluster = cluster_on_step(walker, StepSamples(from, &*evidence.middle, *step.point));
  if (!cluster) return false;
  const StepEvents wanted = events_on_step(plain, from, *step.point, &*evidence.middle, events);
  if (!wanted.hits.empty() || !wanted.doubt.empty()) return false;
  std::erase_if(curve.points, [&](const CurvePoint& p) { return p.s > from.s; });
  curve.log.push_back({from.s, ds, "crosses a cluster of special points in one step"});
  curve.hits.push_back(std::move(*cluster));
  curve.points.push_back(*step.point);
  progress = before;
  progress.here = *step.point;
  progress.ds = next_step_length(ds, step.measures, walker.options.step);
  return true;
}

/// Crosses a cluster in one step from the anchor, or from a point between them that is not too near to it.
bool cross_cluster(const Walker& walker, const std::vector<Event>& events, Anchor& anchor,
                   Progress& progress, Curve& curve) {
  anchor.tried = true;
  if (anchor.passing || curve.hits.size() != anchor.hits || !anchor.before.left.empty())
    return false;
  const double reached = progress.here.s;
  for (std::size_t i = anchor.points; i <= curve.points.size(); ++i) {
    Progress before = anchor.before;
    before.here = curve.points[i - 1];
    if (i > anchor.points && reached - before.here.s < near_cluster * anchor.before.ds) break;
    for (const double share : {1.0, 0.6, 0.35})
      if (cross_from(walker, events, before, share * anchor.before.ds, progress, curve))
        return true;
  }
  return false;
}

/// What became of a step that was refused.
struct Refusal {
  std::string reason{};
  bool special = false;  ///< because of special points on it
  bool passing = false;  ///< because branches pass each other on it
  bool astray = false;   ///< because it does not continue the step before
};

/// Special points behind the place at which a curve closes were met at its start, one at this place now.
void end_at(const CurvePoint& start, StepEvents& found) {
  constexpr double same_place = same_point;
  for (std::size_t i = found.hits.size(); i-- > 0;) {
    if (found.hits[i].point.s <= start.s + same_place) continue;
    found.hits.erase(found.hits.begin() + static_cast<std::ptrdiff_t>(i));
    found.stops.erase(found.stops.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

/// The middle of the last step, where it is known.
const CurvePoint* middle_behind(const Progress& progress) {
  const CurvePoint &inside = progress.middle, &here = progress.here;
  const bool known = inside.s > progress.before.s && inside.s < here.s;
  return known && inside.piece == here.piece ? &inside : nullptr;
}

/// The last accepted step as a model of the curve: the next one must continue it, not just satisfy F.
/// @returns nullptr where the curve begins, or begins again at a kink
const ArcModel* model_behind(const Walker& walker, const Progress& progress, const Curve& curve) {
  const CurvePoint &here = progress.here, &before = progress.before;
  if (curve.points.size() < 2 || curve.points.back().s != here.s) return nullptr;
  if (!(before.s < here.s) || before.piece != here.piece || before.x.size() != here.x.size())
    return nullptr;
  const StepSamples samples(before, middle_behind(progress), here);
  ArcModel& arc = walker.memory->behind;
  return arc.go_through(walker.weights, here, samples) ? &arc : nullptr;
}

/// Does the step still lie beside the junction that the curve left where its piece is singular? There the curve is that of
/// the junction's reduced equation: special points nearer to it than `told_apart` belong to it, and eigenvalues that vanish
/// in it are lost in their rounding. A spring that switches soon leaves no longer steps.
bool beside_junction(const Progress& progress, const CurvePoint& end) {
  return progress.from_singular && end.s <= told_apart;
}

/// Nothing is told of the number of negative eigenvalues on this stretch: the counts may differ from point to point.
void accept_beside_junction(double ds, StepEvents& found, Progress& progress, Curve& curve) {
  curve.log.push_back({curve.points.back().s, ds, "beside the junction: " + found.doubt});
  found.doubt.clear();
  found.unexplained = 0;
  found.flat = found.passing = false;
  progress.blurred = true;
  for (CurvePoint& point : curve.points) point.negative.reset();
}

/// One step: predict, correct, look for switching surfaces and events, record.
/// @param report  special points that cannot be told apart are reported on the shortest steps
Outcome advance(const Walker& walker, const std::vector<Event>& events, const HitObserver& at_hit,
                bool report, Progress& progress, Curve& curve, Refusal& refused) {
  std::string& refusal = refused.reason;
  CurvePoint &next = walker.memory->next, &half_way = walker.memory->middle;
  StepMeasures measures;
  const ArcModel *const behind = model_behind(walker, progress, curve), *model = behind;
  if (model && !try_step(walker, progress.here, progress.ds, model, next, measures, refusal))
    model = nullptr;
  if (!model && (!try_step(walker, progress.here, progress.ds, nullptr, next, measures, refusal) ||
                 may_be_another(walker, next, progress.ds, refusal)))
    return Outcome::shorten;
  const CurvePoint* middle = nullptr;
  if (walker.options.verify) {
    examine(walker, model, progress.here, next, half_way, refusal);
    if (!refusal.empty()) return Outcome::shorten;
    middle = &half_way;
    const CurvePoint* known = middle_behind(progress);
    if (behind && !leads_on(walker, *behind, known ? *known : progress.before, progress.here,
                            half_way, next)) {
      refusal = "the end is not where the curve leads: another branch may be near";
      refused.astray = true;
      return Outcome::shorten;
    }
  }
  KinkSearch kink = first_kink(walker, progress.here, next, progress.left);
  if (kink.status == KinkSearch::Status::suspicious) {
    refusal = "close to " + (kink.suspect >= 0 ? walker.problem.switch_name(kink.suspect)
                                               : std::string("a switching surface"));
    return Outcome::shorten;
  }
  const auto start = start_again(walker, curve.points.front(), progress.here, next);
  const bool meets_kink = kink.status == KinkSearch::Status::found;
  const bool closed = start && !(meets_kink && kink.point.s < start->s);
  CurvePoint& end = meets_kink ? kink.point : next;
  if (closed) kink.status = KinkSearch::Status::none;
  const bool cut = meets_kink && !closed;
  StepEvents found = passage_events(walker, progress, kink, end, middle, events, curve);
  if (closed) end_at(*start, found);
  if (!found.doubt.empty() && !found.of_caller && beside_junction(progress, end))
    accept_beside_junction(progress.ds, found, progress, curve);
  if (progress.blurred && beside_junction(progress, end)) end.negative.reset();
  if (!found.doubt.empty()) {
    refusal = found.doubt;
    refused.special = true;
    refused.passing = found.passing;
    const bool shortest = progress.ds <= unresolved_length && report && !found.passing;
    if (!shortest && !found.flat) return Outcome::shorten;
    add_unresolved(progress.here, end, found, curve);
  }
  if (keep(walker, StepSamples(progress.here, middle && middle->s < end.s ? middle : nullptr, end),
           at_hit, found, curve))
    return Outcome::stop;
  if (cut) {
    curve.log.push_back({progress.here.s, kink.point.s - progress.here.s,
                         "cut: " + names_of(walker.problem, kink.active)});
    return pass_kink(walker, kink, progress, curve);
  }
  std::swap(progress.before, progress.here);
  if (closed)
    progress.here = *start;
  else
    std::swap(progress.here, next);
  if (middle) std::swap(progress.middle, half_way);
  progress.left.clear();
  curve.points.push_back(progress.here);
  account_over_gap(curve);
  if (closed) {
    curve.stop = StopReason::closed;
    return Outcome::stop;
  }
  // Past something unresolved the next step gets away from it.
  progress.ds = found.doubt.empty() || found.flat
                    ? next_step_length(progress.ds, measures, walker.options.step)
                    : std::min(100 * unresolved_length, walker.options.step.maximum);
  return Outcome::go_on;
}

/// One step from a kept point, `times` as long as the anchor's, which must resolve everything on it.
std::optional<Outcome> step_over_from(const Walker& walker, const std::vector<Event>& events,
                                      const HitObserver& at_hit, const Anchor& anchor,
                                      std::size_t points, double times, Progress& progress,
                                      Curve& curve) {
  Progress longer = anchor.before;
  longer.here = curve.points[points - 1];
  longer.ds *= times;
  if (longer.ds > walker.options.step.maximum) return std::nullopt;
  const double begin = longer.here.s;
  Curve trial = curve;
  trial.points.resize(points);
  Refusal refused;
  const Outcome outcome = advance(walker, events, at_hit, false, longer, trial, refused);
  if (outcome == Outcome::shorten) return std::nullopt;
  trial.log.push_back({begin, times * anchor.before.ds,
                       "steps over special points that shorter steps do not resolve"});
  curve = std::move(trial);
  progress = std::move(longer);
  return outcome;
}

/// On steps on which rounding hides the special points nothing can be told of them: longer ones are tried.
std::optional<Outcome> step_over(const Walker& walker, const std::vector<Event>& events,
                                 const HitObserver& at_hit, const Anchor& anchor,
                                 Progress& progress, Curve& curve) {
  if (anchor.tried || anchor.passing || curve.hits.size() != anchor.hits ||
      !anchor.before.left.empty())
    return std::nullopt;
  const double reached = progress.here.s;
  const std::size_t last = curve.points.size();
  for (const auto& lengths : {std::array{4.0, 2.0, 1.0}, std::array{32.0, 16.0, 8.0}})
    for (std::size_t i = anchor.points; i <= last; ++i) {
      const double away = reached - curve.points[i - 1].s;
      if (i > anchor.points && away < near_cluster * anchor.before.ds) break;
      for (const double times : lengths)
        if (const auto outcome =
                step_over_from(walker, events, at_hit, anchor, i, times, progress, curve))
          return outcome;
    }
  return std::nullopt;
}

/// Points among unresolved special points, reached on steps too short to tell, may lie on any branch.
void forget_last_crawl(const Anchor& anchor, Curve& curve) {
  constexpr double crawl = 100 * unresolved_length;
  const auto length_of_last = [&] {
    return curve.points.back().s - curve.points[curve.points.size() - 2].s;
  };
  while (anchor.set && curve.points.size() > std::max<std::size_t>(anchor.points, 1) &&
         length_of_last() < crawl)
    curve.points.pop_back();
  for (Hit& hit : curve.hits)
    if (hit.kind == HitKind::family) hit.s_after = std::min(hit.s_after, curve.points.back().s);
}

/// Where no step continues the last one, one of the two lies on another branch: which one is not known.
void forget_last_step(double astray_at, Curve& curve) {
  if (curve.points.size() > 1 && curve.points.back().s == astray_at &&
      (curve.hits.empty() || curve.hits.back().point.s < astray_at))
    curve.points.pop_back();
}

/// The main loop: steps until something ends the curve.
void follow(const Walker& walker, const std::vector<Event>& events, const StepObserver& observer,
            const HitObserver& at_hit, Progress& progress, Curve& curve) {
  constexpr double level = flat_rate;
  curve.stop = StopReason::max_points;
  Anchor anchor;
  double astray_at = -1;
  while (static_cast<int>(curve.points.size()) < walker.options.maximum_points) {
    if (anchor.set && (curve.hits.size() != anchor.hits ||
                       progress.here.s > anchor.before.here.s + anchor.before.ds))
      anchor = {};
    Refusal refused;
    // Where lambda stands still, short steps are as good as long ones; elsewhere they would be led by rounding.
    const bool report = std::abs(progress.here.tangent.dlambda) <= level;
    Outcome outcome = advance(walker, events, at_hit, report, progress, curve, refused);
    if (outcome == Outcome::stop) return;
    if (outcome == Outcome::shorten) {
      curve.log.push_back({progress.here.s, progress.ds, refused.reason});
      if (refused.special && !anchor.set)
        anchor = {progress, curve.points.size(), curve.hits.size(), true, false, false};
      anchor.passing = anchor.passing || refused.passing;
      if (refused.astray) astray_at = progress.here.s;
      progress.ds *= 0.5;
      const bool last = progress.ds < unresolved_length && anchor.set && !anchor.tried;
      const auto over =
          last ? step_over(walker, events, at_hit, anchor, progress, curve) : std::nullopt;
      if (over && *over == Outcome::stop) return;
      if (over || (last && cross_cluster(walker, events, anchor, progress, curve)))
        outcome = Outcome::go_on;
      else if (progress.ds >= walker.options.step.minimum)
        continue;
    }
    if (outcome == Outcome::shorten) {
      curve.stop = StopReason::step_too_small;
      curve.stop_detail = refused.reason;
      forget_last_step(astray_at, curve);
      forget_last_crawl(anchor, curve);
      return;
    }
    if (observer && !observer(progress.here)) {
      curve.stop = StopReason::observer;
      return;
    }
  }
  curve.stop_detail = why_so_many(walker, curve);
}

}  // namespace

Rays rays_from(ProblemView problem, const Vector& x, double lambda, const Piece& piece,
               const TraceOptions& options) {
  check_entry(problem, x, lambda, piece, options);
  const Normalised own(problem, x, lambda, piece);
  const Walker walker{own, own.metric(), options};
  const Vector y = own.inside(x);
  const std::vector<Index> active = active_switches(walker, y, lambda);
  if (active.size() > 12)
    return {.complete = false, .why = "too many switches act at the start point"};
  Rays result = rays_at(walker, y, lambda, piece, active);
  for (Ray& ray : result.rays) ray = own.outside(ray);
  return result;
}

Curve trace(ProblemView problem, const Vector& x, double lambda, const Ray& start,
            const std::vector<Event>& events, const TraceOptions& options,
            const StepObserver& observer, const HitObserver& at_hit) {
  check_entry(problem, x, lambda, start.piece, options);
  check_ray(problem, start);
  const Normalised own(problem, x, lambda, start.piece);
  return own.outside(trace_in_own_units(own, own.inside(x), lambda, own.inside(start),
                                        own.inside(events), options, own.inside(observer),
                                        own.inside(at_hit)));
}

Curve trace_in_own_units(ProblemView problem, const Vector& x, double lambda, const Ray& start,
                         const std::vector<Event>& events, const TraceOptions& options,
                         const StepObserver& observer, const HitObserver& at_hit) {
  const Walker walker{problem, problem.metric(), options};
  const CurvePoint first{.x = x, .lambda = lambda};
  Progress progress;
  progress.here = point_on_ray(walker, first, start);
  progress.left = active_switches(walker, x, lambda);
  progress.ds = options.step.initial;
  Curve curve{.points = {progress.here}};
  const auto opening =
      start.beyond ? opening_of(walker, progress.here, *start.beyond) : std::nullopt;
  bool ended = false;
  if (opening) {
    progress.from_singular = true;
    ended = pass_opening(walker, events, at_hit, *opening, progress, curve) == Outcome::stop;
  } else if (start.start) {
    // The piece may be singular at the point itself, and the next surface as near as the way's first point.
    progress.from_singular = true;
    progress.ds = std::clamp(start.start->s, options.step.minimum, options.step.initial);
    if (start.start->x != x || start.start->lambda != lambda) {
      progress.here = *start.start;
      progress.left.clear();
      curve.points.push_back(progress.here);
    }
  }

  if (!ended) follow(walker, events, observer, at_hit, progress, curve);
  settle_families(curve);
  check_narrow_places(walker, curve);
  // A curve that was asked to end is handed over at once.
  if (options.verify_arcs && curve.stop == StopReason::observer)
    curve.arcs = {{.s_begin = curve.points.front().s, .s_end = curve.points.back().s}};
  else if (options.verify_arcs)
    curve.arcs = verified_arcs(problem, curve, options);
  return curve;
}

}  // namespace springfold::continuation
