#include "branches.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "branch_rows.hpp"
#include "grow_diagram.hpp"
#include "springfold/core/number_text.hpp"
#include "stability_changes.hpp"
#include "start_hits.hpp"
#include "start_marks.hpp"
#include "trace_study.hpp"
#include "zero_lengths.hpp"

namespace springfold::analysis {
namespace {

using continuation::Curve;
using continuation::CurvePoint;
using continuation::Diagram;
using continuation::DiagramStart;
using continuation::Hit;
using continuation::HitKind;
using continuation::StopReason;

EventKind kind_of_junction(HitKind kind) {
  Hit hit;
  hit.kind = kind;
  return kind_of(hit);
}

/// A doubt in words, with lambda in the units of the case.
std::string text_of(const continuation::Doubt& doubt, double lambda_scale) {
  if (!doubt.place) return doubt.text;
  return doubt.text + " at lambda = " + rounded(lambda_scale * doubt.place->lambda);
}

/// Translates a diagram into a result.
class Writer {
 public:
  Writer(const Tracing& tracing, const Grown& grown, StudyResult& result)
      : t_{tracing}, diagram_{grown.diagram}, result_{result} {}

  void write() {
    number_branches();
    std::vector<BranchRows> rows;
    for (const std::vector<int>& group : groups_) rows.push_back(rows_of(group));
    const auto labels = label_events(rows, diagram_.junctions.size(), t_.quantities);
    for (BranchRows& r : rows) result_.branches.push_back(std::move(r.branch));
    write_junctions(labels);
    write_start();
    for (std::size_t i = 0; i < result_.branches.size(); ++i) describe(i, labels);
    // An ordinary kink at the start is one curve.
    std::erase_if(result_.junctions,
                  [](const Junction& junction) { return junction.kind == EventKind::switching; });
    for (const continuation::Doubt& doubt : diagram_.doubts) {
      // What the bounds leave out is counted by the junctions; branches say themselves why they end.
      const bool said = doubt.kind == continuation::DoubtKind::bounds ||
                        doubt.kind == continuation::DoubtKind::stopped_early;
      if (!said) result_.doubts.push_back(text_of(doubt, t_.lambda_scale));
    }
  }

 private:
  /// The two curves that leave an ordinary start become one branch, and so do the first two that leave a start that is
  /// a branch point in opposite directions: a branch passes through it as it does anywhere else. Every other curve is
  /// its own.
  void number_branches() {
    const std::size_t count = diagram_.branches.size();
    number_.assign(count, 0);
    through_.assign(diagram_.junctions.size(), 0);
    for (std::size_t i = 0; i < count; ++i) {
      const auto first = goes_on_behind(i);
      if (first) {
        number_[i] = number_[*first];
        groups_[static_cast<std::size_t>(number_[i] - 1)].push_back(static_cast<int>(i));
        const int junction = diagram_.branches[i].junction;
        if (junction >= 0) through_[static_cast<std::size_t>(junction)] = number_[i];
      } else {
        groups_.push_back({static_cast<int>(i)});
        number_[i] = static_cast<int>(groups_.size());
      }
    }
  }

  /// The curve before this one that leaves the same start on the other side; nothing if there is none.
  std::optional<std::size_t> goes_on_behind(std::size_t i) const {
    const auto& branches = diagram_.branches;
    const auto from = [](const continuation::Branch& b) { return std::pair{b.start, b.junction}; };
    const auto& own = branches[i];
    std::vector<std::size_t> others;
    for (std::size_t k = 0; k < branches.size(); ++k)
      if (k != i && from(branches[k]) == from(own)) others.push_back(k);
    if (own.start >= 0)
      return others.size() == 1 && others[0] < i ? std::optional(others[0]) : std::nullopt;
    if (own.junction < 0) return std::nullopt;
    const auto j = static_cast<std::size_t>(own.junction);
    const auto& junction = diagram_.junctions[j];
    if (junction.start < 0 || junction.kind != HitKind::branch_point || through_[j] > 0)
      return std::nullopt;
    for (const std::size_t k : others)
      if (k < i && are_opposite(branches[k].curve, own.curve)) return k;
    return std::nullopt;
  }

  static bool are_opposite(const Curve& a, const Curve& b) {
    constexpr double one_line = 1e-6;  // tangents at branch points are told to the root of rounding
    if (a.points.size() < 2 || b.points.size() < 2) return false;
    const auto &s = a.points.front().tangent, &t = b.points.front().tangent;
    return s.dx.dot(t.dx) + s.dlambda * t.dlambda < -(1 - one_line) * norm_of(s) * norm_of(t);
  }
  static double norm_of(const continuation::Direction& t) {
    return std::hypot(t.dx.norm(), t.dlambda);
  }

  /// A start that is a branch point, seen from a branch that passes through it.
  Hit hit_of(int junction, const Curve& forward) const {
    const auto& from = diagram_.junctions[static_cast<std::size_t>(junction)];
    Hit hit{.kind = from.kind, .name = "branch point", .point = forward.points.front()};
    hit.point.negative.reset();
    hit.multiplicity = from.multiplicity;
    hit.junction = junction;
    return hit;
  }

  const continuation::Branch& traced(int i) const {
    return diagram_.branches[static_cast<std::size_t>(i)];
  }
  int number_of(int branch) const {
    return branch < 0 ? 0 : number_[static_cast<std::size_t>(branch)];
  }

  /// Why a curve of a branch ended; joined and branching ends name the branches that go on.
  Stop end_of(const Curve& curve, int own) const {
    Stop stop = stop_of(curve, t_.study.branches.depth > 0);
    if (curve.hits.empty()) return stop;
    const Hit& last = curve.hits.back();
    if (last.junction < 0) return stop;
    const auto& junction = diagram_.junctions[static_cast<std::size_t>(last.junction)];
    if (curve.stop == StopReason::joined && last.way_on >= 0) {
      const int on = number_of(junction.ways[static_cast<std::size_t>(last.way_on)].branch);
      if (on == own) return {"closed: back at the point where it begins", true};
      if (on > 0) return {"goes on along branch " + std::to_string(on), true};
    }
    if (curve.stop == StopReason::several_ways && last.kind == HitKind::branching_kink)
      return {std::to_string(junction.ways.size() - 1) + " ways lead on", junction.complete};
    return stop;
  }

  BranchRows rows_of(const std::vector<int>& group) const {
    BranchSource source;
    source.forward = traced(group[0]).curve;
    source.backward = group.size() > 1 ? traced(group[1]).curve : nothing_behind(source.forward);
    if (group.size() > 1 && source.forward.points.front().tangent.dlambda <
                                source.backward.points.front().tangent.dlambda)
      std::swap(source.forward, source.backward);
    const int own = number_of(group[0]);
    source.forward_stop = end_of(source.forward, own);
    source.backward_stop = group.size() > 1 ? end_of(source.backward, own) : source.forward_stop;
    const int junction = traced(group[0]).junction, origin = group.size() > 1 ? -1 : junction;
    if (group.size() > 1 && junction >= 0)
      source.at_start = {hit_of(junction, source.forward)};
    else if (group.size() > 1 || (origin < 0 && source.forward.stop == StopReason::closed))
      source.at_start = hits_at_start({t_.problem, t_.study, t_.evaluator, t_.quantities}, source);
    if (origin >= 0) {
      source.origin = origin;
      source.origin_kind =
          kind_of_junction(diagram_.junctions[static_cast<std::size_t>(origin)].kind);
      source.backward_stop = {"", true};  // said by describe()
    } else if (group.size() == 1 && source.forward.stop != StopReason::closed) {
      source.backward_stop = t_.asking.was_stopped()
                                 ? Stop{"interrupted at the start", false}
                                 : Stop{"the start, which several curves leave", true};
    }
    end_at_zero_lengths(t_, source);
    add_stability_changes({t_.problem, t_.study, t_.evaluator, t_.quantities}, source.forward,
                          source.backward);
    add_between(t_, source);
    const bool has_start = origin < 0 && (junction >= 0 || traced(group[0]).start == 0);
    const CurvePoint first = source.forward.points.front();
    BranchRows rows = join(std::move(source), t_.evaluator, t_.quantities, t_.problem, &t_.asking);
    if (has_start) add_marks_at_start(t_.study, t_.evaluator, t_.quantities, first, rows);
    return rows;
  }

  /// Number of the branch on which a junction was met first, or which passes through it; 0: a start, which none does.
  int met_on(std::size_t junction) const {
    if (diagram_.junctions[junction].depth < 0) return through_[junction];
    for (std::size_t i = 0; i < diagram_.branches.size(); ++i)
      for (const Hit& hit : diagram_.branches[i].curve.hits)
        if (hit.junction == static_cast<int>(junction)) return number_[i];
    return 0;
  }

  void write_junctions(const std::vector<JunctionLabel>& labels) {
    for (std::size_t i = 0; i < diagram_.junctions.size(); ++i) {
      const continuation::Junction& from = diagram_.junctions[i];
      const bool is_shown = !labels[i].label.empty();
      Junction junction{.kind = is_shown ? labels[i].kind : kind_of_junction(from.kind),
                        .label = labels[i].label,
                        .branch = met_on(i),
                        .multiplicity = from.multiplicity};
      for (const continuation::Way& way : from.ways) junction.ways.push_back(number_of(way.branch));
      junction.complete = from.complete;
      junction.why = from.why;
      result_.junctions.push_back(std::move(junction));
    }
  }

  /// Two ways alone are one curve: the springs that switch there say what is special about it.
  std::string situation_at(const continuation::Junction& start) const {
    if (start.kind == HitKind::branching_kink) return "a branching kink";
    if (start.kind == HitKind::branch_point) return "a branch point";
    const std::string resting = situation_of(t_, start.point, {});
    return resting.empty() ? result_.start.situation : resting;
  }

  /// Lists the ways out of a start that is no ordinary point of a curve.
  void write_start() {
    const auto add = [this](const CurvePoint& along, int branch) {
      result_.start.ways.push_back({t_.evaluator.rates(t_.quantities, along), number_of(branch)});
    };
    for (const continuation::Junction& junction : diagram_.junctions) {
      if (junction.start != 0) continue;
      result_.start.situation = situation_at(junction);
      for (const continuation::Way& way : junction.ways) add(way.point, way.branch);
      return;
    }
    std::vector<int> own;
    for (std::size_t i = 0; i < diagram_.branches.size(); ++i)
      if (diagram_.branches[i].start == 0) own.push_back(static_cast<int>(i));
    const bool closed = own.size() == 1 && traced(own[0]).curve.stop == StopReason::closed;
    std::string& situation = result_.start.situation;
    if (own.size() != 2 && !closed && !t_.asking.was_stopped())
      situation = (own.empty() ? "a point that no curve leaves" : "a branching kink") +
                  (situation.empty() ? "" : ", " + situation);
    if (situation.empty()) return;
    for (const int i : own) add(traced(i).curve.points.front(), i);
  }

  void describe(std::size_t i, const std::vector<JunctionLabel>& labels) {
    const continuation::Branch& from = traced(groups_[i].front());
    Branch& branch = result_.branches[i];
    branch.depth = from.depth;
    branch.start = std::max(from.start, 0);
    if (from.junction < 0 || groups_[i].size() > 1) return;
    const auto j = static_cast<std::size_t>(from.junction);
    branch.origin = labels[j].label;
    branch.origin_branch = result_.junctions[j].branch;
    branch.backward.reason =
        "begins at " + branch.origin +
        (branch.origin_branch > 0 ? " of branch " + std::to_string(branch.origin_branch)
                                  : ", the start");
    branch.events.front().detail = branch.backward.reason;
  }

  const Tracing& t_;
  const Diagram& diagram_;
  StudyResult& result_;
  std::vector<int> number_{};               ///< per curve of the diagram: its branch, from 1
  std::vector<std::vector<int>> groups_{};  ///< per branch: its one or two curves
  std::vector<int>
      through_{};  ///< per junction that is a start: the branch that passes through it, or 0
};

}  // namespace

void trace_branches(const Tracing& tracing, const CurvePoint& start, StudyResult& result,
                    const std::vector<DiagramStart>& landings) {
  const Grown grown = grow_diagram(tracing, start, landings);
  result.searches = grown.searches;
  Writer(tracing, grown, result).write();
  result.doubts.insert(result.doubts.end(), grown.doubts.begin(), grown.doubts.end());
}

}  // namespace springfold::analysis
