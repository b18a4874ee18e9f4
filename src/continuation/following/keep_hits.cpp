#include "continuation/following/keep_hits.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/locating/tested_step.hpp"
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

bool keep(const Walker& walker, Samples samples, bool ends_at_kink, const HitObserver& at_hit,
          const StepEvents& found, Curve& curve) {
  const double begin = samples.front()->s, end = samples.back()->s;
  std::vector<double> places;
  if (!curve.hits.empty() && curve.hits.back().point.s == begin) places.push_back(begin);
  for (const Hit& hit : found.hits) places.push_back(hit.point.s);
  if (ends_at_kink) places.push_back(end);
  const std::vector<CurvePoint> between = points_between_special(walker, samples, places);
  auto next = between.begin();
  for (const Hit& hit : found.hits) {
    if (is_reported(curve, hit)) continue;
    for (; next != between.end() && next->s < hit.point.s; ++next) curve.points.push_back(*next);
    curve.hits.push_back(hit);
    if (!hit.stops && (!at_hit || at_hit(hit))) continue;
    curve.hits.back().stops = true;
    curve.stop = hit.stops ? StopReason::event : StopReason::joined;
    curve.stop_detail = hit.name;
    return true;
  }
  curve.points.insert(curve.points.end(), next, between.end());
  return false;
}

Outcome pass_opening(const Walker& walker, const std::vector<Event>& events,
                     const HitObserver& at_hit, const Opening& opening, Progress& progress,
                     Curve& curve) {
  const CurvePoint &middle = opening.middle.point, &end = opening.kink.point;
  std::vector<Event> wanted;
  for (const Event& event : events)
    if (!is_quiet(event, progress.here, middle, end)) wanted.push_back(event);
  StepEvents found =
      events_on_step(without_special_points(walker), progress.here, end, &middle, wanted);
  if (!found.doubt.empty()) add_unresolved(progress.here, end, found, curve);
  if (keep(walker, StepSamples(progress.here, &middle, end), true, at_hit, found, curve))
    return Outcome::stop;
  if (found.hits.empty()) curve.points.push_back(middle);
  return pass_kink(walker, opening.kink, progress, curve, &opening.middle);
}

void add_unresolved(const CurvePoint& from, const CurvePoint& to, const StepEvents& found,
                    Curve& curve) {
  const int count = std::max(1, found.unexplained);
  if (!curve.hits.empty() && curve.hits.back().kind == HitKind::unresolved &&
      from.s - curve.hits.back().s_after < 1000 * unresolved_length) {
    curve.hits.back().s_after = to.s;
    if (!found.flat) curve.hits.back().multiplicity += count;
    return;
  }
  Hit hit{.kind = HitKind::unresolved, .name = "unresolved: " + found.doubt};
  hit.point = to;
  hit.multiplicity = count;
  hit.s_before = from.s;
  hit.s_after = to.s;
  curve.hits.push_back(std::move(hit));
}

void account_over_gap(Curve& curve) {
  const CurvePoint& here = curve.points.back();
  auto known = curve.points.rbegin() + 1;
  while (known != curve.points.rend() && !known->negative) ++known;
  if (!here.negative || known == curve.points.rend() || known == curve.points.rbegin() + 1) return;
  int most = 0;
  bool odd = false, parity = true;
  for (const Hit& hit : curve.hits) {
    if (hit.point.s < known->s || hit.kind == HitKind::user) continue;
    const bool branch_point = hit.kind == HitKind::branch_point;
    const bool limit_point = hit.kind == HitKind::limit_point;
    if (!branch_point && !limit_point && hit.kind != HitKind::touch) return;
    most += branch_point ? hit.multiplicity + 1 : limit_point ? 1 : 0;
    odd = odd != limit_point;
    parity = parity && !branch_point;  // lambda may turn there as well
  }
  const auto change = static_cast<int>(std::abs(*here.negative - *known->negative));
  if (change <= most && (!parity || (change % 2 == 1) == odd)) return;
  Hit hit{
      .kind = HitKind::unresolved,
      .name = "unresolved: number of negative eigenvalues and special points do not fit together"};
  hit.point = here;
  hit.multiplicity = std::max(1, change);
  hit.s_before = known->s;
  hit.s_after = here.s;
  curve.hits.push_back(std::move(hit));
}

}  // namespace springfold::continuation
