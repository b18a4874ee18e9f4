#include "continuation/following/wider_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "continuation/following/keep_hits.hpp"
#include "continuation/locating/cluster.hpp"
#include "continuation/locating/evidence.hpp"
#include "continuation/points/coincide.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {
namespace {

/// A curve on which steps end elsewhere more often than this is crowded all along: shorter steps, which are counted,
/// lead on.
constexpr int most_elsewhere = 200;
/// Share of the anchor's step: a cluster is not crossed from nearer to it.
constexpr double near_cluster = aside_share;

/// Crosses a cluster of special points in one step from `before.here`, looking for the caller's events only.
bool cross_from(const Following& following, const Progress& before, double ds, Progress& progress,
                Curve& curve) {
  const Walker& walker = following.walker;
  const CurvePoint& from = before.here;
  const StepResult step = try_step(walker, from, ds);
  if (!step.point) return false;
  const Evidence evidence = examine(walker, from, *step.point);
  if (!evidence.doubt.empty() || !step.point->negative != !from.negative) return false;
  if (start_again(walker, curve.points.front(), from, *step.point)) return false;
  if (first_kink(walker, from, *step.point, {}).status != KinkSearch::Status::none) return false;
  auto cluster = cluster_on_step(walker, StepSamples(from, &*evidence.middle, *step.point));
  if (!cluster) return false;
  const StepEvents wanted = events_on_step(without_special_points(walker), from, *step.point,
                                           &*evidence.middle, following.events);
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
bool cross_cluster(const Following& following, Anchor& anchor, Progress& progress, Curve& curve) {
  const double reached = progress.here.s;
  for (std::size_t i = anchor.at.points; i <= curve.points.size(); ++i) {
    Progress before = anchor.at.before;
    before.here = curve.points[i - 1];
    if (i > anchor.at.points && reached - before.here.s < near_cluster * anchor.at.before.ds) break;
    for (const double share : {1.0, 0.6, 0.35})
      if (cross_from(following, before, share * anchor.at.before.ds, progress, curve)) return true;
  }
  return false;
}

/// Does a step from a kept point, `times` as long as the refused one, end behind what has been reached?
bool leads_beyond(double reached, const RefusedStep& anchor, const Curve& curve, std::size_t points,
                  double times) {
  return curve.points[points - 1].s + times * anchor.before.ds > reached;
}

/// One step from a kept point, `times` as long as the refused one, which must resolve everything on it.
/// @param find  it must find something: otherwise it only ends nearer to what the others could not tell
std::optional<Outcome> step_over_from(const Following& following, const RefusedStep& anchor,
                                      std::size_t points, double times, bool find,
                                      Progress& progress, Curve& curve) {
  Progress longer = anchor.before;
  longer.here = curve.points[points - 1];
  if (points < anchor.points) longer.before = curve.points[points < 2 ? 0 : points - 2];
  if (longer.here.piece != anchor.before.here.piece) return std::nullopt;
  longer.ds *= times;
  if (longer.ds > following.walker.options.step.maximum) return std::nullopt;
  const double begin = longer.here.s;
  Curve trial = curve;
  trial.points.resize(points);
  Refusal refused;
  const Outcome outcome = advance(following, false, longer, trial, refused);
  if (outcome == Outcome::shorten || (find && trial.hits.size() == curve.hits.size()))
    return std::nullopt;
  trial.log.push_back({begin, times * anchor.before.ds,
                       "steps over special points that shorter steps do not resolve"});
  curve = std::move(trial);
  progress = std::move(longer);
  return outcome;
}

/// Shorter steps end nearer to a special point and tell less of it: steps of about the length that was refused first,
/// which end elsewhere, are tried before shorter ones; then, once, a step that begins farther from it.
std::optional<Outcome> step_of_like_length(const Following& following, Anchor& anchor,
                                           Progress& progress, Curve& curve) {
  const auto times = [](int power) { return std::pow(1.25, power); };
  ++anchor.elsewhere;
  const double reached = progress.here.s;
  const std::size_t last = curve.points.size();
  const auto from = [&](std::size_t points, int power) {
    return step_over_from(following, anchor.at, points, times(power), true, progress, curve);
  };
  for (const int power : {0, -1, 1, -2, 2, 3})
    for (std::size_t i = anchor.at.points; i <= last; ++i)
      if (leads_beyond(reached, anchor.at, curve, i, times(power)))
        if (const auto outcome = from(i, power)) return outcome;
  const bool farther =
      anchor.at.points > 1 && reached > anchor.back_from &&
      (curve.hits.empty() || curve.hits.back().point.s < curve.points[anchor.at.points - 2].s);
  if (!farther) return std::nullopt;
  for (const int power : {2, 1})
    if (const auto outcome = from(anchor.at.points - 1, power)) {
      anchor.back_from = reached + anchor.at.before.ds;
      return outcome;
    }
  return std::nullopt;
}

/// On steps on which rounding hides the special points nothing can be told of them: longer ones are tried.
std::optional<Outcome> step_over(const Following& following, const RefusedStep& anchor,
                                 Progress& progress, Curve& curve) {
  const double reached = progress.here.s;
  const std::size_t last = curve.points.size();
  for (const auto& lengths : {std::array{4.0, 2.0, 1.0}, std::array{32.0, 16.0, 8.0}})
    for (std::size_t i = anchor.points; i <= last; ++i) {
      const double away = reached - curve.points[i - 1].s;
      if (i > anchor.points && away < near_cluster * anchor.before.ds) break;
      for (const double times : lengths)
        if (leads_beyond(reached, anchor, curve, i, times))
          if (const auto outcome =
                  step_over_from(following, anchor, i, times, false, progress, curve))
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
  while (anchor.set && curve.points.size() > std::max<std::size_t>(anchor.at.points, 1) &&
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

}  // namespace

void Anchor::note(const Refusal& refused, const Progress& progress, const Curve& curve) {
  if (refused.special && !set) {
    at = {progress, curve.points.size()};
    hits = curve.hits.size();
    set = true;
  }
  if (refused.special && !first) first = at;
  if (refused.special) refused_to = std::max(refused_to, progress.here.s + progress.ds);
  passing = passing || refused.passing;
  if (set && (refused.special || refused.astray)) ++refusals;
}

void Anchor::release(const Progress& progress, const Curve& curve) {
  const bool found = curve.hits.size() != hits;
  if (found || passing || progress.here.s > refused_to) first.reset();
  if (!found && progress.here.s <= at.before.here.s + at.before.ds) return;
  set = tried = passing = false;
  refusals = 0;
}

std::optional<Outcome> step_elsewhere(const Following& following, const Refusal& refused,
                                      Anchor& anchor, Progress& progress, Curve& curve) {
  const bool free =
      !anchor.passing && curve.hits.size() == anchor.hits && anchor.at.before.left.empty();
  if (!anchor.set || anchor.tried || !free) return std::nullopt;
  const bool worth_it = anchor.at.before.ds >= told_apart && anchor.elsewhere < most_elsewhere;
  if (anchor.refusals == 2 && (refused.special || refused.astray) && worth_it)
    return step_of_like_length(following, anchor, progress, curve);
  if (progress.ds >= unresolved_length) return std::nullopt;
  if (const auto outcome = step_over(following, anchor.at, progress, curve)) return outcome;
  if (anchor.first && anchor.first->points < anchor.at.points && anchor.first->before.left.empty())
    if (const auto outcome = step_over(following, *anchor.first, progress, curve)) return outcome;
  anchor.tried = true;
  return cross_cluster(following, anchor, progress, curve) ? std::optional(Outcome::go_on)
                                                           : std::nullopt;
}

void forget_doubtful_points(const Anchor& anchor, double astray_at, Curve& curve) {
  forget_last_step(astray_at, curve);
  forget_last_crawl(anchor, curve);
}

}  // namespace springfold::continuation
