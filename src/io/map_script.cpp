// The gnuplot script of a map: values and lines as data blocks, then the templates.
#include <cmath>

#include "gnuplot_text.hpp"
#include "map_figure.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

constexpr int number_digits = 4;  // beside contour lines

std::string script_number(double value) { return std::isnan(value) ? "NaN" : rounded(value, 8); }

void add_block(std::string& script, const std::string& name, const std::vector<Segment>& segments) {
  script += "$" + name + " << e\n";
  for (const auto& [a, b] : segments)
    script += script_number(a.first) + " " + script_number(a.second) + "\n" +
              script_number(b.first) + " " + script_number(b.second) + "\n\n";
  if (segments.empty()) script += "NaN NaN\n";
  script += "e\n";
}

/// An infinite value has the colour at the end of the scale.
void add_field(std::string& script, const std::string& name, const GridField& field, double low,
               double high) {
  const auto value = [&](std::size_t i, std::size_t j) {
    return field.values[j * field.xs.size() + i];
  };
  script += "$" + name + " << e\n";
  for (std::size_t j = 0; j < field.ys.size(); ++j) {
    for (std::size_t i = 0; i < field.xs.size(); ++i)
      script +=
          script_number(field.xs[i]) + " " + script_number(field.ys[j]) + " " +
          script_number(std::isinf(value(i, j)) ? (value(i, j) > 0 ? high : low) : value(i, j)) +
          "\n";
    script += "\n";
  }
  script += "e\n";
}

std::string texts(const MapFigure& figure, bool is_tex) {
  const std::vector<MapPanel>& panels = figure.panels;
  std::string script = gnuplot_assignment("figure_title", text_for(figure.title, is_tex)) +
                       gnuplot_assignment("x_title", text_for(figure.x_title, is_tex)) +
                       gnuplot_assignment("y_title", text_for(figure.y_title, is_tex)) +
                       gnuplot_assignment("value_title", text_for(figure.value_title, is_tex)) +
                       "panel_title_mode = '" +
                       gnuplot_mode(text_for(panels.front().title, is_tex)) + "'\n" +
                       "array panel_title[" + std::to_string(panels.size()) + "]\n";
  for (std::size_t i = 0; i < panels.size(); ++i)
    script += "panel_title[" + std::to_string(i + 1) +
              "] = " + gnuplot_string(text_for(panels[i].title, is_tex).text) + "\n";
  return script;
}

}  // namespace

std::string map_script(const MapFigure& figure, const std::string& style,
                       const std::string& drawing) {
  std::string script =
      "# Written by springfold; `gnuplot " + figure.name + ".gp` draws it again.\n";
  const auto assign = [&script](const std::string& name, const std::string& value) {
    script += name + " = " + value + "\n";
  };
  assign("figure_name", gnuplot_string(figure.name));
  assign("value_low", shortest(figure.low));
  assign("value_high", shortest(figure.high));
  std::string levels;
  for (const double level : figure.levels)
    levels += (levels.empty() ? "" : " ") + rounded(level, 6);
  assign("levels", gnuplot_string(levels));
  assign("panels", std::to_string(figure.panels.size()));
  const auto& xs = figure.panels.front().field.xs;
  const auto& ys = figure.panels.front().field.ys;
  assign("x_low", shortest(std::min(xs.front(), xs.back())));
  assign("x_high", shortest(std::max(xs.front(), xs.back())));
  assign("y_low", shortest(std::min(ys.front(), ys.back())));
  assign("y_high", shortest(std::max(ys.front(), ys.back())));
  bool edge = false, activation = false, unstable = false;
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const MapPanel& panel = figure.panels[i];
    const std::string k = std::to_string(i + 1);
    add_field(script, "field_" + k, panel.field, figure.low, figure.high);
    add_block(script, "contours_" + k, panel.contours);
    script += "$numbers_" + k + " << e\n";
    for (const LineNumber& line : panel.numbers)
      script += script_number(line.at.first) + " " + script_number(line.at.second) + " " +
                rounded(line.level, number_digits) + "\n";
    if (panel.numbers.empty()) script += "NaN NaN -\n";
    script += "e\n";
    add_block(script, "edge_" + k, panel.edge);
    add_block(script, "activation_" + k, panel.activation);
    add_block(script, "unstable_" + k, panel.unstable);
    edge = edge || !panel.edge.empty();
    activation = activation || !panel.activation.empty();
    unstable = unstable || !panel.unstable.empty();
  }
  assign("has_gaps", figure.has_gaps ? "1" : "0");
  assign("has_infinite", figure.has_infinite ? "1" : "0");
  assign("clipped", std::to_string(figure.clipped));
  assign("has_edge", edge ? "1" : "0");
  assign("has_activation", activation ? "1" : "0");
  assign("has_unstable", unstable ? "1" : "0");
  for (const std::string& format : figure.look.formats)
    script += sheet_assignments(figure.look, format) + texts(figure, format == "tikz") + "\n" +
              style + "\n" + drawing;
  return script;
}

}  // namespace springfold::io
