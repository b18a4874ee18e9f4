// Figures of special points over a parameter that a study varies.
#include <algorithm>
#include <cmath>

#include "figure.hpp"
#include "result_access.hpp"
#include "stability_parts.hpp"
#include "sweep_points.hpp"

namespace springfold::io {
namespace {

/// A run that has the point, or that stands for a gap: then `at` is not finite.
struct SweepMark {
  double parameter = 0;
  PlotPoint at{};
};

std::string parameter_of(const PlotSpec& spec) {
  return spec.x.substr(std::string_view{parameter_prefix}.size());
}

bool is_shown(const PlotCurves& curves, int run) {
  return curves.runs.empty() ||
         std::find(curves.runs.begin(), curves.runs.end(), run) != curves.runs.end();
}

/// The point of this number in all runs, by the parameter.
std::vector<SweepMark> marks_of(const SweepPoints& sweep, const PlotCurves& curves,
                                std::size_t point, const PlotSpec& spec,
                                const std::string& quantity) {
  std::vector<SweepMark> marks;
  for (const SweepPoints::Run& run : sweep.runs) {
    if (!is_shown(curves, run.planned->run)) continue;
    const double parameter = varied_value(run.planned, parameter_of(spec));
    const auto& place = run.places[point];
    const double up =
        place ? value_at(*run.result, *place->branch, place->row, quantity) : std::nan("");
    marks.push_back({parameter, {spec.x_factor * parameter, spec.y_factor * up}});
  }
  std::stable_sort(marks.begin(), marks.end(),
                   [](const auto& a, const auto& b) { return a.parameter < b.parameter; });
  return marks;
}

/// Lines from run to run, broken where a run has no such point.
std::vector<CurvePart> joined(const std::vector<SweepMark>& marks) {
  std::vector<CurvePart> parts;
  bool goes_on = false;
  for (const SweepMark& mark : marks) {
    if (is_finite(mark.at)) {
      if (!goes_on) parts.push_back({Stability::stable, {}});
      parts.back().line.push_back(mark.at);
    }
    goes_on = is_finite(mark.at);
  }
  std::erase_if(parts, [](const CurvePart& part) { return part.line.size() < 2; });
  return parts;
}

/// The points of one label: marks, joined where nothing else varies.
void add_point(const SweepPoints& sweep, const PlotCurves& curves, std::size_t point,
               const PlotSpec& spec, const std::string& quantity, const std::string& label,
               Figure& figure) {
  const std::vector<SweepMark> marks = marks_of(sweep, curves, point, spec, quantity);
  FigureCurve curve{.label = {label}, .hue = static_cast<int>(figure.curves.size()) + 1};
  if (sweep.parameters.size() == 1) curve.parts = joined(marks);
  bool is_named = !curve.parts.empty();
  for (const SweepMark& mark : marks) {
    if (!is_finite(mark.at)) continue;
    figure.marks.push_back({sweep.codes[point], is_named ? "" : label, mark.at});
    is_named = true;
  }
  if (curve.parts.empty()) return;
  const auto twin =
      std::find_if(figure.curves.begin(), figure.curves.end(),
                   [&curve](const FigureCurve& other) { return look_alike(other, curve); });
  if (twin == figure.curves.end())
    figure.curves.push_back(std::move(curve));
  else
    twin->label.text += ", " + label;
}

}  // namespace

bool is_over_parameter(const PlotSpec& spec) { return spec.x.starts_with(parameter_prefix); }

void add_sweep_points(const Case& the_case, const PlotSpec& spec,
                      const std::vector<analysis::StudyResult>& results, Figure& figure) {
  figure.tells_stability = false;
  std::vector<std::string> quantities{spec.y};
  quantities.insert(quantities.end(), spec.more_y.begin(), spec.more_y.end());
  figure.x_title = {spec.x_label, spec.markup};
  if (spec.x_label.empty())
    figure.x_title = {(spec.x_factor == 1 ? "" : factor_text(spec.x_factor)) + parameter_of(spec)};
  for (const SweepPoints& sweep : sweep_points_of(the_case, results))
    for (const PlotCurves& curves : spec.curves) {
      if (curves.study != sweep.study) continue;
      const auto& names = sweep.parameters;
      if (std::find(names.begin(), names.end(), parameter_of(spec)) == names.end()) continue;
      if (figure.y_title.text.empty())
        figure.y_title = ordinate_title(spec, *sweep.runs.front().result, the_case.units);
      const std::string of_study = spec.curves.size() > 1 ? sweep.study + ": " : "";
      for (const std::string& quantity : quantities)
        for (std::size_t i = 0; i < sweep.labels.size(); ++i)
          add_point(sweep, curves, i, spec, quantity,
                    of_study + sweep.labels[i] + (quantities.size() > 1 ? ", " + quantity : ""),
                    figure);
    }
}

}  // namespace springfold::io
