#include "springfold/continuation/trace.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/following/finished.hpp"
#include "continuation/following/keep_hits.hpp"
#include "continuation/following/one_step.hpp"
#include "continuation/following/wider_steps.hpp"
#include "continuation/kinks/beside.hpp"
#include "continuation/kinks/kink.hpp"
#include "continuation/points/normalised.hpp"
#include "springfold/continuation/entry_checks.hpp"
#include "springfold/continuation/interrupted.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/continuation/stretches.hpp"
#include "springfold/continuation/verification.hpp"

namespace springfold::continuation {
namespace {

/// The main loop: steps until something ends the curve.
void follow(const Following& following, const StepObserver& observer, Progress& progress,
            Curve& curve) {
  const TraceOptions& options = following.walker.options;
  curve.stop = StopReason::max_points;
  Anchor anchor;
  double astray_at = -1;
  // Points may be taken back, refused steps keep none: both are counted, so that every trace ends.
  constexpr int most_steps_per_point = 50;
  long steps_left = static_cast<long>(most_steps_per_point) * options.maximum_points;
  while (static_cast<int>(curve.points.size()) < options.maximum_points && steps_left-- > 0) {
    anchor.release(progress, curve);
    Refusal refused;
    // Where lambda stands still, short steps are as good as long ones; elsewhere they would be led by rounding.
    const bool report = std::abs(progress.here.tangent.dlambda) <= flat_rate;
    Outcome outcome = advance(following, report, progress, curve, refused);
    if (outcome == Outcome::shorten) {
      curve.log.push_back({progress.here.s, progress.ds, refused.reason});
      anchor.note(refused, progress, curve);
      if (refused.astray) astray_at = progress.here.s;
      progress.ds *= 0.5;
      if (const auto other = step_elsewhere(following, refused, anchor, progress, curve))
        outcome = *other;
      else if (progress.ds >= options.step.minimum)
        continue;
    }
    if (outcome == Outcome::stop) return;
    if (outcome == Outcome::shorten) {
      curve.stop = StopReason::step_too_small;
      curve.stop_detail = refused.reason;
      return forget_doubtful_points(anchor, astray_at, curve);
    }
    if (observer && !observer(progress.here)) {
      curve.stop = StopReason::observer;
      return;
    }
  }
  curve.stop_detail = why_so_many(following.walker, curve);
}

/// A curve that was asked to end is handed over at once.
void hand_over(const TraceOptions& options, Curve& curve) {
  curve.stop = StopReason::observer;
  if (options.verify_arcs)
    curve.arcs = {{.s_begin = curve.points.front().s, .s_end = curve.points.back().s}};
}

/// What is said of a curve that is traced to its end.
void finish(const Walker& walker, Curve& curve) {
  settle_families(curve);
  check_narrow_places(walker, curve);
  if (curve.stop == StopReason::observer)
    hand_over(walker.options, curve);
  else if (walker.options.verify_arcs)
    curve.arcs = verified_arcs(walker.problem, curve, walker.options);
}

/// trace_in_own_units(). @param middles  as Following has them
Curve trace_inside(ProblemView problem, const Vector& x, double lambda, const Ray& start,
                   const std::vector<Event>& events, const TraceOptions& options,
                   const StepObserver& observer, const HitObserver& at_hit,
                   std::vector<CurvePoint>* middles, IfInterrupted interrupted) {
  const Walker walker{problem, problem.metric(), options};
  const CurvePoint first{.x = x, .lambda = lambda};
  Progress progress;
  progress.here = point_on_ray(walker, first, start);
  // At a limit point an eigenvalue is zero: its sign is rounding.
  if (!told_from_zero(progress.here)) progress.here.negative.reset();
  progress.left = active_switches(walker, x, lambda);
  progress.ds = options.step.initial;
  Curve curve{.points = {progress.here}};
  const auto opening =
      start.beyond ? opening_of(walker, progress.here, *start.beyond) : std::nullopt;
  if (!opening && start.start) {
    // The piece may be singular at the point itself, and the next surface as near as the way's first point.
    progress.from_singular = true;
    progress.ds = std::clamp(start.start->s, options.step.minimum, options.step.initial);
    if (start.start->x != x || start.start->lambda != lambda) {
      progress.here = *start.start;
      progress.left.clear();
      curve.points.push_back(progress.here);
    }
  }
  // What is given up in the middle of a step has left nothing of that step: the points before stand.
  try {
    progress.from_singular = progress.from_singular || opening.has_value();
    if (!opening ||
        pass_opening(walker, events, at_hit, *opening, progress, curve) != Outcome::stop)
      follow({walker, events, at_hit, middles}, observer, progress, curve);
    finish(walker, curve);
  } catch (const Interrupted&) {
    if (interrupted == IfInterrupted::give_up) throw;
    hand_over(options, curve);
  }
  return curve;
}

/// trace() in the engine's own units.
Curve trace_normalised(ProblemView problem, const Vector& x, double lambda, const Ray& start,
                       const std::vector<Event>& events, const TraceOptions& options,
                       const StepObserver& observer, const HitObserver& at_hit,
                       std::vector<CurvePoint>* middles) {
  check_entry(problem, x, lambda, start.piece, options);
  check_ray(problem, start);
  check_events(events);
  const Normalised own(problem, x, lambda, start.piece);
  const CurvePoint first = own.inside(x, lambda);
  Curve curve = own.outside(trace_inside(own, first.x, first.lambda, own.inside(start, first),
                                         own.inside(events), options, own.inside(observer),
                                         own.inside(at_hit), middles, IfInterrupted::keep));
  if (!middles) return curve;
  // Those whose steps were not taken back.
  std::ranges::stable_sort(*middles, {}, &CurvePoint::s);
  std::erase_if(*middles, [&](const CurvePoint& p) { return !(p.s < curve.points.back().s); });
  for (CurvePoint& middle : *middles) middle = own.outside(std::move(middle));
  return curve;
}

}  // namespace

Rays rays_from(ProblemView problem, const Vector& x, double lambda, const Piece& piece,
               const TraceOptions& options) {
  check_entry(problem, x, lambda, piece, options);
  const Normalised own(problem, x, lambda, piece);
  const Walker walker{own, own.metric(), options};
  const CurvePoint at = own.inside(x, lambda);
  const std::vector<Index> active = active_switches(walker, at.x, at.lambda);
  if (active.size() > most_active) return {.complete = false, .why = too_many_act(active.size())};
  Rays result = rays_at(walker, at.x, at.lambda, piece, active);
  for (Ray& ray : result.rays) ray = own.outside(ray, at);
  return result;
}

Curve trace(ProblemView problem, const Vector& x, double lambda, const Ray& start,
            const std::vector<Event>& events, const TraceOptions& options,
            const StepObserver& observer, const HitObserver& at_hit) {
  return trace_normalised(problem, x, lambda, start, events, options, observer, at_hit, nullptr);
}

Curve trace_in_own_units(ProblemView problem, const Vector& x, double lambda, const Ray& start,
                         const std::vector<Event>& events, const TraceOptions& options,
                         const StepObserver& observer, const HitObserver& at_hit,
                         IfInterrupted interrupted) {
  return trace_inside(problem, x, lambda, start, events, options, observer, at_hit, nullptr,
                      interrupted);
}

Curve trace_with_middles(ProblemView problem, const Vector& x, double lambda, const Ray& start,
                         const std::vector<Event>& events, const TraceOptions& options,
                         const StepObserver& observer, std::vector<CurvePoint>& middles) {
  return trace_normalised(problem, x, lambda, start, events, options, observer, {}, &middles);
}

}  // namespace springfold::continuation
