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
#include "within_limits.hpp"
#include "zero_lengths.hpp"

namespace springfold::analysis {
namespace {

using continuation::Curve;
using continuation::CurvePoint;
using continuation::Hit;

/// So many points are kept behind the last special point that is asked for: narrow places are judged from both sides.
constexpr int points_behind = 8;

/// The special point of the engine that became this event: the same arc length on the same side.
const Hit* hit_at(const Curve& curve, double s) {
  for (const Hit& hit : curve.hits)
    if (hit.point.s == s) return &hit;
  return nullptr;
}

/// Of the special points at the start that which the event shows; nothing where there is none.
const Hit* hit_at_start(const std::vector<Hit>& hits, EventKind kind) {
  const auto same = std::find_if(hits.begin(), hits.end(),
                                 [kind](const Hit& hit) { return kind_of(hit) == kind; });
  if (same != hits.end()) return &*same;
  return hits.empty() ? nullptr : &hits.front();
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

double growth_of_lambda_unit(const Member& base, double lambda_unit) {
  const bool in_parts = std::isfinite(base.setup.rule.lambda_measure.linear);
  return in_parts ? 1 : largest_change_of_lambda_unit / lambda_unit;
}

CurvesWithPath curves_with_path(const Study& study, std::size_t parameter, bool forward_only,
                                const Observer& observer) {
  CurvesWithPath result;
  for (;;) {
    result.curves = std::make_unique<CaseCurves>(study, parameter, result.lambda_unit);
    if (!result.curves->base().report.found) return result;
    const Member& base = result.curves->base();
    result.path = base_path(base, observer,
                            {.forward_only = forward_only,
                             .largest_unit = growth_of_lambda_unit(base, result.lambda_unit)});
    if (!(result.path.lambda_unit > 1)) return result;
    result.lambda_unit *= result.path.lambda_unit;
  }
}

}  // namespace springfold::analysis
