// The study kind `critical_curve`, and what the kinds of two parameters have in common.
#include <algorithm>
#include <cmath>

#include "cpu_time.hpp"
#include "critical_rows.hpp"
#include "critical_runs.hpp"
#include "run_kinds.hpp"

namespace springfold::analysis {
namespace {

std::string list_of(const BasePath& path) {
  std::string names;
  for (const SpecialPoint& point : path.points) names += (names.empty() ? "" : ", ") + point.label;
  return names.empty() ? "none" : names;
}

/// A parameter that breaks the branch makes limit points of its branch point: their curve leads through it.
FollowedCurve limit_points_through(const CaseCurves& curves, const Study& study,
                                   continuation::CriticalStart start, const Observer& observer) {
  if (const auto exact = polish_critical(curves.family(), start)) {
    start.x = exact->x;
    start.lambda = exact->lambda;
  }
  start.kind = continuation::CriticalKind::limit_point;
  return follow_both_ways(curves, base_study(study), start, EventKind::limit_point, observer);
}

void mark_branch_point(const SpecialPoint& point, Branch& branch) {
  const std::size_t columns = branch.samples.front().values.size();
  Event event{
      .kind = EventKind::branch_point,
      .detail = point.label + " of the case: limit points of its imperfect versions meet here",
      .row = branch.start_row,
      .rates_before = std::vector<double>(columns, std::nan("")),
      .rates_after = std::vector<double>(columns, std::nan(""))};
  const auto behind = std::find_if(branch.events.begin(), branch.events.end(),
                                   [&](const Event& e) { return e.row > branch.start_row; });
  branch.events.insert(behind, std::move(event));
}

void run_curve(const CaseCurves& curves, const Study& study, const Observer& observer,
               StudyResult& result) {
  const Member& base = curves.base();
  const BasePath path = base_path(base, false, observer);
  const auto point =
      std::find_if(path.points.begin(), path.points.end(),
                   [&](const SpecialPoint& p) { return p.label == study.critical.point; });
  if (!path.problem.empty()) return refuse_start(path, result.start);
  std::string why;
  if (point == path.points.end())
    why = "the curve has no " + study.critical.point + "; its special points: " + list_of(path) +
          early_ends(path.branch);
  std::optional<continuation::CriticalStart> start;
  if (why.empty()) start = critical_start(curves, base, *point, why);
  if (!start) {
    result.start.found = false;
    result.start.message = why;
    return;
  }
  FollowedCurve followed =
      follow_both_ways(curves, base_study(study), *start, point->kind, observer);
  const bool is_broken = start->kind == continuation::CriticalKind::branch_point &&
                         start->corank == 1 && !followed.growing.kept &&
                         !critical_rate(curves.family(), *start);
  if (is_broken) followed = limit_points_through(curves, study, *start, observer);
  result.doubts = doubts_of(curves, study, followed);
  result.branches.push_back(rows_of(curves, followed));
  if (is_broken && !result.branches.front().samples.empty())
    mark_branch_point(*point, result.branches.front());
  label_critical(result.branches);
  if (result.branches.front().samples.empty()) {
    result.branches.clear();
    result.start.found = false;
    result.start.message = point->label + ": " + critical_stop(followed.growing).reason;
  }
}

}  // namespace

Study base_study(const Study& study) {
  Study curve = study;
  curve.kind = StudyKind::force_deflection;
  return curve;
}

StudyResult run_critical(const Study& study, const Observer& observer) {
  const double began = thread_seconds();
  StudyResult result;
  result.study = study.name;
  if (study.kind == StudyKind::sensitivity) {
    run_sensitivity(study, observer, result);
  } else if (study.kind == StudyKind::design) {
    run_design(study, observer, result);
  } else {
    const auto& names = study.critical.cases->names;
    const auto number = static_cast<std::size_t>(
        std::find(names.begin(), names.end(), study.critical.parameter) - names.begin());
    const CaseCurves curves(study, number);
    result.start = curves.base().report;
    if (result.start.found) {
      result.quantities = critical_quantities(curves);
      result.lambda_unit = lambda_unit_of(curves.base().study, curves.base().setup.system);
      if (study.kind == StudyKind::threshold)
        run_threshold(curves, study, observer, result);
      else if (study.kind == StudyKind::critical_load)
        run_critical_load(curves, study, observer, result);
      else
        run_curve(curves, study, observer, result);
    }
  }
  result.seconds = thread_seconds() - began;
  return result;
}

}  // namespace springfold::analysis
