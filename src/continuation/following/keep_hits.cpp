#include "continuation/following/keep_hits.hpp"

#include "continuation/locating/unexplained.hpp"
#include "continuation/locating/watched_step.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {
namespace {

/// Has the step before reported this touch already? Each lies in the stretch on which the other is lost in rounding.
bool is_reported(const Curve& curve, const Hit& hit) {
  if (hit.kind != HitKind::touch || curve.hits.empty()) return false;
  const Hit& last = curve.hits.back();
  return last.kind == HitKind::touch && last.s_before < hit.point.s && hit.point.s < last.s_after &&
         hit.s_before < last.point.s && last.point.s < hit.s_after;
}

/// Does an event keep its sign on a short stretch? At the singular point it may be zero.
bool is_quiet(const Event& event, const CurvePoint& junction, const CurvePoint& middle,
              const CurvePoint& end) {
  const double first = event.value(junction), half = event.value(middle), last = event.value(end);
  return half * last > 0 && first * half >= -small_share * half * half;
}

}  // namespace

bool keep(const Walker& walker, Samples samples, const HitObserver& at_hit, const StepEvents& found,
          Curve& curve) {
  const std::vector<CurvePoint> between = points_between_hits(walker, samples, found.hits);
  auto next = between.begin();
  for (const Hit& hit : found.hits) {
    if (is_reported(curve, hit)) continue;
    for (; next != between.end() && next->s < hit.point.s; ++next) curve.points.push_back(*next);
    curve.hits.push_back(hit);
    if (!hit.stops && (!at_hit || at_hit(hit))) continue;
    curve.stop = hit.stops ? StopReason::event : StopReason::joined;
    curve.stop_detail = hit.name;
    return true;
  }
  return false;
}

Outcome pass_opening(const Walker& walker, const std::vector<Event>& events,
                     const HitObserver& at_hit, const Opening& opening, Progress& progress,
                     Curve& curve) {
  Walker plain = walker;
  plain.options.limit_points = plain.options.branch_points = false;
  const CurvePoint &middle = opening.middle.point, &end = opening.kink.point;
  std::vector<Event> wanted;
  for (const Event& event : events)
    if (!is_quiet(event, progress.here, middle, end)) wanted.push_back(event);
  StepEvents found = events_on_step(plain, progress.here, end, &middle, wanted);
  if (!found.doubt.empty()) add_unresolved(progress.here, end, found, curve);
  if (keep(walker, StepSamples(progress.here, &middle, end), at_hit, found, curve))
    return Outcome::stop;
  if (found.hits.empty()) curve.points.push_back(middle);
  return pass_kink(walker, opening.kink, progress, curve, &opening.middle);
}

}  // namespace springfold::continuation
