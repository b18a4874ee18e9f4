// What a figure shows where the case does not say it.
#include <algorithm>

#include "figure.hpp"
#include "result_access.hpp"
#include "sweep_points.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

using analysis::Branch;
using analysis::StudyResult;

/// Quantities of a figure without [[plot]]: of curves of special points lambda over their parameter, otherwise
/// force over deflection, or lambda over the first coordinate of the pose.
PlotSpec default_plot(const Case& the_case, const StudyResult& result) {
  PlotSpec spec{.name = safe_file_name(result.study), .title = result.study};
  spec.curves.push_back({.study = result.study});
  if (column_of(result, "path")) {  // commands along a path: what the first one compensates
    spec.x = "path";
    for (const auto& quantity : result.quantities)
      if (quantity.name.ends_with(".compensation")) {
        spec.y = quantity.name;
        return spec;
      }
  }
  const PlannedRun* planned = plan_of(the_case, result);
  using analysis::StudyKind;
  const StudyKind kind = planned == nullptr ? StudyKind::force_deflection : planned->plan.kind;
  if (is_curve_of_points(kind)) {
    spec.x = planned->plan.critical.parameter;
    spec.y = "lambda";
    spec.shade = kind == StudyKind::critical_load &&
                 planned->plan.control != analysis::ControlMode::parameter &&
                 planned->varied.empty();
    return spec;
  }
  if (column_of(result, "deflection") && column_of(result, "force")) return spec;
  spec.y = "lambda";
  const bool has_body = planned != nullptr && !planned->mechanism.bodies.empty();
  spec.x = has_body ? planned->mechanism.bodies.front().name + ".x" : "s";
  return spec;
}

/// The special points of a study over the one number that it varies, if there are any to compare.
void add_point_spec(const SweepPoints& sweep, const PlotSpec& of_curves,
                    std::vector<PlotSpec>& specs) {
  if (sweep.parameters.size() != 1) return;
  PlotSpec spec{.name = safe_file_name(sweep.study) + "-points",
                .title = sweep.study + ": special points",
                .x = parameter_prefix + sweep.parameters.front(),
                .y = of_curves.y};
  spec.curves.push_back({.study = sweep.study});
  specs.push_back(std::move(spec));
}

bool has_curve(const StudyResult& result) {
  return std::any_of(result.branches.begin(), result.branches.end(),
                     [](const Branch& branch) { return branch.samples.size() > 1; });
}

}  // namespace

std::vector<PlotSpec> plots_of(const Case& the_case, const std::vector<StudyResult>& results) {
  if (!the_case.plots.empty()) return the_case.plots;
  std::vector<PlotSpec> specs;
  std::vector<std::string> studies;
  for (const auto& result : results) {
    const bool is_new = std::find(studies.begin(), studies.end(), result.study) == studies.end();
    const PlannedRun* planned = plan_of(the_case, result);
    const bool is_map = planned != nullptr && planned->plan.kind == analysis::StudyKind::map;
    if (!is_new || is_map || !has_curve(result)) continue;
    studies.push_back(result.study);
    specs.push_back(default_plot(the_case, result));
  }
  const std::vector<PlotSpec> of_curves = specs;
  for (const SweepPoints& sweep : sweep_points_of(the_case, results))
    for (const PlotSpec& spec : of_curves)
      if (spec.curves.front().study == sweep.study) add_point_spec(sweep, spec, specs);
  return specs;
}

}  // namespace springfold::io
