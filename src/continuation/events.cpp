#include "events.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "springfold/continuation/branch_point.hpp"
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

bool add_crossing(const Walker& walker, const CurvePoint& from, const CurvePoint& to, HitKind kind,
                  const std::string& name, bool stops,
                  const std::function<double(const CurvePoint&)>& value,
                  std::vector<Found>& found) {
  const auto located = locate(walker, from, 0, to.s - from.s, value);
  if (!located) return false;
  Hit hit{.kind = kind,
          .name = name,
          .point = located->point,
          .s_before = from.s + located->before,
          .s_after = from.s + located->after};
  if (kind == HitKind::limit_point) hit.point.negative.reset();
  found.push_back({std::move(hit), stops});
  return true;
}

}  // namespace

StepEvents events_on_step(const Walker& walker, const CurvePoint& from, const CurvePoint& to,
                          const std::optional<Index>& known_from,
                          const std::vector<Event>& events) {
  constexpr double vertical = 1e-10;  // below this lambda does not change along the curve at all
  StepEvents result;
  std::vector<Found> found;

  long limit_points = 0;
  const auto rate = [](const CurvePoint& p) { return p.tangent.dlambda; };
  const bool moves = std::max(std::abs(rate(from)), std::abs(rate(to))) > vertical;
  if (walker.options.limit_points && moves && crosses(rate(from), rate(to))) {
    if (!add_crossing(walker, from, to, HitKind::limit_point, "limit point", false, rate, found))
      result.failure = "a limit point could not be located";
    ++limit_points;
  }

  if (walker.options.branch_points && known_from && to.negative) {
    const long change = std::abs(static_cast<long>(*to.negative) - static_cast<long>(*known_from));
    if (limit_points == 0 && change > 0) {
      CurvePoint start = from;
      start.negative = known_from;
      const auto crossings = locate_crossings(walker, start, to);
      if (!crossings) {
        result.explained = false;
      } else {
        for (const CrossingPoint& c : *crossings)
          found.push_back({Hit{.kind = HitKind::branch_point,
                               .name = "branch point",
                               .point = c.point,
                               .multiplicity = c.multiplicity,
                               .s_before = from.s + c.before,
                               .s_after = from.s + c.after},
                           false});
      }
    } else if (change != limit_points) {
      result.explained = false;  // limit and branch points in one step: take a shorter one
    }
  }

  for (const Event& event : events) {
    if (!crosses(event.value(from), event.value(to))) continue;
    const bool stops = event.action == EventAction::stop;
    if (!add_crossing(walker, from, to, HitKind::user, event.name, stops, event.value, found))
      result.failure = "event \"" + event.name + "\" could not be located";
  }

  std::stable_sort(found.begin(), found.end(),
                   [](const Found& a, const Found& b) { return a.hit.point.s < b.hit.point.s; });
  for (Found& f : found) {
    result.hits.push_back(std::move(f.hit));
    result.stops.push_back(f.stops);
  }
  return result;
}

}  // namespace springfold::continuation
