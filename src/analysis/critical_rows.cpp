#include "critical_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "branch_rows.hpp"
#include "critical_kinks.hpp"
#include "grow_diagram.hpp"
#include "other_modes.hpp"
#include "springfold/analysis/row_memory.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/number_text.hpp"
#include "vanishing_lengths.hpp"

namespace springfold::analysis {
namespace {

using continuation::CriticalCurve;
using continuation::CriticalHit;
using continuation::CriticalPoint;
using continuation::Degeneracy;

/// A row to be; `sign`: -1 on the side that is walked backwards.
struct Row {
  CriticalPoint point{};
  const CriticalHit* hit = nullptr;
};

std::vector<Row> side_of(const CriticalCurve& curve, double sign) {
  std::vector<Row> rows;
  std::size_t h = 0;
  while (h < curve.hits.size() && !(curve.hits[h].point.s > 0)) ++h;  // the start has its row
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    while (h < curve.hits.size() && curve.hits[h].point.s <= curve.points[i].s) {
      rows.push_back({curve.hits[h].point, &curve.hits[h]});
      ++h;
    }
    rows.push_back({curve.points[i], nullptr});
  }
  for (; h < curve.hits.size(); ++h) rows.push_back({curve.hits[h].point, &curve.hits[h]});
  // A range ends at its limit: the step that found it reached beyond.
  if (curve.stop == continuation::StopReason::event && !curve.hits.empty())
    while (rows.size() > 1 && rows.back().hit == nullptr) rows.pop_back();
  for (Row& row : rows) row.point.s *= sign;
  return rows;
}

std::string detail_of(const CriticalHit& hit, EventKind of) {
  const std::string kind = name_of_degeneracy(hit.kind, of);
  if (hit.kind == Degeneracy::user) return hit.name;
  return hit.name.empty() ? kind : kind + ": " + hit.name;
}

/// Where between two values do starts end? The one nearer to `mu` on the far side, and why.
std::optional<std::pair<double, std::string>> ending_start(const CaseCurves& curves, double mu,
                                                           double beyond) {
  if (curves.equations_at(mu) == nullptr || curves.equations_at(beyond) != nullptr)
    return std::nullopt;
  std::string why = curves.why_none(beyond);
  constexpr int halvings = 30;
  for (int i = 0; i < halvings; ++i) {
    const double middle = mu + 0.5 * (beyond - mu);
    if (curves.equations_at(middle) != nullptr) {
      mu = middle;
    } else {
      beyond = middle;
      why = curves.why_none(middle);
    }
  }
  return std::pair{beyond, std::move(why)};
}

/// Where a curve could not go on, or only in ever shorter steps: has a length come to zero there?
std::optional<std::string> length_at_end(const CaseCurves& curves,
                                         const continuation::CriticalCurve& curve) {
  if (curve.stop != continuation::StopReason::step_too_small &&
      curve.stop != continuation::StopReason::max_points)
    return std::nullopt;
  const Member* member = curves.equations_at(curve.points.back().mu);
  if (member == nullptr) return std::nullopt;
  continuation::Curve path;
  for (const CriticalPoint& point : curve.points)
    path.points.push_back(CaseCurves::point_of(point, {}));
  return vanishing_length(*member->problem, path, path.points.back());
}

}  // namespace

void say_why_it_stops(const CaseCurves& curves, bool growing, continuation::CriticalCurve& curve) {
  if (curve.points.empty()) return;
  if (auto length = length_at_end(curves, curve)) {
    curve.stop_detail = *std::move(length);
    return;
  }
  if (curve.stop != continuation::StopReason::step_too_small) return;
  // The narrowest differences in the parameter reach as far.
  constexpr double near = 0x1p-9;
  const CriticalPoint& last = curve.points.back();
  const double sense = last.dmu != 0 ? last.dmu : (growing ? 1.0 : -1.0);
  if (const auto end = ending_start(curves, last.mu, last.mu + std::copysign(near, sense))) {
    curve.stop_detail = "beyond " + curves.name() + " = " + rounded(end->first * curves.scale()) +
                        " " + end->second;
    return;
  }
  const auto found = switching_start(curves, last.mu, last.mu + std::copysign(near, sense));
  if (!found) return;
  curve.stop_detail = found->second + " switches at the start itself, at " + curves.name() + " = " +
                      rounded(found->first * curves.scale()) +
                      ": beyond, the paths begin otherwise, and the curve has a kink";
}

double most_rows(const CaseCurves& curves) {
  return most_memory / bytes_of_traced_row(curves.base().quantities().size() + 1,
                                           static_cast<std::size_t>(curves.base().problem->size()));
}

continuation::TraceOptions critical_options(const Study& study) { return options_of(study.trace); }

FollowedCurve follow_both_ways(const CaseCurves& curves, const Study& study,
                               const std::vector<continuation::CriticalStart>& starts, EventKind of,
                               const Observer& observer) {
  FollowedCurve followed{.start = starts.front(), .of = of};
  const auto events = critical_events(curves, study, starts.front().piece);
  int points = 0;
  const auto observe = [&](const CriticalPoint& p) { return !observer || observer(++points, p.s); };
  const auto options = critical_options(study);
  continuation::FurtherPoints further{.spacing = study.trace.spacing, .most = most_rows(curves)};
  // Of springs that switch at once another one may be the first on each side.
  const auto follow = [&](bool growing) {
    CriticalCurve curve;
    for (const continuation::CriticalStart& start : starts) {
      curve = follow_over_kinks(curves, start, growing, events, options, observe, further);
      const bool stands = curve.points.size() == 1 && curve.hits.size() == 1 &&
                          curve.hits.front().kind == Degeneracy::two_switches;
      if (!stands) break;
    }
    say_why_it_stops(curves, growing, curve);
    return curve;
  };
  followed.growing = follow(true);
  if (followed.growing.stop ==
      continuation::StopReason::closed) {  // the other way round is the same curve
    followed.falling.stop = followed.growing.stop;
    followed.falling.stop_detail = followed.growing.stop_detail;
    return followed;
  }
  further.most -= static_cast<double>(followed.growing.points.size());
  followed.falling = follow(false);
  note_passed_at_start(events, followed);
  return followed;
}

std::vector<std::string> doubts_of(const CaseCurves& curves, const Study& study,
                                   const FollowedCurve& followed) {
  std::vector<std::string> doubts;
  const double left_out = followed.falling.left_out + followed.growing.left_out;
  const int missed = followed.falling.missed + followed.growing.missed;
  const double spacing = study.trace.spacing;
  if (left_out > 0)
    doubts.push_back("trace.spacing: got " + rounded(spacing) + ", which makes about " +
                     rounded(left_out) + " rows of a curve, need at most " +
                     rounded(most_rows(curves)) +
                     " in all: a larger spacing; the curve has the rows of its steps only");
  if (missed > 0)
    doubts.push_back(std::to_string(missed) +
                     " rows beside degenerate points could not be computed");
  return doubts;
}

std::vector<Quantity> critical_quantities(const CaseCurves& curves) {
  std::vector<Quantity> columns;
  for (const auto& q : curves.base().quantities()) columns.push_back({q.name, q.unit});
  for (const auto& [name, value] : curves.held()) columns.push_back({name, Unit::none});
  columns.push_back({curves.name(), Unit::none});
  return columns;
}

/// Marked values and extrema of columns are ordinary points of their path: where a spring switches at one, nothing else
/// happens.
bool is_marked(EventKind of) { return of == EventKind::user_value || of == EventKind::extremum; }

/// "spring rail.x switches here".
std::string switch_of(const CriticalHit& hit) {
  return (hit.name.empty() ? "a spring" : hit.name) + " switches here";
}

EventKind kind_of(Degeneracy kind, EventKind of) {
  switch (kind) {
    case Degeneracy::cusp:
      return EventKind::cusp;
    case Degeneracy::isola_centre:
      return EventKind::isola_centre;
    case Degeneracy::crossing:
      return EventKind::crossing;
    case Degeneracy::hilltop:
      return EventKind::hilltop;
    case Degeneracy::branch_points_merge:
      return EventKind::branch_points_merge;
    case Degeneracy::corank_two:
      return EventKind::more_modes;
    case Degeneracy::fold_meets_activation:
      return is_marked(of) ? EventKind::switching : EventKind::fold_meets_activation;
    case Degeneracy::corner_loses_reversal:
      return EventKind::corner_loses_reversal;
    case Degeneracy::touches_surface:
      return EventKind::touches_activation;
    case Degeneracy::two_switches:
      return EventKind::two_activations;
    case Degeneracy::bends_other_way:
      return EventKind::bends_other_way;
    case Degeneracy::turn:  // extrema of the force merge as limit points do
      return of == EventKind::limit_point ? EventKind::cusp : EventKind::parameter_turns;
    case Degeneracy::extremum:
      return EventKind::extremum;
    case Degeneracy::user:
      return EventKind::user_value;
  }
  return EventKind::user_value;
}

std::string name_of_degeneracy(Degeneracy kind, EventKind of) {
  const bool merge = kind == Degeneracy::turn && kind_of(kind, of) == EventKind::cusp;
  return std::string{to_string(merge ? Degeneracy::cusp : kind)};
}

Stop critical_stop(const CriticalCurve& curve) {
  Stop stop;
  stop.complete = (curve.stop == continuation::StopReason::event ||
                   curve.stop == continuation::StopReason::closed) &&
                  curve.kept;
  stop.reason = curve.stop_detail.empty() ? std::string(to_string(curve.stop)) : curve.stop_detail;
  return stop;
}

void begin_at_degeneracy(const CriticalHit& hit, FollowedCurve& followed) {
  // Degeneracies are located as well, in arc length; extrema no better than that.
  constexpr double within_start = 1e-9, extremum_within = 1e-6;
  followed.at_start = hit;
  // Where the load turns back with everything else that is no extremum of its own.
  const auto is_extremum = [](const CriticalHit& other) {
    return other.kind == Degeneracy::extremum && other.point.s <= extremum_within;
  };
  std::erase_if(followed.passed, is_extremum);
  for (CriticalCurve* side : {&followed.falling, &followed.growing}) {
    std::erase_if(side->hits, is_extremum);
    const bool ends = side->stop == continuation::StopReason::event && side->hits.size() == 1;
    if (side->hits.empty() || ends) continue;
    const CriticalHit& first = side->hits.front();
    if (first.kind == hit.kind && first.point.s <= within_start)
      side->hits.erase(side->hits.begin());
  }
}

void note_passed_at_start(const std::vector<continuation::CriticalEvent>& events,
                          FollowedCurve& followed) {
  if (followed.growing.points.size() < 2 || followed.falling.points.size() < 2) return;
  const CriticalPoint &start = followed.growing.points.front(), &ahead = followed.growing.points[1],
                      &back = followed.falling.points[1];
  const auto is_met = [&](const CriticalHit& hit) {
    constexpr double within_start = 1e-6;  // extrema are located no better, marks far better
    return std::any_of(followed.passed.begin(), followed.passed.end(),
                       [&](const auto& known) {
                         return known.kind == hit.kind && known.name == hit.name;
                       }) ||
           std::ranges::any_of(
               std::array{&followed.growing, &followed.falling}, [&](const auto* side) {
                 return std::ranges::any_of(side->hits, [&](const CriticalHit& other) {
                   return other.kind == hit.kind && other.name == hit.name &&
                          other.point.s <= within_start;
                 });
               });
  };
  const auto add = [&](const CriticalHit& hit) {
    if (!is_met(hit)) followed.passed.push_back(hit);
  };
  const double rise = ahead.lambda - start.lambda, rise_back = back.lambda - start.lambda;
  // Of a load that stays the same all along rounding has a sign.
  const bool is_clear = std::min(std::abs(rise), std::abs(rise_back)) >
                        continuation::function_noise * std::max(1.0, std::abs(start.lambda));
  if (!followed.at_start && std::abs(start.dlambda) <= continuation::flat_rate && is_clear &&
      rise * rise_back > 0)
    add({.kind = Degeneracy::extremum, .name = "", .point = start});
  for (const continuation::CriticalEvent& event : events) {
    if (event.action != continuation::EventAction::record) continue;
    const double before = event.value(back), here = event.value(start), behind = event.value(ahead);
    const double size = std::max(std::abs(before), std::abs(behind));
    if (std::abs(here) <= continuation::function_noise * size && before * behind < 0)
      add({.kind = Degeneracy::user, .name = event.name, .point = start, .tag = event.tag});
  }
}

const CriticalPoint* point_at(const FollowedCurve& followed, double s) {
  for (const double sign : {1.0, -1.0}) {
    const CriticalCurve& side = sign > 0 ? followed.growing : followed.falling;
    for (const CriticalHit& hit : side.hits)
      if (hit.point.s == sign * s) return &hit.point;
    for (const CriticalPoint& point : side.points)
      if (point.s == sign * s) return &point;
  }
  return nullptr;
}

Branch rows_of(const CaseCurves& curves, const FollowedCurve& followed) {
  Branch branch;
  std::vector<Row> rows = side_of(followed.falling, -1);
  std::reverse(rows.begin(), rows.end());
  branch.start_row = rows.size();
  const bool started = !followed.growing.points.empty();
  if (started && (followed.at_start || followed.passed.empty()))
    rows.push_back(
        {followed.growing.points.front(), followed.at_start ? &*followed.at_start : nullptr});
  for (const CriticalHit& hit : followed.passed) rows.push_back({hit.point, &hit});
  for (Row& row : side_of(followed.growing, 1)) rows.push_back(std::move(row));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Member* member = curves.equations_at(rows[i].point.mu);
    if (member == nullptr) continue;
    auto point = CaseCurves::point_of(rows[i].point, followed.start.piece);
    Sample sample{member->evaluator().values(member->quantities(), point),
                  piece_text(member->setup.system, followed.start.piece), ""};
    count_other_modes(*member, followed.start, point, sample.values);
    for (const auto& [name, value] : curves.held()) sample.values.push_back(value);
    sample.values.push_back(rows[i].point.mu * curves.scale());
    branch.samples.push_back(std::move(sample));
    const bool is_edge = i == 0 || i + 1 == rows.size();
    if (rows[i].hit == nullptr && !is_edge) continue;
    const Stop stop = critical_stop(i == 0 ? followed.falling : followed.growing);
    Event event{.kind = stop.complete ? EventKind::end_of_range : EventKind::unresolved,
                .detail = stop.reason,
                .row = branch.samples.size() - 1};
    if (rows[i].hit != nullptr && (!is_edge || rows[i].hit->kind != Degeneracy::user)) {
      event.kind = kind_of(rows[i].hit->kind, followed.of);
      event.detail = event.kind == EventKind::switching ? switch_of(*rows[i].hit)
                                                        : detail_of(*rows[i].hit, followed.of);
    }
    event.rates_before.assign(branch.samples.back().values.size(),
                              std::numeric_limits<double>::quiet_NaN());
    event.rates_after = event.rates_before;
    branch.events.push_back(std::move(event));
  }
  branch.backward = critical_stop(followed.falling);
  branch.forward = critical_stop(followed.growing);
  return branch;
}

void label_critical(std::vector<Branch>& branches) {
  std::map<std::string, int> counts;
  for (Branch& branch : branches)
    for (Event& event : branch.events) {
      const std::string code = code_of(event.kind);
      event.label = code + std::to_string(++counts[code]);
      std::string& shown = branch.samples[event.row].event;
      if (shown.empty()) shown = event.label;
    }
}

}  // namespace springfold::analysis
