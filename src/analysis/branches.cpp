#include "branches.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "branch_rows.hpp"
#include "grow_diagram.hpp"
#include "number_text.hpp"

namespace springfold::analysis {
namespace {

using continuation::Curve;
using continuation::CurvePoint;
using continuation::Diagram;
using continuation::DiagramStart;
using continuation::Hit;
using continuation::HitKind;
using continuation::StopReason;

double distance(const PathProblem& problem, const CurvePoint& a, const CurvePoint& b) {
  Vector d = b.x.cwiseProduct(continuation::nearest_signs(problem.double_covers(), b.x, a.x)) - a.x;
  const Vector periods = problem.periods(), weights = problem.metric();
  for (Index i = 0; i < d.size(); ++i)
    if (periods[i] > 0) d[i] = std::remainder(d[i], periods[i]);
  return std::sqrt(d.cwiseProduct(weights).dot(d) + std::pow(b.lambda - a.lambda, 2));
}

/// Cosine of the angle between two directions.
double cosine(const PathProblem& problem, const CurvePoint& a, CurvePoint b) {
  b.tangent.dx =
      b.tangent.dx.cwiseProduct(continuation::nearest_signs(problem.double_covers(), b.x, a.x));
  const auto product = [&](const CurvePoint& p, const CurvePoint& q) {
    return p.tangent.dx.cwiseProduct(problem.metric()).dot(q.tangent.dx) +
           p.tangent.dlambda * q.tangent.dlambda;
  };
  return product(a, b) / std::sqrt(product(a, a) * product(b, b));
}

EventKind kind_of_junction(HitKind kind) {
  Hit hit;
  hit.kind = kind;
  return kind_of(hit);
}

/// The engine's sentence "... at lambda = 0.25" with lambda in the units of the case.
std::string in_units(const std::string& sentence, double lambda_scale) {
  const std::string words = " at lambda = ";
  const std::size_t at = sentence.rfind(words);
  if (at == std::string::npos) return sentence;
  double lambda = 0;
  const char* begin = sentence.data() + at + words.size();
  const char* end = sentence.data() + sentence.size();
  if (std::from_chars(begin, end, lambda).ptr != end) return sentence;
  return sentence.substr(0, at) + words + rounded(lambda_scale * lambda);
}

/// Translates a diagram into a result.
class Writer {
 public:
  Writer(const Tracing& tracing, const Grown& grown, StudyResult& result)
      : t_{tracing}, diagram_{grown.diagram}, start_{grown.starts.front()}, result_{result} {}

  void write() {
    number_branches();
    std::vector<BranchRows> rows;
    for (const std::vector<int>& group : groups_) rows.push_back(rows_of(group));
    const auto labels = label_events(rows, diagram_.junctions.size(), t_.quantities);
    for (BranchRows& r : rows) result_.branches.push_back(std::move(r.branch));
    write_junctions(labels);
    write_start();
    for (std::size_t i = 0; i < result_.branches.size(); ++i) describe(i, labels);
    result_.doubts = diagram_.doubts;
    // The last one: what the bounds leave out. It is counted by the junctions and no doubt.
    if (diagram_.not_followed > 0) result_.doubts.pop_back();
    for (std::string& doubt : result_.doubts) doubt = in_units(doubt, t_.lambda_scale);
  }

 private:
  /// The two curves that leave an ordinary start become one branch, every other curve is its own.
  void number_branches() {
    const auto& branches = diagram_.branches;
    number_.assign(branches.size(), 0);
    for (std::size_t i = 0; i < branches.size(); ++i) {
      const int start = branches[i].start;
      const auto same = [start](const auto& b) { return b.start == start; };
      const auto count = std::count_if(branches.begin(), branches.end(), same);
      const auto first = static_cast<std::size_t>(
          std::find_if(branches.begin(), branches.end(), same) - branches.begin());
      if (start >= 0 && count == 2 && first < i) {
        number_[i] = number_[first];
        groups_[static_cast<std::size_t>(number_[i] - 1)].push_back(static_cast<int>(i));
      } else {
        groups_.push_back({static_cast<int>(i)});
        number_[i] = static_cast<int>(groups_.size());
      }
    }
  }

  const continuation::Branch& traced(int i) const {
    return diagram_.branches[static_cast<std::size_t>(i)];
  }
  int number_of(int branch) const {
    return branch < 0 ? 0 : number_[static_cast<std::size_t>(branch)];
  }

  int junction_of(const Hit& hit) const {
    if (hit.kind != HitKind::branch_point && hit.kind != HitKind::touch &&
        hit.kind != HitKind::branching_kink)
      return -1;
    const double scale = std::max({1.0, hit.point.x.norm(), std::abs(hit.point.lambda)});
    for (std::size_t i = 0; i < diagram_.junctions.size(); ++i)
      if (distance(t_.problem, diagram_.junctions[i].point, hit.point) <=
          continuation::DiagramOptions{}.same_place * scale)
        return static_cast<int>(i);
    return -1;
  }

  /// Why a curve of a branch ended; joined and branching ends name the branches that go on.
  Stop end_of(const Curve& curve, int own) const {
    Stop stop = stop_of(curve);
    if (curve.hits.empty()) return stop;
    const Hit& last = curve.hits.back();
    const int number = junction_of(last);
    if (number < 0) return stop;
    const continuation::Junction& junction = diagram_.junctions[static_cast<std::size_t>(number)];
    if (curve.stop == StopReason::joined) {
      int on = 0;
      double best = 0;
      for (const continuation::Way& way : junction.ways) {
        const double c = cosine(t_.problem, way.point, last.point);
        if (c > best && way.branch >= 0) {
          best = c;
          on = number_of(way.branch);
        }
      }
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
    source.junction_of = [this](const Hit& hit) { return junction_of(hit); };
    const int origin = traced(group[0]).junction;
    if (origin >= 0) {
      source.origin = origin;
      source.origin_kind =
          kind_of_junction(diagram_.junctions[static_cast<std::size_t>(origin)].kind);
      source.backward_stop = {"", true};  // said by describe()
    } else if (group.size() == 1 && source.forward.stop != StopReason::closed) {
      source.backward_stop = {"the start, which several curves leave", true};
    }
    add_between(t_, source);
    return join(std::move(source), t_.evaluator, t_.quantities, t_.problem);
  }

  /// Number of the branch on which a junction was met first; 0: it is a start itself.
  int met_on(std::size_t junction) const {
    if (diagram_.junctions[junction].depth < 0) return 0;
    for (std::size_t i = 0; i < diagram_.branches.size(); ++i)
      for (const Hit& hit : diagram_.branches[i].curve.hits)
        if (junction_of(hit) == static_cast<int>(junction)) return number_[i];
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

  /// Lists the ways out of a start that is no ordinary point of a curve.
  void write_start() {
    const auto add = [this](const CurvePoint& along, int branch) {
      result_.start.ways.push_back({t_.evaluator.rates(t_.quantities, along), number_of(branch)});
    };
    for (const continuation::Junction& junction : diagram_.junctions) {
      const CurvePoint start{.x = start_.x, .lambda = start_.lambda};
      if (junction.depth >= 0 || distance(t_.problem, junction.point, start) > 1e-9) continue;
      result_.start.situation = "a branch point";
      for (const continuation::Way& way : junction.ways) add(way.point, way.branch);
      return;
    }
    std::vector<int> own;
    for (std::size_t i = 0; i < diagram_.branches.size(); ++i)
      if (diagram_.branches[i].start == 0) own.push_back(static_cast<int>(i));
    const bool closed = own.size() == 1 && traced(own[0]).curve.stop == StopReason::closed;
    std::string& situation = result_.start.situation;
    if (own.size() != 2 && !closed)
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
    if (from.junction < 0) return;
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
  const DiagramStart& start_;  ///< the study's own
  StudyResult& result_;
  std::vector<int> number_{};               ///< per curve of the diagram: its branch, from 1
  std::vector<std::vector<int>> groups_{};  ///< per branch: its one or two curves
};

}  // namespace

void trace_branches(const Tracing& tracing, const CurvePoint& start, StudyResult& result) {
  const Grown grown = grow_diagram(tracing, start);
  result.searches = grown.searches;
  Writer(tracing, grown, result).write();
}

}  // namespace springfold::analysis
