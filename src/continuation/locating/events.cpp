#include "continuation/locating/events.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "continuation/locating/singular.hpp"
#include "continuation/locating/zeros.hpp"
#include "continuation/points/chebyshev.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/locate.hpp"
#include "continuation/points/workspace.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/sampling.hpp"

namespace springfold::continuation {
namespace {

/// The curve's point from its points around it, where none can be computed: at a branch point.
std::optional<CurvePoint> interpolated_point(const TestedStep& arc, const CurvePoint& to,
                                             double ds) {
  const CurvePoint& from = arc.from();
  const auto [a, b] = window_around(ds, 0.5 * (to.s - from.s), 0, to.s - from.s);
  const auto curve = interpolated_curve([&](double t) { return arc.point_once(t); }, a, b);
  if (!curve) return std::nullopt;
  const Vector u = (*curve)(ds);
  CurvePoint point = from;
  point.x = u.head(from.x.size());
  point.lambda = u[from.x.size()];
  point.tangent = unit_direction(arc.walker(), curve->slope(ds));
  point.negative.reset();
  point.s = from.s + ds;
  return point;
}

/// The value behind the step, where it is first told from zero; 0 if it is not.
template <class Function>
double clear_value_beyond(const Function& value, double h, double noise) {
  for (const double share : decades<-2, 0>()) {
    const auto beyond = value(h + 0.5 * share * h);
    if (!beyond || std::isnan(*beyond)) return 0;
    if (std::abs(*beyond) > noise) return *beyond;
  }
  return 0;
}

using EventValue = Workspace::EventValues::Value;

EventValue value_of(const Event& event, const CurvePoint& point) {
  return {event.value(point), event.noise ? event.noise(point) : 0};
}

/// How far values scatter at points of the curve that are corrected again, from a little aside of it: where the curve
/// is nearly singular, its places and tangents are as rough as that, whatever the terms of the value are.
double scatter_of(const TestedStep& arc, Samples samples, const Event& event,
                  std::span<const double> values) {
  const Walker& walker = arc.walker();
  double scatter = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const CurvePoint& p = *samples[i];
    const double size = std::max({1.0, p.x.lpNorm<Eigen::Infinity>(), std::abs(p.lambda)});
    Direction aside{Vector(p.x.size()), 0};
    for (Index j = 0; j < p.x.size(); ++j)
      aside.dx[j] = uneven_share(static_cast<int>(j + 1)) - 0.5;
    aside.dlambda = 0.5;
    const double along = metric_product(walker.weights, aside, p.tangent);
    const double far = root_of_rounding * size;
    const auto again =
        correct(walker.problem, walker.weights, p.x + far * (aside.dx - along * p.tangent.dx),
                p.lambda + far * (aside.dlambda - along * p.tangent.dlambda), p.piece, p.tangent,
                walker.options.newton);
    Linearisation at;
    if (!converged(again) || !linearise(walker.problem, again.x, again.lambda, p.piece, at))
      continue;
    const auto tangent = tangent_at(at, walker.weights, p.tangent);
    if (!tangent) continue;
    CurvePoint q = p;
    q.x = again.x;
    q.lambda = again.lambda;
    q.tangent = *tangent;
    const double difference = std::abs(event.value(q) - values[i]);
    if (difference > scatter) scatter = difference;
  }
  return scatter;
}

/// The event between the ends; at the ends the very values that the neighbouring steps see: a sign must not change in
/// between.
SampledFunction value_on(const TestedStep& arc, const Event& event,
                         std::span<const double> values) {
  return [&arc, &event, values](double ds) -> std::optional<double> {
    if (ds == 0) return values.front();
    if (ds == arc.length()) return values.back();
    if (const CurvePoint* straight = arc.straight_point(ds)) return event.value(*straight);
    auto point = event.of_place ? arc.exact_place(ds) : arc.exact_point(ds);
    if (!point) point = arc.point_once(ds);
    return point ? std::optional<double>(event.value(*point)) : std::nullopt;
  };
}

/// Does the event keep clear of zero between its samples? As the polynomial through them has it, which is off by less
/// than it differs from the cubic through the step's ends; what the step does besides was looked for when it was taken.
bool keeps_its_sign(const TestedStep& arc, const Event& event, std::span<const double> values) {
  constexpr int parts =
      8;  // a parabola's extremum between their ends is off by a 64th of its height
  double least = infinity, most = 0, off = 0;
  const auto take = [&](double value) {
    least = std::min(least, values.front() < 0 ? -value : value);
    most = std::max(most, std::abs(value));
  };
  for (const double value : values) take(value);
  if (!(least > 0) || arc.straight_point(0.5 * arc.length())) return false;
  for (int k = 1; k < parts; ++k) {
    const auto expected = arc.expected(arc.length() * k / parts);
    if (!expected) return false;
    const double value = event.value(expected->by_samples);
    if (!std::isfinite(value)) return false;
    take(value);
    if (k == 2 || k == parts - 2)
      off = std::max(off, std::abs(event.value(expected->by_ends) - value));
  }
  return std::isfinite(off) && least > small_share * most && least > between_samples * off;
}

Hit hit_of(const Event& event, CurvePoint point, double before, double after) {
  return {.kind = HitKind::user,
          .name = event.name,
          .point = std::move(point),
          .s_before = before,
          .s_after = after,
          .stops = event.action == EventAction::stop,
          .tag = event.tag};
}

/// @pre the value is defined at one end of the step, not at the other. Zeros up to where that changes.
bool add_where_defined(const TestedStep& arc, const Event& event, std::span<const double> values,
                       double s, std::vector<Hit>& found) {
  const bool at_begin = std::isfinite(values.front());
  const SampledFunction value = value_on(arc, event, values);
  const auto is_defined = [&](double ds) {
    const auto there = value(ds);
    return there && std::isfinite(*there);
  };
  double inside = at_begin ? 0 : arc.length(), outside = arc.length() - inside;
  while (std::abs(outside - inside) > one_place * arc.length()) {
    const double middle = 0.5 * (inside + outside);
    (is_defined(middle) ? inside : outside) = middle;
  }
  const double a = at_begin ? 0 : inside, b = at_begin ? inside : arc.length();
  // So near to where it ends it would have to fall steeper than one to be zero there.
  if (!(b - a > 2 * together)) return !at_begin || std::abs(values.front()) > 2 * together;
  const ZeroSearch search = find_zeros(value, a, b, 0, one_place * arc.length());
  for (const ZeroOf& zero : search.zeros) {
    auto point = zero.touches || !(zero.at > 0) ? std::nullopt : arc.point_once(zero.at);
    if (point) found.push_back(hit_of(event, std::move(*point), s + zero.before, s + zero.after));
  }
  // Where it falls to zero just as it ends it is not told what happens.
  const auto edge = value(inside);
  const std::array<double, 2> ends{at_begin ? values.front() : values.back(), edge.value_or(0)};
  return search.resolved && (!search.zeros.empty() || !within_reach(ends));
}

/// At a singular point the equations do not say which tangent is that of the curve: zeros of what depends on it up to
/// just before such an end of the step.
ZeroSearch zeros_beside_singular_ends(const TestedStep& arc, Samples samples,
                                      const SampledFunction& value, double noise) {
  const double h = arc.length(), aside = std::min(small_share * h, told_apart);
  const auto is_singular_at = [&](const CurvePoint& end) {
    const auto E = arc.matrix(end);
    return E && is_singular(*E, poor);
  };
  const double low = is_singular_at(*samples.front()) ? aside : 0;
  const double high = is_singular_at(*samples.back()) ? h - aside : h;
  if (low == 0 && high == h) return {.resolved = false};
  return find_zeros(value, low, high, noise, one_place * h);
}

/// Zeros of the caller's event on the step. A zero at `to` belongs to this step, one at `from` to
/// the step before; zeros without change of sign do not count.
/// @param known  at `from`, or nullptr
/// @param end    is filled with what is found at `to`
bool add_user_event(const TestedStep& arc, Samples samples, const Event& event,
                    const EventValue* known, EventValue& end, std::vector<Hit>& found) {
  const CurvePoint &from = *samples.front(), &to = *samples.back();
  const double h = to.s - from.s;
  std::array<double, 3> storage{};
  assert(samples.size() <= storage.size());
  const std::span values(storage.data(), samples.size());
  double scale = 0, noise = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    end = i == 0 && known ? *known : value_of(event, *samples[i]);
    values[i] = end.value;
    scale = std::max(scale, std::abs(end.value));
    noise = std::max(noise, end.noise);
  }
  if (std::isfinite(values.front()) != std::isfinite(values.back()))
    return add_where_defined(arc, event, values, from.s, found);
  // Ends that lie on the event to rounding lie on it, for this step and for its neighbour.
  noise = std::max(noise, refined_step * scale);
  for (double* outer : {&values.front(), &values.back()})
    if (std::abs(*outer) <= noise) *outer = 0;
  if (!within_reach(values) || keeps_its_sign(arc, event, values)) return true;
  const SampledFunction value = value_on(arc, event, values);
  ZeroSearch search = find_zeros(value, 0, h, noise, one_place * h);
  if (!event.of_place && (!search.zeros.empty() || !search.resolved)) {
    const double rough = clear_of_rounding * scatter_of(arc, samples, event, values);
    // Values that are no larger than they scatter are zero to rounding all along the step, and have no zeros.
    if (scale <= rough) return true;
    if (!search.resolved && rough > noise) search = find_zeros(value, 0, h, rough, one_place * h);
    if (!search.resolved) search = zeros_beside_singular_ends(arc, samples, value, noise);
  }
  const auto add = [&](CurvePoint point, double before, double after) {
    found.push_back(hit_of(event, std::move(point), from.s + before, from.s + after));
  };
  const double begin =
      from.s > 0 ? 0 : exact_model * h;  // a start that is on the event does not meet it
  for (const ZeroOf& zero : search.zeros) {
    // An end that is zero to rounding is a crossing only if the sign beyond is another one: see below.
    const bool is_end = values.back() == 0 && h - zero.at <= one_place * h;
    if (zero.touches || is_end || !(zero.at > begin)) continue;
    auto point = arc.point_once(zero.at);
    if (!point) point = interpolated_point(arc, to, zero.at);
    // The end is zero itself, and a branch point, next to which there are no points and tangents are rough: see below.
    if (!point && h - zero.at <= one_place) {
      values.back() = 0;
      continue;
    }
    if (!point) return false;
    add(std::move(*point), zero.before, zero.after);
  }
  // Zero exactly at the end: a crossing if the sign beyond is another one.
  if (values.back() == 0 && values.front() != 0) {
    const double beyond = clear_value_beyond(value, h, noise);
    if (beyond != 0 && (beyond < 0) != (values.front() < 0)) add(*samples.back(), h, h);
  }
  return search.resolved;
}

/// A special point shows the curve where its samples did not: between two of them an event changes its sign once more
/// than was found, as where a force has passed its limit and comes back within the step.
/// @param found  all special points of the step, in order
bool add_between_special(const TestedStep& arc, Samples samples, const Event& event,
                         std::vector<Hit>& found) {
  struct Known {
    double ds = 0, value = 0;
  };
  const CurvePoint &from = *samples.front(), &to = *samples.back();
  const EventValue first = value_of(event, from), last = value_of(event, to);
  std::vector<Known> known{{0, first.value}};
  const auto is_inside = [&](const Hit& hit) { return hit.point.s > from.s && hit.point.s < to.s; };
  const auto is_own = [&](const Hit& hit) {
    return hit.kind == HitKind::user && hit.tag == event.tag && hit.name == event.name;
  };
  for (const Hit& hit : found)
    if (is_inside(hit) && !is_own(hit))
      known.push_back({hit.point.s - from.s, event.value(hit.point)});
  known.push_back({arc.length(), last.value});
  double scale = 0;
  for (const Known& k : known) scale = std::max(scale, std::abs(k.value));
  const double noise = std::max({first.noise, last.noise, refined_step * scale});
  // A special point may lie on the event with a double zero, which has no sign within the root of its rounding.
  const double clear = std::max(noise, root_of_rounding * scale);
  const std::array<double, 2> ends{first.value, last.value};
  const SampledFunction value = value_on(arc, event, ends);
  std::vector<Hit> more;
  for (std::size_t i = 1; i < known.size(); ++i) {
    const double a = known[i - 1].ds, before = known[i - 1].value;
    const double b = known[i].ds, after = known[i].value;
    const bool changes = std::min(std::abs(before), std::abs(after)) > clear && before * after < 0;
    const bool told = std::any_of(found.begin(), found.end(), [&](const Hit& hit) {
      const double ds = hit.point.s - from.s;
      return is_own(hit) && ds >= a - together && ds <= b + together;
    });
    if (!changes || told || !(b - a > 2 * together)) continue;
    // At the very special points a value may be another one than beside them.
    const auto behind = value(a + together), ahead = value(b - together);
    if (!behind || !ahead || !(*behind * before > 0) || !(*ahead * after > 0)) continue;
    const ZeroSearch search = find_zeros(value, a, b, noise, one_place * arc.length());
    if (!search.resolved) return false;
    for (const ZeroOf& zero : search.zeros) {
      auto point = zero.touches ? std::nullopt : arc.point_once(zero.at);
      if (zero.touches) continue;
      if (!point) return false;
      more.push_back(hit_of(event, std::move(*point), from.s + zero.before, from.s + zero.after));
    }
  }
  found.insert(found.end(), more.begin(), more.end());
  sort_by_place(found);
  return true;
}

}  // namespace

Walker without_special_points(const Walker& walker) {
  Walker plain = walker;
  plain.options.limit_points = plain.options.branch_points = false;
  return plain;
}

void sort_by_place(std::vector<Hit>& hits) {
  std::stable_sort(hits.begin(), hits.end(),
                   [](const Hit& a, const Hit& b) { return a.point.s < b.point.s; });
}

StepEvents events_on_step(const Walker& walker, const CurvePoint& from, const CurvePoint& to,
                          const CurvePoint* middle, const std::vector<Event>& events) {
  const StepSamples samples(from, middle && middle->s < to.s ? middle : nullptr, to);

  const TestedStep arc(walker, samples);
  StepEvents result = singular_points(arc, samples);
  auto& known = walker.memory->at_end;
  const bool is_known = known.events == events.data() && known.values.size() == events.size() &&
                        is_same(known.point, from);
  known.next.resize(events.size());
  for (std::size_t i = 0; i < events.size(); ++i)
    if (!add_user_event(arc, samples, events[i], is_known ? &known.values[i] : nullptr,
                        known.next[i], result.hits)) {
      result.doubt = "event \"" + events[i].name + "\" could not be located";
      result.of_caller = true;
    }
  if (!events.empty()) {
    known.events = events.data();
    known.point = to;
    known.values.swap(known.next);
  }
  sort_by_place(result.hits);
  const bool shown = !result.hits.empty();
  for (std::size_t i = 0; shown && i < events.size(); ++i)
    if (!add_between_special(arc, samples, events[i], result.hits)) {
      result.doubt = "event \"" + events[i].name + "\" could not be located";
      result.of_caller = true;
    }
  return result;
}

}  // namespace springfold::continuation
