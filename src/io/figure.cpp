#include "figure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "label_layout.hpp"
#include "motion_figure.hpp"
#include "result_access.hpp"
#include "springfold/analysis/snap.hpp"
#include "stability_parts.hpp"
#include "text.hpp"

namespace springfold::io {

namespace {

using analysis::Branch;
using analysis::EventKind;
using analysis::StudyResult;

/// Quantities of a figure without [[plot]]: force over deflection, otherwise lambda over the first
/// coordinate of the pose.
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
  if (column_of(result, "deflection") && column_of(result, "force")) return spec;
  spec.y = "lambda";
  const PlannedRun* planned = plan_of(the_case, result);
  const bool has_body = planned != nullptr && !planned->mechanism.bodies.empty();
  spec.x = has_body ? planned->mechanism.bodies.front().name + ".x" : "s";
  return spec;
}

bool has_curve(const StudyResult& result) {
  return std::any_of(result.branches.begin(), result.branches.end(),
                     [](const Branch& branch) { return branch.samples.size() > 1; });
}

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
  return specs;
}

FigureText axis_title(const FigureText& given, const std::string& quantity, double factor,
                      const StudyResult& result, const UnitLabels& units) {
  if (!given.text.empty()) return given;
  const auto column = column_of(result, quantity);
  const std::string title = factor == 1 ? quantity : shortest(factor) + " · " + quantity;
  if (!column) return {title};
  const auto unit = unit_label(result.quantities[*column].unit, result.lambda_unit, units);
  return {unit.empty() ? title : title + " [" + unit + "]"};
}

/// End of range is where a curve ends: that is seen without a mark.
bool is_marked(EventKind kind) { return kind != EventKind::end_of_range; }

struct Axes {
  const PlotSpec& spec;
  const UnitLabels& units;

  PlotPoint point(const StudyResult& result, const Branch& branch, std::size_t row) const {
    return place(value_at(result, branch, row, spec.x), value_at(result, branch, row, spec.y));
  }

  PlotPoint place(double x, double y) const {
    x *= spec.x_factor, y *= spec.y_factor;
    return spec.polar ? PlotPoint{y * std::cos(x), y * std::sin(x)} : PlotPoint{x, y};
  }
};

/// A special point at which branches meet is marked once.
void add_mark(Figure& figure, FigureMark mark) {
  const bool is_there =
      std::any_of(figure.marks.begin(), figure.marks.end(), [&](const FigureMark& other) {
        return other.code == mark.code && other.label == mark.label && other.at == mark.at;
      });
  if (is_finite(mark.at) && !is_there) figure.marks.push_back(std::move(mark));
}

void add_branch(Figure& figure, const Axes& axes, const StudyResult& result, const Branch& branch,
                const FigureText& label, int hue) {
  std::vector<PlotPoint> points;
  for (std::size_t row = 0; row < branch.samples.size(); ++row)
    points.push_back(axes.point(result, branch, row));
  figure.curves.push_back({label, parts_of(points, stability_of_steps(result, branch)), hue});
  for (const auto& event : branch.events)
    if (is_marked(event.kind))
      add_mark(figure,
               {analysis::code_of(event.kind), event.label, axes.point(result, branch, event.row)});
}

/// Do two curves show the same line? Mirrored branches do where the figure does not show the mirror.
bool look_alike(const FigureCurve& a, const FigureCurve& b) {
  if (a.parts.size() != b.parts.size()) return false;
  for (std::size_t i = 0; i < a.parts.size(); ++i) {
    const Polyline &p = a.parts[i].line, &q = b.parts[i].line;
    if (p.size() != q.size()) return false;
    for (std::size_t k = 0; k < p.size(); ++k) {
      const auto near = [](double u, double v) {
        return std::abs(u - v) <= 1e-6 * std::max({1e-3, std::abs(u), std::abs(v)});
      };
      if (!near(p[k].first, q[k].first) || !near(p[k].second, q[k].second)) return false;
    }
  }
  return true;
}

/// Labels the branches of a diagram with their numbers; one label for those that look alike.
void number_branches(Figure& figure, std::size_t first) {
  auto& curves = figure.curves;
  std::vector<bool> done(curves.size(), false);
  for (std::size_t i = first; i < curves.size(); ++i) {
    if (done[i]) continue;
    std::string numbers = std::to_string(curves[i].hue);
    for (std::size_t k = i + 1; k < curves.size(); ++k)
      if (!done[k] && look_alike(curves[i], curves[k])) {
        done[k] = true;
        numbers += ", " + std::to_string(curves[k].hue);
      }
    std::string& text = curves[i].label.text;
    text += (text.empty() ? "" : ": ") + numbers;
  }
}

/// The branches of a design: the path of the case, and that of the answer.
void name_design(Figure& figure, std::size_t first) {
  constexpr const char* names[] = {"before", "after"};
  for (std::size_t i = first; i < std::min(first + 2, figure.curves.size()); ++i) {
    std::string& text = figure.curves[i].label.text;
    text += (text.empty() ? "" : ": ") + std::string{names[i - first]};
  }
}

/// Equilibria that a search found: stable ones ("ES") are filled, all others ("EU") are not.
void add_equilibria(Figure& figure, const Axes& axes, const StudyResult& result) {
  if (!result.equilibria) return;
  const auto value = [&result](const analysis::Sample& sample, const std::string& quantity) {
    const auto column = column_of(result, quantity);
    return column ? sample.values[*column] : std::numeric_limits<double>::quiet_NaN();
  };
  for (const auto& e : result.equilibria->list)
    add_mark(figure, {value(e.sample, "index") == 0 ? "ES" : "EU", e.label,
                      axes.place(value(e.sample, axes.spec.x), value(e.sample, axes.spec.y))});
}

/// Jumps that land; of a study with levels those that its cycle takes.
void add_jumps(Figure& figure, const Axes& axes, const StudyResult& result) {
  if (!result.snap) return;
  const auto at = [&](const analysis::SnapState& state) {
    const auto value = [&](const std::string& quantity) {
      const auto column = column_of(result, quantity);
      return column && *column < state.values.size() ? state.values[*column]
                                                     : std::numeric_limits<double>::quiet_NaN();
    };
    return axes.place(value(axes.spec.x), value(axes.spec.y));
  };
  std::vector<bool> shown(result.snap->jumps.size(), !result.snap->cycle);
  if (result.snap->cycle)
    for (const analysis::CycleStep& step : result.snap->cycle->steps)
      if (step.jump > 0) shown[static_cast<std::size_t>(step.jump - 1)] = true;
  for (std::size_t j = 0; j < shown.size(); ++j) {
    const analysis::Jump& jump = result.snap->jumps[j];
    const PlotPoint from = at(jump.critical), to = at(jump.landing);
    if (shown[j] && is_finite(from) && is_finite(to) && from != to)
      figure.arrows.emplace_back(from, to);
  }
}

void add_run(Figure& figure, const Axes& axes, const StudyResult& result, const FigureText& label) {
  const auto& [spec, units] = axes;
  if (figure.x_title.text.empty()) {
    const FigureText x{spec.x_label, spec.markup}, y{spec.y_label, spec.markup};
    figure.x_title = axis_title(x, spec.x, spec.x_factor, result, units);
    figure.y_title = axis_title(y, spec.y, spec.y_factor, result, units);
    if (spec.polar) {  // both axes show the distance
      const FigureText distance = axis_title({}, spec.y, spec.y_factor, result, units);
      if (spec.x_label.empty()) figure.x_title.text = distance.text + ", along " + spec.x + " = 0";
      if (spec.y_label.empty())
        figure.y_title.text = distance.text + ", along " + spec.x + " = 90°";
    }
  }
  const std::size_t first_curve = figure.curves.size();
  const bool is_diagram = result.branches.size() > 1;
  for (std::size_t b = 0; b < result.branches.size(); ++b)
    add_branch(figure, axes, result, result.branches[b], b == 0 ? label : FigureText{},
               is_diagram ? static_cast<int>(b) + 1 : 0);
  if (is_diagram && result.design)
    name_design(figure, first_curve);
  else if (is_diagram)
    number_branches(figure, first_curve);
  add_equilibria(figure, axes, result);
  add_jumps(figure, axes, result);
  if (result.branches.empty()) return;
  const Branch& first = result.branches.front();
  add_mark(figure, {"start", "", axes.point(result, first, first.start_row)});
}

/// Runs of the study that the figure shows, with their labels. Texts that the program made are no markup.
std::vector<std::pair<const StudyResult*, FigureText>> shown_runs(
    const Case& the_case, bool markup, const PlotCurves& curves,
    const std::vector<StudyResult>& results) {
  std::vector<std::pair<const StudyResult*, FigureText>> shown;
  const auto add = [&](const StudyResult& result, std::size_t position) {
    if (position < curves.labels.size())
      return void(shown.emplace_back(&result, FigureText{curves.labels[position], markup}));
    const PlannedRun* planned = plan_of(the_case, result);
    const bool is_given = planned != nullptr && planned->has_given_label;
    shown.emplace_back(&result, FigureText{result.label, markup && is_given});
  };
  for (std::size_t i = 0; i < curves.runs.size(); ++i)
    if (const auto* result = result_of(results, curves.study, curves.runs[i])) add(*result, i);
  if (curves.runs.empty())
    for (const auto& result : results)
      if (result.study == curves.study) add(result, static_cast<std::size_t>(result.run - 1));
  return shown;
}

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(double value) { low = std::min(low, value), high = std::max(high, value); }

  /// Some room on both sides; a single value gets room of its own size.
  Range padded() const {
    const double room = 0.05 * (high > low ? high - low : std::max(std::abs(low), 1e-3));
    return {low - room, high + room};
  }
};

/// Makes a unit as long along x as along y; what lies in between stays in the middle.
void equalise(const Canvas& canvas, Range& x, Range& y) {
  const double wide = canvas.right - canvas.left, high = canvas.top - canvas.bottom;
  const double unit = std::max((x.high - x.low) / wide, (y.high - y.low) / high);
  const auto widen = [](Range& range, double length) {
    const double middle = 0.5 * (range.low + range.high);
    range = {middle - 0.5 * length, middle + 0.5 * length};
  };
  widen(x, unit * wide);
  widen(y, unit * high);
}

/// Sets the corners; false if there is nothing to see. @param polar  the origin is seen, and angles are right
bool fit_axes(Figure& figure, bool polar) {
  Range x, y;
  const auto include = [&](const PlotPoint& at) { x.include(at.first), y.include(at.second); };
  for (const auto& curve : figure.curves)
    for (const auto& part : curve.parts) std::for_each(part.line.begin(), part.line.end(), include);
  for (const auto& mark : figure.marks) include(mark.at);
  for (const auto& [from, to] : figure.arrows) include(from), include(to);
  if (!(x.low <= x.high)) return false;
  if (polar) include({0, 0});
  Range padded_x = x.padded(), padded_y = y.padded();
  if (polar) equalise(Canvas{}, padded_x, padded_y);
  figure.low = {padded_x.low, padded_y.low};
  figure.high = {padded_x.high, padded_y.high};
  return true;
}

/// Are all columns that the figure needs there? Says which is not.
bool has_columns(const PlotSpec& spec, const StudyResult& result,
                 std::vector<std::string>& problems) {
  for (const auto& name : {spec.x, spec.y}) {
    if (column_of(result, name)) continue;
    problems.push_back("figure '" + spec.name + "': " + heading_of(result) + " has no quantity '" +
                       name + "'");
    return false;
  }
  return true;
}

}  // namespace

std::vector<Figure> figures_of(const Case& the_case, const std::vector<StudyResult>& results,
                               std::vector<std::string>& problems) {
  std::vector<Figure> figures;
  UniqueNames names;
  for (const PlotSpec& spec : plots_of(the_case, results)) {
    Figure figure{.name = names.make(safe_file_name(spec.name)),
                  .title = {spec.title, spec.markup}};
    bool is_wanted = false;  // a figure of runs that were left out on purpose is no problem
    for (const auto& curves : spec.curves) {
      for (const auto& [result, label] : shown_runs(the_case, spec.markup, curves, results)) {
        is_wanted = true;
        if (has_columns(spec, *result, problems))
          add_run(figure, {spec, the_case.units}, *result, label);
      }
    }
    if (fit_axes(figure, spec.polar))
      figures.push_back(std::move(figure));
    else if (is_wanted)
      problems.push_back("figure '" + spec.name + "': there is no point to draw");
  }
  for (const StudyResult& result : results) {
    Figure figure = motion_figure(the_case, result);
    if (figure.curves.empty() || !fit_axes(figure, false)) continue;
    figure.name = names.make(figure.name);
    figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace springfold::io
