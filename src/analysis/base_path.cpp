#include "base_path.hpp"

#include <algorithm>
#include <cmath>

#include "branch_rows.hpp"
#include "closure_rank.hpp"
#include "grow_diagram.hpp"
#include "held_twice.hpp"
#include "infinite_force.hpp"
#include "lambda_crawl.hpp"
#include "limits.hpp"
#include "merged_hits.hpp"
#include "settle_units.hpp"
#include "springfold/continuation/newton.hpp"
#include "springfold/continuation/trace.hpp"
#include "stability_changes.hpp"
#include "start_hits.hpp"
#include "switching_starts.hpp"
#include "within_limits.hpp"
#include "zero_lengths.hpp"

namespace springfold::analysis {
namespace {

using continuation::CriticalKind;
using continuation::CriticalStart;
using continuation::Curve;
using continuation::CurvePoint;
using continuation::Direction;
using continuation::Hit;

/// So many points are kept behind the last special point that is asked for: narrow places are judged from both sides.
constexpr int points_behind = 8;

/// The special point of the engine that became this event: the same arc length on the same side.
const Hit* hit_at(const Curve& curve, double s) {
  for (const Hit& hit : curve.hits)
    if (hit.point.s == s) return &hit;
  return nullptr;
}

/// A rate along the curve through a state, whose tangent has the sense of one at the special point.
using RateAt = std::function<double(const Member&, const CurvePoint&)>;
continuation::StateFunction rate_of(const CaseCurves& curves, Piece piece, Direction sense,
                                    RateAt rate) {
  return [&curves, piece = std::move(piece), sense = std::move(sense), rate = std::move(rate)](
             const Vector& x, double lambda, double mu) -> std::optional<double> {
    const Member* member = curves.equations_at(mu);
    if (member == nullptr) return std::nullopt;
    continuation::Linearisation at;
    const PathProblem& problem = *member->problem;
    if (!continuation::linearise_densely(problem, x, lambda, piece, at)) return std::nullopt;
    const auto tangent = continuation::tangent_at(at, problem.metric(), sense);
    if (!tangent) return std::nullopt;
    return rate(*member, {.x = x, .lambda = lambda, .tangent = *tangent, .piece = piece});
  };
}

/// d(force)/ds, the other way round where lambda falls.
continuation::StateFunction force_rate_of(const CaseCurves& curves, const CurvePoint& at) {
  return rate_of(curves, at.piece, {Vector::Zero(at.x.size()), 1},
                 [](const Member& member, const CurvePoint& point) {
                   return member.evaluator().force_rate(point).value;
                 });
}

/// The rate of the column whose extremum the point is. Its curve may turn back in lambda: the tangent's sense is the
/// one there.
continuation::StateFunction column_rate_of(const CaseCurves& curves, const CurvePoint& at,
                                           const std::string& column) {
  return rate_of(curves, at.piece, at.tangent,
                 [column](const Member& member, const CurvePoint& point) {
                   return member.evaluator().rate(*member.quantity(column), point).value;
                 });
}

/// Which of the study's extrema is this?
std::string column_of_extremum(const Study& study, const Hit& hit) {
  for (const std::string& name : study.extrema)
    if (hit.name == extremum_name(name)) return name;
  return {};
}

/// The study's marks of a quantity whose value is this one, by their numbers.
std::vector<std::size_t> marks_at(const Study& study, const QuantityDefinition& quantity,
                                  double value) {
  constexpr double same = 1e-9;  // marks are located far better
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < study.marks.size(); ++k)
    if (study.marks[k].quantity == quantity.name &&
        std::abs(study.marks[k].value - value) < same * quantity.scale)
      found.push_back(k);
  return found;
}

/// Marks may be formulas of the parameter: do these have one value beside the member, too?
bool stay_together(const CaseCurves& curves, const Member& member,
                   const std::vector<std::size_t>& marks) {
  if (marks.size() < 2) return true;
  const double value = member.study.marks[marks.front()].value;
  const Member* beside = curves.equations_at(member.mu + step_of_family);
  return beside == nullptr || std::all_of(marks.begin(), marks.end(), [&](std::size_t k) {
           return member.study.marks[k].value == value &&
                  beside->study.marks[k].value == beside->study.marks[marks.front()].value;
         });
}

/// A column less the mark that the special point is, or less its value there. @param piece  on which states are taken
continuation::StateFunction column_of(const CaseCurves& curves, const Member& member,
                                      const SpecialPoint& point, const Piece& piece) {
  const QuantityDefinition* quantity = member.quantity(point.hit.name);
  if (quantity == nullptr) return {};
  const auto value_at = [name = point.hit.name](const Member& at, const Vector& x, double lambda,
                                                const Piece& on) {
    return at.evaluator().value(*at.quantity(name), {.x = x, .lambda = lambda, .piece = on});
  };
  const CurvePoint& here = point.hit.point;
  const double located = value_at(member, here.x, here.lambda, here.piece);
  const std::vector<std::size_t> marks = marks_at(member.study, *quantity, located);
  // The mark itself, as the member has it, not what was located; that of an earlier study is a number.
  const bool is_own = member.study.name == curves.base().study.name;
  if (is_own && !stay_together(curves, member, marks)) return {};
  const auto wanted = [is_own, marks,
                       value = marks.empty() ? located : member.study.marks[marks.front()].value](
                          const Member& at) {
    return is_own && !marks.empty() ? at.study.marks[marks.front()].value : value;
  };
  return [&curves, value_at, wanted, piece, scale = quantity->scale](
             const Vector& x, double lambda, double mu) -> std::optional<double> {
    const Member* at = curves.equations_at(mu);
    if (at == nullptr) return std::nullopt;
    return (value_at(*at, x, lambda, piece) - wanted(*at)) / scale;
  };
}

/// Of the special points at the start that which the event shows; nothing where there is none.
const Hit* hit_at_start(const std::vector<Hit>& hits, EventKind kind) {
  const auto same = std::find_if(hits.begin(), hits.end(),
                                 [kind](const Hit& hit) { return kind_of(hit) == kind; });
  if (same != hits.end()) return &*same;
  return hits.empty() ? nullptr : &hits.front();
}

/// The place of a special point, to be followed.
CriticalStart start_at(const Member& member, const SpecialPoint& point) {
  const CurvePoint& p = point.hit.point;
  return {.x = p.x, .lambda = p.lambda, .mu = member.mu, .piece = p.piece};
}

}  // namespace

std::string early_ends(const Branch& branch) {
  std::string text;
  for (const Stop& stop : {branch.forward, branch.backward})
    if (!stop.complete && text.find(stop.reason) == std::string::npos)
      text += (text.empty() ? "; it stopped early: " : ", and: ") + stop.reason;
  return text;
}

void refuse_start(const BasePath& path, StartReport& report) {
  report.found = false;
  report.message = path.problem;
  report.where = path.where;
  report.advice = path.advice;
}

namespace {

/// A branch point at which one chain is stretched is one like others; where the closures of all chains lose rank
/// together what branches there is not known.
EventKind kind_of_path(const PathProblem& problem, const Event& event, const Hit& hit) {
  const bool branches = event.kind == EventKind::kinematic_singularity &&
                        hit.kind == continuation::HitKind::branch_point &&
                        !kinematic_singularity(problem, hit.point);
  return branches ? EventKind::branch_point : event.kind;
}

/// The two ways out of the start, that of growing lambda first. Empty: `path` says why there are none.
std::vector<continuation::Ray> ways_from_start(const Member& member, const Study& study,
                                               BasePath& path) {
  const PathProblem& problem = *member.problem;
  const CurvePoint start = member.start();
  if (const auto outside = outside_start(study, member.evaluator(), member.quantities(), start)) {
    path.problem = outside->text;
    path.where = "until." + outside->quantity;
    path.advice = outside_advice;
    return {};
  }
  continuation::Rays rays =
      rays_from(problem, start.x, start.lambda, start.piece, options_of(study.trace));
  if (rays.rays.size() != 2 || !rays.complete) {
    path.problem = "the start is not an ordinary point of a curve";
    if (!holds_twice(problem, study, start)) return {};
    path.problem = held_twice;
    path.where = "control";
    path.advice = held_twice_advice;
    return {};
  }
  if (rays.rays[0].tangent.dlambda < rays.rays[1].tangent.dlambda)
    std::swap(rays.rays[0], rays.rays[1]);
  return std::move(rays.rays);
}

/// The two curves of a path as they are to be read.
struct PathCurves {
  Curve forward{}, backward{};
};

/// Rows and special points of the path along its curves.
void put_rows(const Following& with, bool forward_only, PathCurves curves, BasePath& path) {
  if (with.study.critical.stability == StabilityOf::dead_load)
    add_stability_changes(with, curves.forward, curves.backward);
  const auto forward_end = end_at_zero_length(with.problem, curves.forward);
  const auto backward_end = end_at_zero_length(with.problem, curves.backward);
  BranchSource source{.backward = curves.backward, .forward = curves.forward};
  source.forward_stop = forward_end.value_or(stop_of(curves.forward));
  source.backward_stop =
      forward_only ? source.forward_stop : backward_end.value_or(stop_of(curves.backward));
  // Where the curve turns back upon itself the path leads no further.
  if (curves.forward.stop == continuation::StopReason::turns_upon_itself)
    source.forward_stop.complete = false;
  source.at_start = hits_at_start(with, source);
  const std::vector<Hit> on_start = source.at_start;
  std::vector<BranchRows> rows{
      join(std::move(source), with.evaluator, with.quantities, with.problem)};
  label_events(rows, 0, with.quantities);
  path.branch = std::move(rows.front().branch);
  // A path that several pieces continue ends at a kink, which is the special point.
  const auto is_end_at_kink = [&](const Event& event) {
    return event.kind == EventKind::unresolved &&
           std::any_of(path.branch.events.begin(), path.branch.events.end(),
                       [&](const Event& other) {
                         return other.kind == EventKind::branching_kink && other.row == event.row;
                       });
  };
  for (const Event& event : path.branch.events) {
    const double s = path.branch.samples[event.row].values.front();
    const Hit* hit = s < 0   ? hit_at(curves.backward, -s)
                     : s > 0 ? hit_at(curves.forward, s)
                             : hit_at_start(on_start, event.kind);
    // What is not looked for from the start on.
    if (hit == nullptr && s == 0 && event.kind == EventKind::unresolved)
      hit = hit_at(curves.forward, s);
    if (hit != nullptr && event.kind != EventKind::end_of_range && !is_end_at_kink(event))
      path.points.push_back(
          {event.label, kind_of_path(with.problem, event, *hit), event.row, *hit});
  }
  path.forward = std::move(curves.forward);
}

}  // namespace

BasePath base_path(const Member& member, const Observer& observer, const PathOptions& options) {
  BasePath path;
  const WayOn* const way = options.way;
  const Study& study = options.within != nullptr ? *options.within : member.study;
  const PathProblem& problem = *member.problem;
  const CurvePoint start = way != nullptr ? way->from : member.start();
  const continuation::TraceOptions tracing = options_of(study.trace);
  const std::vector<continuation::Ray> rays =
      way == nullptr ? ways_from_start(member, study, path) : std::vector<continuation::Ray>{};
  if (way == nullptr && rays.empty()) return path;
  const auto events = events_of(study, member.evaluator(), member.quantities());
  int points = 0;
  LambdaCrawl crawl(problem, options.largest_unit, range_of_lambda(study, member.setup));
  crawl.begin(way != nullptr ? start.tangent : rays[0].tangent);
  int left = points_behind;
  Crawl seen = Crawl::none;
  InfiniteForceWatch forces(problem, events);
  const auto observe = [&](const CurvePoint& p) {
    if (path.is_enough && left-- == 0) return false;
    if (forces.sees(p)) return false;
    seen = crawl.sees(p);
    return seen == Crawl::none && (!observer || observer(++points, p.s));
  };
  const auto at_hit = [&](const Hit& hit) {
    path.is_enough = path.is_enough || (options.enough && options.enough(hit));
    return true;
  };
  const Following with{problem, study, member.evaluator(), member.quantities()};
  const auto follow = [&](const continuation::Ray* ray) {
    Curve curve = ray != nullptr
                      ? trace_within_limits(with, start, *ray, events, tracing, observe, at_hit)
                      : curve_within_limits(with, *way, events, tracing, observe);
    if (seen == Crawl::without_bound) end_without_bound(curve);
    forces.end(curve, tracing);
    return curve;
  };
  Curve forward = follow(way != nullptr ? nullptr : &rays[0]);
  Curve backward =
      options.forward_only || forward.stop == continuation::StopReason::closed || crawl.factor() > 1
          ? nothing_behind(forward)
          : follow(&rays[1]);
  path.lambda_unit = crawl.factor();
  if (path.lambda_unit > 1) return path;
  put_rows(with, options.forward_only,
           {with_hits_merged(std::move(forward), with.evaluator),
            with_hits_merged(std::move(backward), with.evaluator)},
           path);
  return path;
}

CurvesWithPath curves_with_path(const Study& study, std::size_t parameter, bool forward_only,
                                const Observer& observer) {
  CurvesWithPath result;
  for (;;) {
    result.curves = std::make_unique<CaseCurves>(study, parameter, result.lambda_unit);
    if (!result.curves->base().report.found) return result;
    const Member& base = result.curves->base();
    const bool in_parts = std::isfinite(base.setup.rule.lambda_measure.linear);
    const double largest = in_parts ? 1 : largest_change_of_lambda_unit / result.lambda_unit;
    result.path =
        base_path(base, observer, {.forward_only = forward_only, .largest_unit = largest});
    if (!(result.path.lambda_unit > 1)) return result;
    result.lambda_unit *= result.path.lambda_unit;
  }
}

continuation::StateFunction marked_value_on(const CaseCurves& curves, const Member& member,
                                            const SpecialPoint& point, const Piece& piece) {
  const Hit& hit = point.hit;
  if (hit.tag != column_extremum) return column_of(curves, member, point, piece);
  CurvePoint there = hit.point;
  there.piece = piece;
  return column_rate_of(curves, there, column_of_extremum(member.study, hit));
}

std::optional<CriticalStart> critical_start(const CaseCurves& curves, const Member& member,
                                            const SpecialPoint& point, std::string& why) {
  const Hit& hit = point.hit;
  CriticalStart start = start_at(member, point);
  if (!is_at_switching(point.kind)) start.resting = switches_at_rest(member, point);
  switch (point.kind) {
    case EventKind::limit_point:
      if (hit.kind == continuation::HitKind::limit_point) return start;
      start.kind = CriticalKind::zero;
      start.value = force_rate_of(curves, hit.point);
      return start;
    case EventKind::branch_point:
      start.kind = CriticalKind::branch_point;
      start.corank = hit.multiplicity;
      if (auto turn = hilltop_start(curves.family(), start, hit.point.tangent)) return turn;
      return start;
    case EventKind::switching:
    case EventKind::corner_limit_point:
    case EventKind::branching_kink:
      if (way_at_rest(member, point)) return start_at_rest(curves, member, point, why);
      if (auto starts = starts_at_switching(curves, point, start); starts.size() == 1)
        return std::move(starts.front());
      why = several_switch(point);
      return std::nullopt;
    case EventKind::user_value:
      start.kind = CriticalKind::zero;
      start.value = marked_value_on(curves, member, point, hit.point.piece);
      if (start.value) return start;
      if (member.quantity(hit.name) == nullptr) break;
      why = point.label + ": several marks of " + hit.name +
            " have one value in the case, and the parameter parts them";
      return std::nullopt;
    default:
      break;
  }
  why = point.label +
        " is of a kind that is not followed: need a limit point, branch point, corner, " +
        "activation, marked value or extremum";
  return std::nullopt;
}

std::vector<CriticalStart> critical_starts(const CaseCurves& curves, const Member& member,
                                           const SpecialPoint& point, std::string& why) {
  if (is_at_switching(point.kind) && !way_at_rest(member, point)) {
    auto starts = starts_at_switching(curves, point, start_at(member, point));
    if (starts.empty()) why = several_switch(point);
    return starts;
  }
  auto start = critical_start(curves, member, point, why);
  if (!start) return {};
  return {std::move(*start)};
}

std::vector<CriticalStart> critical_starts_again(const CaseCurves& curves, const Member& member,
                                                 const SpecialPoint& point, CriticalStart same) {
  if (same.kind == CriticalKind::zero) {
    const CurvePoint here{.x = same.x, .lambda = same.lambda, .piece = same.piece};
    same.value = point.kind == EventKind::limit_point
                     ? force_rate_of(curves, here)
                     : marked_value_on(curves, member, point, same.piece);
  }
  if (same.kind != CriticalKind::surface) return {std::move(same)};
  if (same.turns) same.turns = force_turns(curves);
  std::vector<Index> switches;
  for (std::size_t j = 0; j < same.piece.size(); ++j)
    if (same.piece[j] != same.behind[j]) switches.push_back(static_cast<Index>(j));
  return starts_on_surfaces(curves, switches, std::move(same));
}

}  // namespace springfold::analysis
