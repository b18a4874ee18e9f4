#include "events.hpp"

#include <algorithm>

#include "singular.hpp"
#include "springfold/continuation/locate.hpp"

namespace springfold::continuation {
namespace {

/// Half-open: a zero at `to` belongs to this step, one at `from` to the step before.
bool crosses(double at_from, double at_to) {
  return (at_from < 0 && at_to >= 0) || (at_from > 0 && at_to <= 0);
}

struct Found {
  Hit hit{};
  bool stops = false;
};

/// Zeros of the caller's event between the samples.
bool add_user_event(const Walker& walker, const std::vector<const CurvePoint*>& samples,
                    const Event& event, std::vector<Found>& found) {
  const CurvePoint& from = *samples.front();
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    if (!crosses(event.value(*samples[i]), event.value(*samples[i + 1]))) continue;
    const auto located =
        locate(walker, from, samples[i]->s - from.s, samples[i + 1]->s - from.s, event.value);
    if (!located) return false;
    Hit hit{.kind = HitKind::user, .name = event.name};
    hit.point = located->point;
    hit.s_before = from.s + located->before;
    hit.s_after = from.s + located->after;
    found.push_back({std::move(hit), event.action == EventAction::stop});
  }
  return true;
}

}  // namespace

StepEvents events_on_step(const Walker& walker, const CurvePoint& from, const CurvePoint& to,
                          const std::optional<CurvePoint>& middle,
                          const std::vector<Event>& events) {
  std::vector<const CurvePoint*> samples{&from};
  if (middle && middle->s < to.s) samples.push_back(&*middle);
  samples.push_back(&to);

  StepEvents result;
  SingularPoints singular = singular_points(walker, samples);
  result.doubt = singular.doubt;
  result.unexplained = singular.unexplained;
  std::vector<Found> found;
  for (Hit& hit : singular.hits) found.push_back({std::move(hit), false});
  for (const Event& event : events)
    if (!add_user_event(walker, samples, event, found))
      result.doubt = "event \"" + event.name + "\" could not be located";

  std::stable_sort(found.begin(), found.end(),
                   [](const Found& a, const Found& b) { return a.hit.point.s < b.hit.point.s; });
  for (Found& f : found) {
    result.hits.push_back(std::move(f.hit));
    result.stops.push_back(f.stops);
  }
  return result;
}

}  // namespace springfold::continuation
