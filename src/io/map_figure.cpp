#include "map_figure.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>

#include "nothing.hpp"
#include "result_access.hpp"
#include "springfold/statics/system.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

using analysis::NodeState;
using analysis::StudyKind;
using analysis::StudyResult;

/// The nodes of one plane of a map: the first two axes, the third one fixed.
class Plane {
 public:
  Plane(const PlannedRun& planned, const StudyResult& result, int slice)
      : planned_{planned}, result_{result} {
    const auto& axes = planned.plan.map.axes;
    const auto fill = [](const analysis::MapAxis& axis, std::vector<double>& values) {
      for (int i = 0; i < axis.points; ++i) values.push_back(axis.at(i));
    };
    fill(axes[0], xs_);
    fill(axes[1], ys_);
    first_ = xs_.size() * ys_.size() * static_cast<std::size_t>(slice - 1);
  }

  /// A field of any number that a row has.
  template <class Value>
  GridField field(const Value& value) const {
    GridField field{xs_, ys_, {}};
    const auto& samples = result_.branches.front().samples;
    for (std::size_t k = 0; k < xs_.size() * ys_.size(); ++k)
      field.values.push_back(first_ + k < samples.size() ? value(samples[first_ + k]) : nothing);
    return field;
  }

  GridField quantity(std::size_t column, double factor) const {
    return field([=](const analysis::Sample& s) { return factor * s.values[column]; });
  }

  GridField held() const {
    return field([](const analysis::Sample& s) {
      if (s.state == NodeState::not_computed || s.state == NodeState::undecided) return nothing;
      return s.state == NodeState::outside ? 0.0 : 1.0;
    });
  }

  GridField stable() const {
    return field([](const analysis::Sample& s) {
      if (s.state == NodeState::unstable) return 0.0;
      const bool stable = s.state == NodeState::stable || s.state == NodeState::load_not_found;
      return stable ? 1.0 : nothing;
    });
  }

  /// The same springs act where these are the same.
  std::vector<std::string> pieces() const {
    std::vector<std::string> pieces;
    const auto& samples = result_.branches.front().samples;
    for (std::size_t k = 0; k < xs_.size() * ys_.size(); ++k)
      pieces.push_back(first_ + k < samples.size() ? samples[first_ + k].piece : "");
    return pieces;
  }

  /// Distances of all springs' coordinates from their breakpoints.
  std::vector<GridField> distances() const {
    std::vector<GridField> fields;
    const statics::System system = statics::prepare(planned_.mechanism);
    const auto add = [&](const model::CompiledSpring& law, std::optional<std::size_t> column) {
      for (std::size_t b = 0; column && b < law.breakpoints.size(); ++b) {
        const double breakpoint = law.breakpoints[b];
        if (law.changes_at(b))
          fields.push_back(
              field([=](const analysis::Sample& s) { return s.values[*column] - breakpoint; }));
      }
    };
    for (const statics::CoordinateSpring& spring : system.springs)
      add(spring.law, column_of(result_, spring.name));
    const auto& shapes = planned_.mechanism.shape_springs;
    for (std::size_t i = 0; i < shapes.size(); ++i)
      add(system.shapes[i].law, column_of_law(shapes[i]));
    return fields;
  }

 private:
  /// Where the coordinate of a spring's law stands: that of the last one in series, or the shape's value.
  std::optional<std::size_t> column_of_law(const model::ShapeSpring& spring) const {
    if (!spring.before.empty())
      return column_of(result_, series_name(spring, spring.before.size()));
    for (const char* value : {".length", ".distance", ".angle", ".area", ".volume"})
      if (const auto column = column_of(result_, spring.name + value)) return column;
    return std::nullopt;
  }

  const PlannedRun& planned_;
  const StudyResult& result_;
  std::vector<double> xs_{}, ys_{};
  std::size_t first_ = 0;
};

/// Round numbers within a range: 1, 2 or 5 times a power of ten apart, about `count` of them.
std::vector<double> round_levels(double low, double high, int count) {
  std::vector<double> levels;
  if (!(low < high)) return levels;
  const double raw = (high - low) / count, power = std::pow(10, std::floor(std::log10(raw)));
  const double step = power * (raw < 1.5 * power   ? 1
                               : raw < 3.5 * power ? 2
                               : raw < 7.5 * power ? 5
                                                   : 10);
  for (double k = std::ceil(low / step); k * step < high; ++k)
    if (k * step > low) levels.push_back(k * step);
  return levels;
}

void append(std::vector<Segment>& all, const std::vector<Segment>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

std::vector<MapPlotSpec> specs_of(const Case& the_case) {
  if (!the_case.map_plots.empty() || !the_case.plots.empty()) return the_case.map_plots;
  std::vector<MapPlotSpec> specs;
  for (const PlannedRun& planned : the_case.runs) {
    const auto& map = planned.plan.map;
    if (planned.plan.kind != StudyKind::map || map.axes.size() < 2) continue;
    const std::string number = planned.label.empty() ? "" : "-" + std::to_string(planned.run);
    MapPlotSpec spec{.name = safe_file_name(planned.study + number), .title = planned.study};
    spec.quantity = quantity_of(map);
    spec.panels = {{planned.study, planned.run, planned.label, 1}};
    specs.push_back(spec);
  }
  return specs;
}

FigureText title_of(const FigureText& given, const std::string& name, double factor,
                    const StudyResult& result, const PlannedRun* planned, const UnitLabels& units) {
  if (!given.text.empty()) return given;
  const auto column = column_of(result, name);
  const std::string unit = column ? column_unit(result, *column, planned, units) : "";
  return {(factor == 1 ? name : shortest(factor) + " · " + name) +
          (unit.empty() ? "" : " [" + unit + "]")};
}

void scale(std::vector<Segment>& segments, double x, double y) {
  for (auto& [a, b] : segments)
    for (auto* point : {&a, &b}) *point = {x * point->first, y * point->second};
}

/// Ends of the colours for these values. Few values far away from all others (the outer 2 % on a side,
/// farther than twice the range of the rest) would leave one colour to the rest: they are beyond the end.
std::pair<double, double> range_without_outliers(std::vector<double> values) {
  constexpr double outer = 0.02, far = 2;
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  const double low = values[static_cast<std::size_t>(std::ceil(outer * last))];
  const double high = values[static_cast<std::size_t>(std::floor((1 - outer) * last))];
  const double room = far * (high - low);
  if (!(room > 0)) return {values.front(), values.back()};
  return {values.front() < low - room ? low : values.front(),
          values.back() > high + room ? high : values.back()};
}

/// What the key says about nodes that have no place among the colours.
void count_special(MapFigure& figure) {
  for (const MapPanel& panel : figure.panels)
    for (const double v : panel.field.values) {
      if (std::isnan(v)) figure.has_gaps = true;
      if (std::isinf(v)) figure.has_infinite = true;
      if (std::isfinite(v) && (v < figure.low || v > figure.high)) ++figure.clipped;
    }
}

/// Fits the colours to all panels, unless the case says their range.
void set_colours(const MapPlotSpec& spec, MapFigure& figure) {
  std::vector<double> values;
  for (const MapPanel& panel : figure.panels)
    std::copy_if(panel.field.values.begin(), panel.field.values.end(), std::back_inserter(values),
                 [](double v) { return std::isfinite(v); });
  std::tie(figure.low, figure.high) = range_without_outliers(std::move(values));
  if (spec.range) std::tie(figure.low, figure.high) = *spec.range;
  if (!(figure.low < figure.high)) {
    const double room = std::max(1e-12, 0.05 * std::abs(figure.low));
    figure.low -= room;
    figure.high += room;
  }
  count_special(figure);
  figure.levels = spec.levels.empty() ? round_levels(figure.low, figure.high, 10) : spec.levels;
}

void add_lines(const MapPlotSpec& spec, const Plane& plane, const std::vector<double>& levels,
               MapPanel& panel) {
  // Stiffness jumps where springs switch: no contour line leads through such a cell.
  const bool jumps = !plane.distances().empty();
  const std::vector<std::string> pieces = jumps ? plane.pieces() : std::vector<std::string>{};
  std::vector<std::vector<Segment>> of_levels;
  for (const double level : levels) of_levels.push_back(contour(panel.field, level, pieces));
  constexpr double usual_panel = 470, apart = 4;  // pixels: of a panel, from line to line
  const auto nodes = static_cast<double>(std::max(panel.field.xs.size(), panel.field.ys.size()));
  drop_crowded(of_levels, panel.field,
               std::max<std::size_t>(1, static_cast<std::size_t>(usual_panel / nodes / apart)));
  for (const auto& line : of_levels) append(panel.contours, line);
  panel.numbers = numbers_of(of_levels, levels, panel.field);
  panel.edge = contour(plane.held(), 0.5);
  panel.unstable = contour(plane.stable(), 0.5);
  if (spec.activation)
    for (const GridField& distance : plane.distances())
      append(panel.activation, contour(distance, 0));
  for (auto* lines : {&panel.edge, &panel.unstable, &panel.activation})
    scale(*lines, spec.x_factor, spec.y_factor);
}

}  // namespace

std::string quantity_of(const analysis::MapSettings& map) {
  if (map.critical) return "critical_load";
  return map.directions.empty() ? "K_trans_min" : "stiffness";
}

std::vector<MapFigure> map_figures_of(const Case& the_case, const std::vector<StudyResult>& results,
                                      std::vector<std::string>& problems) {
  std::vector<MapFigure> figures;
  for (const MapPlotSpec& spec : specs_of(the_case)) {
    const auto given = [&spec](const std::string& text) { return FigureText{text, spec.markup}; };
    MapFigure figure{.name = spec.name, .title = given(spec.title)};
    figure.look = spec.look;
    std::vector<Plane> planes;
    for (const MapPanelSpec& wanted : spec.panels) {
      const StudyResult* result = result_of(results, wanted.study, wanted.run);
      if (!result || result->branches.empty()) continue;
      const PlannedRun* planned = plan_of(the_case, *result);
      const auto column = column_of(*result, spec.quantity);
      if (!planned || planned->plan.map.axes.size() < 2 || !column) continue;
      const auto& axes = planned->plan.map.axes;
      planes.emplace_back(*planned, *result, wanted.slice);
      MapPanel panel{.title = given(wanted.title),
                     .field = planes.back().quantity(*column, spec.factor)};
      for (double& x : panel.field.xs) x *= spec.x_factor;
      for (double& y : panel.field.ys) y *= spec.y_factor;
      figure.panels.push_back(std::move(panel));
      const UnitLabels& units = the_case.units;
      const auto title = [&](const std::string& text, const std::string& name, double factor) {
        return title_of(given(text), name, factor, *result, planned, units);
      };
      figure.x_title = title(spec.x_label, axes[0].name, spec.x_factor);
      figure.y_title = title(spec.y_label, axes[1].name, spec.y_factor);
      figure.value_title = title(spec.label, spec.quantity, spec.factor);
    }
    const bool has_values =
        std::any_of(figure.panels.begin(), figure.panels.end(), [](const MapPanel& panel) {
          return std::any_of(panel.field.values.begin(), panel.field.values.end(),
                             [](double v) { return std::isfinite(v); });
        });
    if (!has_values) {
      if (!figure.panels.empty())
        problems.push_back("figure '" + spec.name + "': there is no value to draw");
      continue;
    }
    set_colours(spec, figure);
    for (std::size_t i = 0; i < planes.size(); ++i)
      add_lines(spec, planes[i], figure.levels, figure.panels[i]);
    figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace springfold::io
