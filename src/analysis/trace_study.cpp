#include "trace_study.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "branch_rows.hpp"
#include "branches.hpp"
#include "closure_rank.hpp"
#include "degenerate_state.hpp"
#include "infinite_force.hpp"
#include "lambda_crawl.hpp"
#include "limits.hpp"
#include "run_traced.hpp"
#include "springfold/continuation/newton.hpp"
#include "springfold/continuation/trace.hpp"
#include "springfold/core/decompositions.hpp"
#include "stability_changes.hpp"
#include "start.hpp"
#include "start_hits.hpp"
#include "start_marks.hpp"
#include "within_limits.hpp"
#include "zero_lengths.hpp"

namespace springfold::analysis {

using continuation::CurvePoint;

namespace {

/// The branch through an ordinary start point alone.
Branch trace_both_ways(const Tracing& t, const CurvePoint& start, continuation::Rays rays) {
  const continuation::TraceOptions options = options_of(t.study.trace);
  // Forward is where lambda grows.
  if (rays.rays[0].tangent.dlambda < rays.rays[1].tangent.dlambda)
    std::swap(rays.rays[0], rays.rays[1]);
  const auto events = events_of(t.study, t.evaluator, t.quantities);
  int points = 1;
  Crawl crawl = Crawl::none;
  InfiniteForceWatch forces(t.problem, events);
  const auto observe = [&](double sign) {
    return [&points, &crawl, &forces, &t, sign](const CurvePoint& point) {
      ++points;
      if (forces.sees(point)) return false;
      crawl = t.crawl.sees(point);
      if (crawl != Crawl::none) return false;
      return !t.observer || t.observer(points, sign * point.s);
    };
  };
  const AskedProblem asked(t.problem, t.asking);
  const Following with{t.problem, t.study, t.evaluator, t.quantities, &asked};
  const auto follow = [&](const continuation::Ray& ray, double sign) {
    continuation::Curve curve =
        trace_within_limits(with, start, ray, events, options, observe(sign));
    if (crawl == Crawl::without_bound) end_without_bound(curve);
    forces.end(curve, options);
    return curve;
  };
  BranchSource source;
  source.forward = follow(rays.rays[0], 1);
  source.backward = source.forward.stop == continuation::StopReason::closed
                        ? nothing_behind(source.forward)
                        : follow(rays.rays[1], -1);
  source.forward_stop = stop_of(source.forward);
  source.backward_stop = stop_of(source.backward);
  source.at_start = hits_at_start(with, source);
  end_at_zero_lengths(t, source);
  add_stability_changes(with, source.forward, source.backward);
  add_between(t, source);
  const CurvePoint first = source.forward.points.front();
  std::vector<BranchRows> rows{
      join(std::move(source), t.evaluator, t.quantities, t.problem, &t.asking)};
  add_marks_at_start(t.study, t.evaluator, t.quantities, first, rows.front());
  label_events(rows, 0, t.quantities);
  return std::move(rows.front().branch);
}

Branch not_traced(const Tracing& t, const CurvePoint& start, const std::string& why) {
  Branch branch = single_point(start, t.evaluator, t.quantities, t.problem);
  branch.forward = branch.backward = {why, false};
  return branch;
}

std::string motions_text(const StartReport& start) {
  return start.free_motions.empty() ? ""
                                    : "; nothing resists a motion of " + start.free_motions +
                                          ": give a joint that moves there a spring, or hold it";
}

std::string why_not_ordinary(const continuation::Rays& rays) {
  return rays.why.empty() ? std::to_string(rays.rays.size()) + " ways lead out of it" : rays.why;
}

/// Do forces alone change along the direction that the equations leave at the start? What is driven is rigid there.
bool only_forces_change(const PathProblem& problem, const CurvePoint& start) {
  continuation::Linearisation at;
  if (!continuation::linearise_densely(problem, start.x, start.lambda, start.piece, at))
    return false;
  const Index n = start.x.size();
  Matrix J(n, n + 1);
  J << at.dF_dx, at.dF_dlambda;
  const Vector way = jacobi_svd(J, SingularVectors::none, SingularVectors::full).V.col(n);
  const Vector moves = problem.metric().cwiseSqrt().cwiseProduct(way.head(n));
  return std::hypot(moves.norm(), way[n]) <= same_rank;
}

constexpr const char* rigid_where_driven =
    "what is driven is rigid here: forces alone can change, as where links are stretched out along "
    "the drive; with control = \"load\" the state is followed through its buckling load, and a "
    "start a little off the straight one, or an elastic link, has a curve";

/// Slopes at the start, on both sides.
void report_rates(const Tracing& t, const CurvePoint& start, const continuation::Rays& rays,
                  StartReport& report) {
  const bool swapped = rays.rays[0].tangent.dlambda < rays.rays[1].tangent.dlambda;
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
    const continuation::Ray& ray = rays.rays[i];
    const bool leaving = (i == 0) != swapped;
    CurvePoint along = start;
    along.piece = ray.piece;
    along.tangent = ray.tangent;
    if (!leaving) {
      along.tangent.dx = -along.tangent.dx;
      along.tangent.dlambda = -along.tangent.dlambda;
    }
    (leaving ? report.rates_after : report.rates_before) = t.evaluator.rates(t.quantities, along);
  }
}

}  // namespace

std::string situation_of(const Tracing& t, const CurvePoint& start,
                         const continuation::Rays& rays) {
  Vector g;
  std::string names;
  if (t.problem.switches(start.x, start.lambda, g))
    for (Index j = 0; j < g.size(); ++j)
      if (std::abs(g[j]) <= 1e-10) names += (names.empty() ? "" : ", ") + t.problem.switch_name(j);
  if (!names.empty()) return "on the threshold of " + names;
  const bool turns =
      !rays.rays.empty() && std::all_of(rays.rays.begin(), rays.rays.end(), [](const auto& ray) {
        return std::abs(ray.tangent.dlambda) < 1e-6;
      });
  if (!turns || rays.rays.size() != 2) return "";
  // In another unit of lambda every curve is steep: at a limit point the stiffness is singular.
  CurvePoint point = start;
  count_negative(t.problem, point);
  return !t.problem.symmetric() || is_degenerate(t.problem, point) ? "a limit point" : "";
}

void trace_study(const Tracing& t, const CurvePoint& start, StudyResult& result) {
  const BranchSettings& wanted = t.study.branches;
  const auto rays =
      rays_from(t.problem, start.x, start.lambda, start.piece, options_of(t.study.trace));
  const bool ordinary = rays.rays.size() == 2 && rays.complete;
  if (ordinary) t.crawl.begin(rays.rays.front().tangent);
  if (ordinary) report_rates(t, start, rays, result.start);
  result.start.situation = situation_of(t, start, rays);
  const auto outside = limit_passed(t.study, t.evaluator, t.quantities, start);
  if (ordinary && (outside || (wanted.depth == 0 && wanted.search_at.empty()))) {
    if (!result.start.situation.empty())
      for (const continuation::Ray& ray : rays.rays) {
        CurvePoint along = start;
        along.tangent = ray.tangent;
        along.piece = ray.piece;
        result.start.ways.push_back({t.evaluator.rates(t.quantities, along), 1});
      }
    result.branches.push_back(trace_both_ways(t, start, rays));
    return;
  }
  const auto singular = kinematic_singularity(t.problem, start);
  if (outside || t.study.path == Path::davidenko) {
    result.branches.push_back(not_traced(t, start,
                                         "the start is not an ordinary point of a curve: " +
                                             why_not_ordinary(rays) + motions_text(result.start)));
  } else {
    trace_branches(t, start, result);
    if (result.branches.empty()) add_branch_of_start(t, start, result);
  }
  if (singular) result.start.situation = "a " + *singular;
}

void add_branch_of_start(const Tracing& t, const CurvePoint& start, StudyResult& result) {
  if (t.asking.was_stopped())
    return result.branches.push_back(not_traced(t, start, "interrupted at the start"));
  const auto rays =
      rays_from(t.problem, start.x, start.lambda, start.piece, options_of(t.study.trace));
  const std::string why =
      t.study.control != ControlMode::load && only_forces_change(t.problem, start)
          ? rigid_where_driven
          : why_not_ordinary(rays);
  result.branches.push_back(not_traced(
      t, start, "no curve was found to leave the start: " + why + motions_text(result.start)));
}

}  // namespace springfold::analysis
