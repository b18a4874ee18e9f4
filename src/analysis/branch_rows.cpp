#include "branch_rows.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace springfold::analysis {
namespace {

using continuation::Curve;
using continuation::CurvePoint;
using continuation::Hit;
using continuation::HitKind;
using continuation::StopReason;

/// A row to be: a point, and the special point that it belongs to.
struct Entry {
  CurvePoint point{};
  const Hit* hit = nullptr;
  bool leaving = false;  ///< second row of a kink
};

EventKind kind_of(const Hit& hit) {
  switch (hit.kind) {
    case HitKind::limit_point:
      return EventKind::limit_point;
    case HitKind::branch_point:
      return EventKind::branch_point;
    case HitKind::kink:
      return EventKind::switching;
    case HitKind::corner:
      return EventKind::corner_limit_point;
    case HitKind::branching_kink:
      return EventKind::branching_kink;
    case HitKind::touch:
      return EventKind::touch;
    case HitKind::family:
      return EventKind::family;
    case HitKind::user:
      return hit.name == force_limit ? EventKind::limit_point : EventKind::user_value;
    case HitKind::unresolved:
      return EventKind::unresolved;
  }
  return EventKind::unresolved;
}

/// Points and special points of one direction in the order of s, without the start.
std::vector<Entry> entries_of(const Curve& curve) {
  std::vector<Entry> entries;
  std::size_t h = 0;
  const auto add_hit = [&entries](const Hit& hit) {
    entries.push_back({hit.point, &hit, false});
    // Where there are several ways out the trace ended and none of them belongs to this branch.
    if (hit.leaving.size() == 1) entries.push_back({hit.leaving.front(), &hit, true});
  };
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    while (h < curve.hits.size() && curve.hits[h].point.s <= curve.points[i].s)
      add_hit(curve.hits[h++]);
    entries.push_back({curve.points[i], nullptr, false});
  }
  while (h < curve.hits.size()) add_hit(curve.hits[h++]);
  return entries;
}

/// The same curve walked the other way: s and tangents change sign, kinks swap their sides.
std::vector<Entry> reversed(std::vector<Entry> entries) {
  std::reverse(entries.begin(), entries.end());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    Entry& e = entries[i];
    e.point.s = -e.point.s;
    e.point.tangent.dx = -e.point.tangent.dx;
    e.point.tangent.dlambda = -e.point.tangent.dlambda;
    const bool pair = i + 1 < entries.size() && e.leaving && entries[i + 1].hit == e.hit;
    if (pair) {
      e.leaving = false;
      entries[i + 1].leaving = true;
    }
  }
  return entries;
}

std::string switching_detail(const statics::System& system, const Hit& hit, const Piece& before,
                             const Piece& after) {
  std::string text;
  for (const Index j : hit.switches) {
    const statics::CoordinateSpring& spring =
        system.springs[system.switches[static_cast<std::size_t>(j)].spring];
    const std::size_t from = segment_of(spring, before), to = segment_of(spring, after);
    const double k_from = spring.law.segments[from].stiffness;
    const double k_to = spring.law.segments[to].stiffness;
    const char* word = k_from == 0 && k_to > 0   ? "becomes active"
                       : k_from > 0 && k_to == 0 ? "is released"
                       : k_to > k_from           ? "gets stiffer"
                                                 : "gets softer";
    text += (text.empty() ? "spring " : ", spring ") + spring.name + " " + word + " (segment " +
            std::to_string(from) + " to " + std::to_string(to) + ")";
  }
  return text;
}

/// Does the force turn back at a switching although it is regular on both sides?
bool turns_back(const Event& event, const std::vector<QuantityDefinition>& quantities) {
  for (std::size_t q = 0; q < quantities.size(); ++q)
    if (quantities[q].kind == QuantityDefinition::Kind::force)
      return event.rates_before[q] * event.rates_after[q] < 0;
  return false;
}

Stop stop_of(const Curve& curve) {
  Stop stop;
  stop.reason = std::string(to_string(curve.stop));
  if (!curve.stop_detail.empty()) stop.reason += ": " + curve.stop_detail;
  stop.complete = curve.stop == StopReason::event;
  return stop;
}

void append_log(const Curve& curve, double sign, std::vector<StepNote>& log) {
  for (const continuation::StepNote& note : curve.log)
    log.push_back({sign * note.s, sign * note.step, note.reason});
}

/// Numbers the events: LP1, LP2, ..., counted from the first row.
void label_events(Branch& branch) {
  std::map<std::string, int> counts;
  for (Event& event : branch.events) {
    const std::string code = code_of(event.kind);
    event.label = code + std::to_string(++counts[code]);
    branch.samples[event.row].event = event.label;
    const bool two_rows =
        event.row + 1 < branch.samples.size() && !event.rates_after.empty() &&
        (event.kind == EventKind::switching || event.kind == EventKind::corner_limit_point ||
         event.kind == EventKind::branching_kink);
    if (two_rows) branch.samples[event.row + 1].event = event.label;
  }
}

/// At a critical point an eigenvalue is zero and the count undefined: there the smaller count of
/// the two sides is the number of negative eigenvalues.
void fill_indices(Branch& branch, const std::vector<QuantityDefinition>& quantities) {
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    const auto kind = quantities[q].kind;
    if (kind != QuantityDefinition::Kind::index && kind != QuantityDefinition::Kind::index_force &&
        kind != QuantityDefinition::Kind::index_pose)
      continue;
    for (std::size_t i = 0; i < branch.samples.size(); ++i) {
      double& value = branch.samples[i].values[q];
      if (!std::isnan(value) || branch.samples[i].event.empty()) continue;
      if (i > 0) value = branch.samples[i - 1].values[q];
      for (std::size_t k = i + 1; k < branch.samples.size(); ++k) {
        const double next = branch.samples[k].values[q];
        if (std::isnan(next)) continue;
        value = std::isnan(value) ? next : std::min(value, next);
        break;
      }
    }
  }
}

/// The two ends are events too.
void add_end(Branch& branch, const Entry& entry, std::size_t row, const Stop& stop,
             const Evaluator& evaluator, const std::vector<QuantityDefinition>& quantities) {
  Event event{.kind = stop.complete ? EventKind::end_of_range : EventKind::unresolved,
              .detail = stop.reason,
              .row = row};
  event.stiffness = evaluator.platform_stiffness(entry.point);
  event.rates_before = evaluator.rates(quantities, entry.point);
  event.rates_after = event.rates_before;
  const auto before = std::find_if(branch.events.begin(), branch.events.end(),
                                   [row](const Event& e) { return e.row >= row; });
  branch.events.insert(row == 0 ? branch.events.begin() : before, std::move(event));
}

}  // namespace

std::string piece_text(const statics::System& system, const Piece& piece) {
  std::string text;
  for (const statics::CoordinateSpring& spring : system.springs)
    if (!spring.law.breakpoints.empty())
      text += (text.empty() ? "" : ".") + std::to_string(segment_of(spring, piece));
  return text;
}

Branch single_point(const CurvePoint& start, const Evaluator& evaluator,
                    const std::vector<QuantityDefinition>& quantities, const PathProblem& problem) {
  Branch branch;
  branch.samples.push_back({evaluator.values(quantities, start),
                            piece_text(problem.system(start.lambda), start.piece), ""});
  return branch;
}

Branch join(const Curve& backward, const Curve& forward, const Evaluator& evaluator,
            const std::vector<QuantityDefinition>& quantities, const PathProblem& problem) {
  std::vector<Entry> entries = reversed(entries_of(backward));
  Branch branch;
  branch.start_row = entries.size();
  entries.push_back({forward.points.front(), nullptr, false});
  for (Entry& e : entries_of(forward)) entries.push_back(std::move(e));
  branch.backward = stop_of(backward);
  branch.forward = stop_of(forward);

  // A stopping event of the caller is the end of the range itself, not a marked value.
  const Hit* first_stop = backward.stop == StopReason::event && !backward.hits.empty()
                              ? &backward.hits.back()
                              : nullptr;
  const Hit* last_stop =
      forward.stop == StopReason::event && !forward.hits.empty() ? &forward.hits.back() : nullptr;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Entry& e = entries[i];
    const statics::System& system = problem.system(e.point.lambda);
    branch.samples.push_back(
        {evaluator.values(quantities, e.point), piece_text(system, e.point.piece), ""});
    if (e.hit == nullptr || e.leaving || e.hit == first_stop || e.hit == last_stop) continue;
    Event event{.kind = kind_of(*e.hit), .detail = e.hit->name, .row = i};
    if (e.hit->multiplicity > 1)
      event.detail += ", " + std::to_string(e.hit->multiplicity) + "-fold";
    event.stiffness = evaluator.platform_stiffness(e.point);
    event.rates_before = evaluator.rates(quantities, e.point);
    event.rates_after = event.rates_before;
    const bool pair = i + 1 < entries.size() && entries[i + 1].hit == e.hit;
    if (pair) {
      event.rates_after = evaluator.rates(quantities, entries[i + 1].point);
      event.detail = switching_detail(system, *e.hit, e.point.piece, entries[i + 1].point.piece);
      if (turns_back(event, quantities)) {
        event.kind = EventKind::corner_limit_point;
        event.detail += ", the force turns back";
      }
    }
    branch.events.push_back(std::move(event));
  }
  add_end(branch, entries.front(), 0, branch.backward, evaluator, quantities);
  if (entries.size() > 1)
    add_end(branch, entries.back(), entries.size() - 1, branch.forward, evaluator, quantities);
  label_events(branch);
  fill_indices(branch, quantities);
  append_log(backward, -1, branch.log);
  append_log(forward, 1, branch.log);
  return branch;
}

}  // namespace springfold::analysis
