// What the study kinds of two parameters have in common: the case's own path, and where the case may be given.
#include <algorithm>
#include <cmath>

#include "cpu_time.hpp"
#include "critical_runs.hpp"
#include "run_kinds.hpp"
#include "springfold/core/number_text.hpp"

namespace springfold::analysis {
namespace {

/// As far as ends of ranges are located, of the parameter.
constexpr double at_end = 1e-6;

/// Least and largest value of the parameter in the rows, and in the case.
std::pair<double, double> reach_of(const CaseCurves& curves, const StudyResult& result) {
  double low = curves.value(), high = curves.value();
  for (const Branch& branch : result.branches)
    for (const Sample& sample : branch.samples) {
      low = std::min(low, sample.values.back());
      high = std::max(high, sample.values.back());
    }
  return {low, high};
}

/// Rows beyond the rules, of a range that was asked for, are told where the range ends; a curve that does not come to
/// that end has a doubt.
void doubt_rows_beyond_rules(const CaseCurves& curves, const CriticalPointSettings& asked,
                             StudyResult& result) {
  const RuledRange& rules = curves.rules();
  const auto [low, high] = reach_of(curves, result);
  const double room = at_end * std::max(1.0, curves.scale());
  RuledRange untold = rules;
  if (low >= rules.low || low <= asked.low + room) untold.below.clear();
  if (high <= rules.high || high >= asked.high - room) untold.above.clear();
  for (const std::string& text : words_of_beyond(untold, curves.name()))
    result.doubts.push_back("the curve goes beyond what the case may be given with: " + text);
}

/// A threshold is a value that the case may be given with; first critical loads are told over all of the range that is
/// asked for.
void run_over_range(CaseCurves& curves, const Study& study, std::size_t parameter,
                    const Observer& observer, StudyResult& result) {
  const CriticalPointSettings& asked = study.critical;
  const RuledRange rules = range_within_rules(*asked.cases, parameter, asked.low, asked.high);
  curves.end_at_rules(rules);
  if (study.kind == StudyKind::critical_load) {
    run_critical_load(curves, study, observer, result);
    return doubt_rows_beyond_rules(curves, asked, result);
  }
  Study within = study;
  within.critical.low = rules.low;
  within.critical.high = rules.high;
  const auto left_out = words_of_cut(rules, curves.name(), asked.low, asked.high);
  if (!(rules.low < rules.high)) {
    result.start.found = false;
    result.start.message = "no case of the range may be given: " + left_out.front();
    result.start.where = std::string{to_string(study.kind)} + ".range";
    return;
  }
  run_threshold(curves, within, observer, result);
  ThresholdReport& report = *result.threshold;
  for (const std::string& text : left_out) report.message += "; " + text;
  const std::string rule =
      report.found ? broken_rule_at(*asked.cases, parameter, report.value) : std::string{};
  if (!rule.empty())
    result.doubts.push_back("the case may not be given at " + curves.name() + " = " +
                            rounded(report.value) + ": " + rule);
}

std::size_t number_of_parameter(const Study& study) {
  const auto& names = study.critical.cases->names;
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), study.critical.parameter) -
                                  names.begin());
}

}  // namespace

Study base_study(const Study& study) {
  Study curve = study;
  curve.kind = StudyKind::force_deflection;
  return curve;
}

CurveRun begin_critical_curve(const Study& study, const Observer& observer) {
  CurveRun run{.study = study};
  StudyResult& result = run.result;
  result.study = study.name;
  CurvesWithPath begun = curves_with_path(study, number_of_parameter(study), false, observer);
  run.curves = std::move(begun.curves);
  run.of_point = run.curves;
  result.start = run.curves->base().report;
  if (!result.start.found) return run;
  const Member& base = run.curves->base();
  result.quantities = critical_quantities(*run.curves);
  result.lambda_unit = lambda_unit_of(base.study, base.setup.system);
  if (auto origin = origin_on_path(*run.curves, begun.path, study, result.start))
    run.origin = std::move(*origin);
  return run;
}

/// Ends that are asked for are kept, and it is told where the case may not be given before them. A curve may
/// also have no range but that in which the case may be given: where it has been behind its end, it is followed
/// again.
void follow_within_rules(CurveRun& run, const Observer& observer) {
  CaseCurves& curves = *run.curves;
  const Study& study = run.study;
  StudyResult& result = run.result;
  const CaseFamily& cases = *study.critical.cases;
  const std::size_t parameter = number_of_parameter(study);
  const CriticalPointSettings& asked = study.critical;
  const bool is_open_below = !std::isfinite(asked.low), is_open_above = !std::isfinite(asked.high);
  curves.end_at_rules(range_within_rules(cases, parameter,
                                         is_open_below ? curves.value() : asked.low,
                                         is_open_above ? curves.value() : asked.high));
  const StudyResult before = result;
  run.pieces = run_critical_curve(curves, run.origin, study, observer, result);
  if (!is_open_below && !is_open_above) return doubt_rows_beyond_rules(curves, asked, result);
  const auto [low, high] = reach_of(curves, result);
  RuledRange rules = range_within_rules(cases, parameter, is_open_below ? low : curves.value(),
                                        is_open_above ? high : curves.value());
  if (!rules.is_cut()) return doubt_rows_beyond_rules(curves, asked, result);
  Study within = study;
  if (!rules.below.empty()) within.critical.low = rules.low;
  if (!rules.above.empty()) within.critical.high = rules.high;
  if (!is_open_below) rules.low = curves.rules().low, rules.below = curves.rules().below;
  if (!is_open_above) rules.high = curves.rules().high, rules.above = curves.rules().above;
  curves.end_at_rules(rules);
  result = before;
  run.pieces = run_critical_curve(curves, run.origin, within, observer, result);
  doubt_rows_beyond_rules(curves, within.critical, result);
}

StudyResult run_critical(const Study& study, const Observer& observer) {
  const double began = thread_seconds();
  StudyResult result;
  result.study = study.name;
  if (study.kind == StudyKind::sensitivity) {
    run_sensitivity(study, observer, result);
  } else if (study.kind == StudyKind::design) {
    run_design(study, observer, result);
  } else if (study.kind == StudyKind::critical_curve) {
    CurveRun run = begin_critical_curve(study, observer);
    if (run.result.start.found) follow_within_rules(run, observer);
    result = std::move(run.result);
  } else {
    const std::size_t number = number_of_parameter(study);
    const CurvesWithPath begun = curves_with_path(study, number, true, observer);
    CaseCurves& curves = *begun.curves;
    result.start = curves.base().report;
    if (result.start.found) {
      result.quantities = critical_quantities(curves);
      result.lambda_unit = lambda_unit_of(curves.base().study, curves.base().setup.system);
      run_over_range(curves, study, number, observer, result);
    }
  }
  result.seconds = thread_seconds() - began;
  return result;
}

}  // namespace springfold::analysis
