#include "branch_rows.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "branch_entries.hpp"
#include "closure_rank.hpp"
#include "force_events.hpp"
#include "level_force.hpp"
#include "merged_hits.hpp"
#include "null_modes.hpp"
#include "row_indices.hpp"
#include "springfold/analysis/event_rows.hpp"
#include "springfold/continuation/numerics.hpp"
#include "switch_words.hpp"

namespace springfold::analysis {
namespace {

using continuation::Curve;
using continuation::CurvePoint;
using continuation::Hit;
using continuation::HitKind;
using continuation::StopReason;

/// Does the force turn back at a switching although it is regular on both sides? A rate that is nothing beside that on
/// the other side, at the end of a dead band, has no sign.
bool turns_back(const Event& event, const std::vector<QuantityDefinition>& quantities) {
  constexpr double rounding = 1e-12;
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    if (quantities[q].kind != QuantityDefinition::Kind::force) continue;
    const double before = event.rates_before[q], after = event.rates_after[q];
    const double least = rounding * std::max(std::abs(before), std::abs(after));
    return before * after < 0 && std::abs(before) > least && std::abs(after) > least;
  }
  return false;
}

/// Does lambda turn back where branches meet? The point is called after these. Along a family it stands still, and what
/// its rows differ by is rounding.
bool lambda_turns(const CurvePoint& before, const CurvePoint& here, const CurvePoint& behind) {
  const double rise = here.lambda - before.lambda, rise_behind = behind.lambda - here.lambda;
  const double size =
      std::max({std::abs(before.lambda), std::abs(here.lambda), std::abs(behind.lambda)});
  const bool stands_still =
      continuation::is_exact(std::min(std::abs(rise), std::abs(rise_behind)), size);
  return !stands_still && (rise < 0) != (rise_behind < 0);
}

/// Both curves as one, from the backward end on; nothing where their arcs were not tested.
std::optional<VerifiedArcs> arcs_of(const Curve& backward, const Curve& forward) {
  if (backward.arcs.empty() && forward.arcs.empty()) return std::nullopt;
  VerifiedArcs all;
  const auto add = [&all](double begin, double end, continuation::ArcEvidence evidence) {
    all.length += end - begin;
    if (evidence != continuation::ArcEvidence::sampled)
      all.verified += end - begin;
    else if (!all.sampled.empty() && all.sampled.back().s_end == begin)
      all.sampled.back().s_end = end;
    else
      all.sampled.push_back({begin, end});
  };
  for (std::size_t i = backward.arcs.size(); i-- > 0;)
    add(-backward.arcs[i].s_end, -backward.arcs[i].s_begin, backward.arcs[i].evidence);
  for (const continuation::Arc& arc : forward.arcs) add(arc.s_begin, arc.s_end, arc.evidence);
  return all;
}

void append_log(const Curve& curve, double sign, std::vector<StepNote>& log) {
  for (const continuation::StepNote& note : curve.log)
    log.push_back({sign * note.s, sign * note.step, note.reason});
}

/// Writes the labels of the events into their rows.
void mark_rows(Branch& branch) {
  for (const Event& event : branch.events) {
    branch.samples[event.row].event = event.label;
    const bool two_rows =
        event.row + 1 < branch.samples.size() && !event.rates_after.empty() &&
        (event.kind == EventKind::switching || event.kind == EventKind::corner_limit_point);
    if (two_rows) branch.samples[event.row + 1].event = event.label;
  }
}

/// An end of the branch is an event too.
Event end_event(const Entry& entry, std::size_t row, const Stop& stop, const Evaluator& evaluator,
                const std::vector<QuantityDefinition>& quantities) {
  Event event{.kind = stop.complete ? EventKind::end_of_range : EventKind::unresolved,
              .detail = stop.reason,
              .row = row};
  event.stiffness = evaluator.platform_stiffness(entry.point);
  event.compliance = evaluator.rigid_compliance(entry.point);
  event.rates_before = evaluator.rates(quantities, entry.point, &entry.turns);
  event.rates_after = event.rates_before;
  return event;
}

/// The modes of a branch point as rates of the quantities.
std::vector<std::vector<double>> modes_of(const Entry& entry, const Evaluator& evaluator,
                                          const std::vector<QuantityDefinition>& quantities,
                                          const PathProblem& problem) {
  std::vector<std::vector<double>> modes;
  CurvePoint point = entry.point;
  for (Vector& mode : null_modes(problem, entry.point, entry.hit->multiplicity)) {
    point.tangent = {std::move(mode), 0};
    modes.push_back(evaluator.rates(quantities, point, &entry.turns));
  }
  return modes;
}

/// A special point in its row; `next`: the row behind it, if there is one.
Event hit_event(const Entry& entry, std::size_t row, const Entry* next, const Evaluator& evaluator,
                const std::vector<QuantityDefinition>& quantities, const PathProblem& problem) {
  const Hit& hit = *entry.hit;
  Event event{.kind = kind_of(hit), .detail = hit.name, .row = row};
  if (hit.multiplicity > 1) event.detail += ", " + std::to_string(hit.multiplicity) + "-fold";
  event.stiffness = evaluator.platform_stiffness(entry.point);
  event.compliance = evaluator.rigid_compliance(entry.point);
  event.rates_before = evaluator.rates(quantities, entry.point, &entry.turns);
  event.rates_after = event.rates_before;
  if (hit.kind == HitKind::branch_point || hit.kind == HitKind::touch)
    event.modes = modes_of(entry, evaluator, quantities, problem);
  if (next == nullptr || next->hit != entry.hit) return event;
  event.rates_after = evaluator.rates(quantities, next->point, &next->turns);
  event.stiffness_after = evaluator.platform_stiffness(next->point);
  event.compliance_after = evaluator.rigid_compliance(next->point);
  if (hit.kind == HitKind::unresolved) return event;  // its name says why; perhaps nothing switches
  event.detail = switching_detail(problem.system(entry.point.lambda), hit, entry.point.piece,
                                  next->point.piece);
  // A fold that rounding does not tell from the kink belongs to it: the engine says what the whole passage is.
  const bool fold_belongs = evaluator.force_is_lambda() && hit.kind == HitKind::kink;
  if (!fold_belongs && turns_back(event, quantities)) {
    event.kind = EventKind::corner_limit_point;
    event.detail += ", the force turns back";
  }
  return event;
}

/// The chain whose closure has a lower rank here than at the rows before and behind: a kinematic
/// singularity. A rank that is low all along the branch is none.
std::optional<std::string> singular_chain(const Entry& before, const Entry& entry,
                                          const Entry& behind, const Evaluator& evaluator,
                                          const PathProblem& problem) {
  const auto a = evaluator.closure_ranks(before.point), here = evaluator.closure_ranks(entry.point),
             b = evaluator.closure_ranks(behind.point);
  for (std::size_t i = 0; i < here.size() && a.size() == here.size() && b.size() == here.size();
       ++i)
    if (here[i] < a[i] && here[i] < b[i])
      return problem.system(entry.point.lambda).mechanism.chains[i].name;
  return std::nullopt;
}

/// From where on closures that were taken as redundant contradict each other.
void refuse_contradictions(const std::vector<Entry>& entries, const Evaluator& evaluator,
                           Branch& branch) {
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (!closures_contradict(evaluator.problem(), entries[i].point)) continue;
    const std::string row = std::to_string(i);
    branch.forward = {"closures that were redundant at the start contradict each other at row " +
                          row + ": the chains do not fit there; " + branch.forward.reason,
                      false};
    return;
  }
}

/// The end at which the rows begin, in this order. Far points: those nearest to the quarters of the way, and the other
/// end.
template <class Iterator>
EndOfCurve end_of_curve(Iterator first, Iterator last) {
  const double begin = first->point.s, way = std::prev(last)->point.s - begin;
  const auto before =
      std::find_if(first, last, [begin](const Entry& e) { return e.point.s != begin; });
  EndOfCurve curve{first->point, before == last ? first->point : before->point, {}};
  for (const double part : {0.25, 0.5, 0.75, 1.0}) {
    const auto distance = [&](const Entry& e) { return std::abs(e.point.s - begin - part * way); };
    const auto nearest = std::min_element(
        first, last, [&](const Entry& a, const Entry& b) { return distance(a) < distance(b); });
    curve.far.push_back(&nearest->point);
  }
  return curve;
}

}  // namespace

BranchRows join(BranchSource source, const Evaluator& evaluator,
                const std::vector<QuantityDefinition>& quantities, const PathProblem& problem,
                const Asking* asking) {
  if (asking != nullptr && !asking->goes_on()) {
    source.is_thinned |= !source.backward_between.empty() || !source.forward_between.empty();
    source.backward_between.clear();
    source.forward_between.clear();
  }
  Curve backward = with_hits_merged(std::move(source.backward), evaluator);
  Curve forward = with_hits_merged(std::move(source.forward), evaluator);
  end_at_reach(backward, source.backward_between, source.backward_stop, problem);
  end_at_reach(forward, source.forward_between, source.forward_stop, problem);
  std::vector<Entry> entries = reversed(entries_of(backward, std::move(source.backward_between)));
  BranchRows rows;
  Branch& branch = rows.branch;
  branch.start_row = entries.size();
  for (std::vector<Entry> more : {entries_at(forward.points.front(), source.at_start),
                                  entries_of(forward, std::move(source.forward_between))})
    entries.insert(entries.end(), std::make_move_iterator(more.begin()),
                   std::make_move_iterator(more.end()));
  const bool is_whole = add_rows({evaluator, quantities, problem, asking}, entries, branch);
  branch.backward = explained(source.backward_stop, end_of_curve(entries.begin(), entries.end()),
                              backward, problem);
  branch.forward = explained(source.forward_stop, end_of_curve(entries.rbegin(), entries.rend()),
                             forward, problem);
  const auto add = [&rows](Event event, int junction) {
    rows.branch.events.push_back(std::move(event));
    rows.junctions.push_back(junction);
  };

  // A stopping event of the caller is the end of the range itself, not a marked value.
  const auto is_end = [](const Curve& curve, const Hit* hit) {
    return curve.stop == StopReason::event && !curve.hits.empty() && hit == &curve.hits.back();
  };
  // At a junction that ends the branch no second event is needed to say so.
  const auto ends_at_junction = [&](const Entry& e, const Stop& stop) {
    return e.hit != nullptr && stop.complete && e.hit->junction >= 0;
  };
  if (source.origin) {
    Event event = end_event(entries.front(), 0, branch.backward, evaluator, quantities);
    event.kind = source.origin_kind;
    add(std::move(event), *source.origin);
  } else if (!ends_at_junction(entries.front(), branch.backward) &&
             forward.stop != StopReason::closed) {
    add(end_event(entries.front(), 0, branch.backward, evaluator, quantities), -1);
  }
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Entry& e = entries[i];
    if (e.hit == nullptr || e.leaving || is_end(backward, e.hit) || is_end(forward, e.hit))
      continue;
    const Entry* next = i + 1 < entries.size() ? &entries[i + 1] : nullptr;
    Event event = hit_event(e, i, next, evaluator, quantities, problem);
    const bool first = i == 0, last = next == nullptr;
    if (is_meeting_of_branches(event.kind) && !first && !last &&
        lambda_turns(entries[i - 1].point, e.point, next->point))
      event.detail +=
          evaluator.force_is_lambda() ? ", the force turns back" : ", lambda turns back";
    const bool is_singular =
        event.kind == EventKind::branch_point || event.kind == EventKind::touch;
    if (const auto found = is_singular ? kinematic_singularity(problem, e.point) : std::nullopt) {
      event.kind = EventKind::kinematic_singularity;
      event.detail = *found;
    } else if (is_singular && !first && !last) {
      if (const auto chain = singular_chain(entries[i - 1], e, *next, evaluator, problem)) {
        event.kind = EventKind::kinematic_singularity;
        event.detail = "the closure of chain " + *chain + " loses rank; " + event.detail;
      }
    }
    if ((first || last) && ends_at_junction(e, first ? branch.backward : branch.forward))
      event.detail += (event.detail.empty() ? "" : ", ") +
                      (first ? branch.backward.reason : branch.forward.reason);
    add(std::move(event), e.hit->junction);
  }
  const std::size_t end = entries.size() - 1;
  if (end > 0 && !ends_at_junction(entries.back(), branch.forward)) {
    const auto before = std::find_if(branch.events.begin(), branch.events.end(),
                                     [end](const Event& e) { return e.row >= end; });
    rows.junctions.insert(rows.junctions.begin() + (before - branch.events.begin()), -1);
    branch.events.insert(before,
                         end_event(entries.back(), end, branch.forward, evaluator, quantities));
  }
  tell_level_extrema(entries, evaluator, branch);
  refuse_contradictions(entries, evaluator, branch);
  if (source.is_thinned || !is_whole)
    branch.forward = {
        "interrupted, so that rows between the steps are missing; " + branch.forward.reason, false};
  append_log(backward, -1, branch.log);
  append_log(forward, 1, branch.log);
  branch.arcs = arcs_of(backward, forward);
  return rows;
}

std::vector<JunctionLabel> label_events(std::vector<BranchRows>& all, std::size_t junctions,
                                        const std::vector<QuantityDefinition>& quantities) {
  std::map<std::string, int> counts;
  std::vector<JunctionLabel> labels(junctions);
  for (auto& [branch, numbers] : all) {
    for (std::size_t i = 0; i < branch.events.size(); ++i) {
      Event& event = branch.events[i];
      JunctionLabel* junction =
          numbers[i] < 0 ? nullptr : &labels[static_cast<std::size_t>(numbers[i])];
      if (junction != nullptr && !junction->label.empty()) {
        event.kind = junction->kind;
        event.label = junction->label;
        continue;
      }
      const std::string code = code_of(event.kind);
      event.label = code + std::to_string(++counts[code]);
      if (junction != nullptr) *junction = {event.label, event.kind};
    }
    mark_rows(branch);
    fill_indices(branch, quantities);
  }
  return labels;
}

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
      return hit.tag == force_limit                                    ? EventKind::limit_point
             : hit.tag == dead_load_change || hit.tag == driven_change ? EventKind::stability_change
                                                                       : EventKind::user_value;
    case HitKind::unresolved:
    case HitKind::inexact:  // joined to the point before it, see merged_hits.hpp
      return EventKind::unresolved;
  }
  return EventKind::unresolved;
}

}  // namespace springfold::analysis
