#include "figure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "label_layout.hpp"
#include "motion_figure.hpp"
#include "quantity_sizes.hpp"
#include "result_access.hpp"
#include "smooth_line.hpp"
#include "springfold/analysis/snap.hpp"
#include "stability_parts.hpp"
#include "text.hpp"

namespace springfold::io {

namespace {

using analysis::Branch;
using analysis::EventKind;
using analysis::StudyResult;

FigureText axis_title(const FigureText& given, const std::string& quantity, double factor,
                      const StudyResult& result, const PlannedRun* planned,
                      const UnitLabels& units) {
  if (!given.text.empty()) return given;
  const auto column = column_of(result, quantity);
  const std::string name = column_title(result, quantity, planned);
  const std::string title = factor == 1 ? name : factor_text(factor) + name;
  if (!column) return {title};
  const std::string unit = column_unit(result, *column, planned, units);
  return {unit.empty() ? title : title + " [" + unit + "]"};
}

/// End of range is where a curve ends: that is seen without a mark.
bool is_marked(EventKind kind) { return kind != EventKind::end_of_range; }

struct Axes {
  const PlotSpec& spec;
  const UnitLabels& units;
  const PlannedRun* planned = nullptr;
  std::string y{};        ///< the quantity that is plotted: spec.y or one of spec.more_y
  std::string along{};    ///< rows lie on smooth curves over this quantity; empty: on none
  int hue = 0;            ///< of several quantities: the number of this one
  bool has_start = true;  ///< false: its rows begin where they are found first
  std::vector<double>
      sizes{};  ///< of the result's quantities; nothing is rounding where there are none

  PlotPoint point(const StudyResult& result, const Branch& branch, std::size_t row) const {
    return place(value(result, branch, row, spec.x), value(result, branch, row, y));
  }

  double value(const StudyResult& result, const Branch& branch, std::size_t row,
               const std::string& quantity) const {
    const auto column = column_of(result, quantity);
    return column ? shown_in(sizes, *column, value_at(result, branch, row, quantity))
                  : std::numeric_limits<double>::quiet_NaN();
  }

  PlotPoint place(double across, double up) const {
    across *= spec.x_factor, up *= spec.y_factor;
    return spec.polar ? PlotPoint{up * std::cos(across), up * std::sin(across)}
                      : PlotPoint{across, up};
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

/// A curve over arc length, or over a path without corners, bends between its rows as it does at them; rows of other
/// commands and targets are what they are: straight in the values, which logarithmic axes bend. Adds the points in
/// between, and the stability of the steps that they make.
/// @param along  as in Axes
void bend(const StudyResult& result, const Branch& branch, const std::string& along,
          const PlotLook& look, std::vector<PlotPoint>& points, std::vector<Stability>& steps) {
  std::vector<LineRow> rows;
  int piece = 0;
  for (std::size_t row = 0; row < points.size(); ++row) {
    if (row > 0 && (along.empty() || branch.samples[row].piece != branch.samples[row - 1].piece))
      ++piece;
    rows.push_back({points[row], along.empty() ? 0 : value_at(result, branch, row, along), piece});
  }
  for (const analysis::Event& event : branch.events)
    if (event.row < rows.size()) rows[event.row].is_special = true;
  const std::vector<Polyline> between =
      points_between(rows, scales_of(rows, look.x_log, look.y_log));
  std::vector<PlotPoint> all;
  std::vector<Stability> all_steps;
  for (std::size_t row = 0; row < points.size(); ++row) {
    all.push_back(points[row]);
    if (row >= steps.size()) continue;
    all.insert(all.end(), between[row].begin(), between[row].end());
    all_steps.insert(all_steps.end(), between[row].size() + 1, steps[row]);
  }
  points = std::move(all);
  steps = std::move(all_steps);
}

/// The least of the values that are positive; 0 before there is one.
void lower(double value, double& least) {
  if (value > 0 && (least == 0 || value < least)) least = value;
}

void add_branch(Figure& figure, const Axes& axes, const StudyResult& result, const Branch& branch,
                const FigureText& label, int hue) {
  std::vector<PlotPoint> points;
  for (std::size_t row = 0; row < branch.samples.size(); ++row)
    points.push_back(axes.point(result, branch, row));
  std::vector<Stability> steps = stability_of_steps(result, branch);
  const PlotLook& look = axes.spec.look;
  const std::string along = look.smooth && column_of(result, axes.along) ? axes.along : "";
  for (const PlotPoint& at : points) lower(at.first, figure.least.first);
  for (const PlotPoint& at : points) lower(at.second, figure.least.second);
  if (!along.empty() || look.x_log || look.y_log) bend(result, branch, along, look, points, steps);
  figure.curves.push_back({label, parts_of(points, steps), hue});
  for (const auto& event : branch.events)
    if (is_marked(event.kind))
      add_mark(figure,
               {analysis::code_of(event.kind), event.label, axes.point(result, branch, event.row)});
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
                      axes.place(value(e.sample, axes.spec.x), value(e.sample, axes.y))});
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
    return axes.place(value(axes.spec.x), value(axes.y));
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
  const PlotSpec& spec = axes.spec;
  const UnitLabels& units = axes.units;
  if (figure.x_title.text.empty()) {
    const FigureText x{spec.x_label, spec.markup};
    figure.x_title = axis_title(x, spec.x, spec.x_factor, result, axes.planned, units);
    figure.y_title = ordinate_title(spec, result, axes.planned, units);
    if (spec.polar) {  // both axes show the distance
      const FigureText distance =
          axis_title({}, spec.y, spec.y_factor, result, axes.planned, units);
      if (spec.x_label.empty()) figure.x_title.text = distance.text + ", along " + spec.x + " = 0";
      if (spec.y_label.empty())
        figure.y_title.text = distance.text + ", along " + spec.x + " = 90°";
    }
  }
  const std::size_t first_curve = figure.curves.size();
  const bool is_diagram = result.branches.size() > 1;
  for (std::size_t b = 0; b < result.branches.size(); ++b)
    add_branch(figure, axes, result, result.branches[b], b == 0 ? label : FigureText{},
               axes.hue > 0 ? axes.hue
               : is_diagram ? static_cast<int>(b) + 1
                            : 0);
  if (is_diagram && result.design)
    name_design(figure, first_curve);
  else if (is_diagram && axes.hue == 0)
    number_branches(figure, first_curve);
  add_equilibria(figure, axes, result);
  add_jumps(figure, axes, result);
  if (result.branches.empty() || !axes.has_start) return;
  const Branch& first = result.branches.front();
  add_mark(figure, {"start", "", axes.point(result, first, first.start_row)});
}

/// The curves of a run, one or several quantities over the same x. Of several each has its colour.
void add_quantities(Figure& figure, const Case& the_case, const PlotSpec& spec,
                    const StudyResult& result, const FigureText& label) {
  const PlannedRun* planned = plan_of(the_case, result);
  Axes axes{.spec = spec, .units = the_case.units, .planned = planned, .y = spec.y};
  axes.has_start = planned == nullptr || planned->plan.kind != analysis::StudyKind::critical_load;
  // On a logarithmic axis rounding is seen for what it is.
  if (!spec.look.x_log && !spec.look.y_log) axes.sizes = quantity_sizes(result);
  if (planned != nullptr) axes.along = smooth_along(planned->plan);
  if (spec.more_y.empty()) return add_run(figure, axes, result, label);
  std::vector<std::string> quantities{spec.y};
  quantities.insert(quantities.end(), spec.more_y.begin(), spec.more_y.end());
  for (const std::string& quantity : quantities) {
    axes.y = quantity;
    ++axes.hue;
    const std::string name = shown_name(result, quantity);
    if (figure.quantities.size() < quantities.size()) figure.quantities.push_back(name);
    add_run(figure, axes, result, {label.text.empty() ? name : label.text + ": " + name});
  }
}

/// Logarithmic axes have no place for values that are not positive.
void say_hidden(const Figure& figure, std::vector<std::string>& problems) {
  std::size_t hidden = 0;
  for (const FigureCurve& curve : figure.curves)
    for (const CurvePart& part : curve.parts)
      for (const PlotPoint& at : part.line)
        if ((figure.look.x_log && at.first <= 0) || (figure.look.y_log && at.second <= 0)) ++hidden;
  if (hidden > 0)
    problems.push_back(
        "figure '" + figure.name +
        "': values that are not positive have no place on a logarithmic axis and are "
        "left out");
}

/// A run that a figure shows.
struct ShownRun {
  const StudyResult* result = nullptr;
  FigureText label{};     ///< of the program: no markup
  bool is_named = false;  ///< the figure gives the label
};

std::vector<ShownRun> shown_runs(const Case& the_case, bool markup, const PlotCurves& curves,
                                 const std::vector<StudyResult>& results) {
  std::vector<ShownRun> shown;
  const auto add = [&](const StudyResult& result, std::size_t position) {
    if (position < curves.labels.size())
      return void(shown.push_back({&result, FigureText{curves.labels[position], markup}, true}));
    const PlannedRun* planned = plan_of(the_case, result);
    const bool is_given = planned != nullptr && planned->has_given_label;
    shown.push_back({&result, FigureText{result.label, markup && is_given}});
  };
  for (std::size_t i = 0; i < curves.runs.size(); ++i)
    if (const auto* result = result_of(results, curves.study, curves.runs[i])) add(*result, i);
  if (curves.runs.empty())
    for (const auto& result : results)
      if (result.study == curves.study) add(result, static_cast<std::size_t>(result.run - 1));
  return shown;
}

/// Are all columns that the figure needs there? Says which is not.
bool has_columns(const PlotSpec& spec, const StudyResult& result,
                 std::vector<std::string>& problems) {
  std::vector<std::string> names{spec.x, spec.y};
  names.insert(names.end(), spec.more_y.begin(), spec.more_y.end());
  for (const auto& name : names) {
    if (column_of(result, name)) continue;
    problems.push_back("figure '" + spec.name + "': " + heading_of(result) + " has no quantity '" +
                       name + "'");
    return false;
  }
  return true;
}

}  // namespace

bool is_curve_of_points(analysis::StudyKind kind) {
  return kind == analysis::StudyKind::critical_curve || kind == analysis::StudyKind::threshold ||
         kind == analysis::StudyKind::critical_load;
}

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

std::string factor_text(double factor) { return shortest(factor) + " · "; }

FigureText ordinate_title(const PlotSpec& spec, const StudyResult& result,
                          const PlannedRun* planned, const UnitLabels& units) {
  FigureText title =
      axis_title({spec.y_label, spec.markup}, spec.y, spec.y_factor, result, planned, units);
  for (const std::string& more : spec.y_label.empty() ? spec.more_y : std::vector<std::string>{})
    title.text += ", " + axis_title({}, more, spec.y_factor, result, planned, units).text;
  return title;
}

std::vector<Figure> figures_of(const Case& the_case, const std::vector<StudyResult>& results,
                               std::vector<std::string>& problems) {
  std::vector<Figure> figures;
  UniqueNames names;
  for (const PlotSpec& spec : plots_of(the_case, results)) {
    Figure figure{.name = names.make(safe_file_name(spec.name)),
                  .title = {spec.title, spec.markup}};
    figure.look = spec.look;
    std::vector<RunCurves> runs;
    bool is_wanted = false;  // a figure of runs that were left out on purpose is no problem
    if (is_in_plane(spec))
      add_boundary(the_case, spec, results, figure);
    else if (is_over_parameter(spec))
      add_sweep_points(the_case, spec, results, figure);
    for (const auto& curves : is_over_parameter(spec) ? std::vector<PlotCurves>{} : spec.curves) {
      for (const auto& [result, label, is_named] :
           shown_runs(the_case, spec.markup, curves, results)) {
        is_wanted = true;
        if (!has_columns(spec, *result, problems)) continue;
        const std::size_t first = figure.curves.size();
        add_quantities(figure, the_case, spec, *result, label);
        runs.push_back({plan_of(the_case, *result), first, figure.curves.size() - first, is_named});
      }
    }
    if (!runs.empty() && std::all_of(runs.begin(), runs.end(), [](const RunCurves& run) {
          return run.planned != nullptr && is_curve_of_points(run.planned->plan.kind);
        }))
      figure.is_of_points = true;
    if (is_over_parameter(spec))
      is_wanted =
          std::any_of(spec.curves.begin(), spec.curves.end(), [&](const PlotCurves& curves) {
            return !shown_runs(the_case, spec.markup, curves, results).empty();
          });
    if (spec.more_y.empty()) colour_by_value(runs, the_case.units, figure);
    if (spec.shade) shade_held_loads(runs, spec, results, figure);
    say_hidden(figure, problems);
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
