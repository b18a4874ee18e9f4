#include "tornado_figure.hpp"

#include <algorithm>
#include <cmath>

#include "gnuplot_text.hpp"
#include "nothing.hpp"
#include "quantity_sizes.hpp"
#include "result_access.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

using analysis::Branch;
using analysis::Event;
using analysis::StudyResult;

struct Found {
  const Branch* branch = nullptr;
  std::size_t row = 0;
};

std::optional<Found> point_with(const StudyResult& result, const std::string& label) {
  for (const Branch& branch : result.branches)
    for (const Event& event : branch.events)
      if (event.label == label) return Found{&branch, event.row};
  return std::nullopt;
}

void add_name(std::string& list, const std::string& word) {
  list += (list.empty() ? "" : ", ") + word;
}

/// The bars of a point, and what has none.
void add_bars(const StudyResult& result, const PlannedRun& planned, const TornadoSpec& spec,
              const Found& at, TornadoFigure& figure) {
  // 0 where it is nothing but rounding: there are no shares of that.
  const auto column = column_of(result, spec.quantity);
  const double value =
      column ? shown_in(quantity_sizes(result), *column, at.branch->samples[at.row].values[*column])
             : nothing;
  const std::string prefix = "d(" + spec.quantity + ")/d(";
  std::string zero, unknown;
  for (const auto& quantity : result.quantities) {
    if (!quantity.name.starts_with(prefix)) continue;
    const std::string parameter =
        quantity.name.substr(prefix.size(), quantity.name.size() - prefix.size() - 1);
    const auto known = planned.parameters.find(parameter);
    const double rate = value_at(result, *at.branch, at.row, quantity.name);
    if (known == planned.parameters.end() || std::isnan(rate))
      add_name(unknown, parameter);
    else if (known->second == 0)
      add_name(zero, parameter);
    else
      figure.bars.push_back({parameter, rate * known->second / value});
  }
  std::sort(figure.bars.begin(), figure.bars.end(), [](const TornadoBar& a, const TornadoBar& b) {
    const double u = std::abs(a.value), v = std::abs(b.value);
    return u != v ? u > v : a.parameter < b.parameter;
  });
  if (!zero.empty()) figure.left_out = "their value is 0: " + zero;
  if (!unknown.empty())
    figure.left_out += (figure.left_out.empty() ? "" : "; ") + ("no rate by: " + unknown);
}

std::string texts(const TornadoFigure& figure, bool is_tex) {
  std::string script = gnuplot_assignment("figure_title", text_for(figure.title, is_tex)) +
                       gnuplot_assignment("x_title", text_for(figure.x_title, is_tex)) +
                       "left_out = " + gnuplot_string(text_for({figure.left_out}, is_tex).text) +
                       "\n" + "array parameter[" + std::to_string(figure.bars.size()) + "]\n";
  for (std::size_t i = 0; i < figure.bars.size(); ++i)
    script += "parameter[" + std::to_string(i + 1) +
              "] = " + gnuplot_string(text_for({figure.bars[i].parameter}, is_tex).text) + "\n";
  return script;
}

}  // namespace

std::vector<TornadoFigure> tornado_figures_of(const Case& the_case,
                                              const std::vector<StudyResult>& results,
                                              std::vector<std::string>& problems) {
  std::vector<TornadoFigure> figures;
  for (const TornadoSpec& spec : the_case.tornados) {
    const StudyResult* result = result_of(results, spec.study, spec.run);
    if (result == nullptr) continue;
    const PlannedRun* planned = plan_of(the_case, *result);
    const auto at = point_with(*result, spec.at);
    if (planned == nullptr || !at) {
      problems.push_back("figure '" + spec.name + "': " + heading_of(*result) + " has no " +
                         spec.at);
      continue;
    }
    TornadoFigure figure{.name = safe_file_name(spec.name), .title = {spec.title, spec.markup}};
    const std::string made = "d ln(" + spec.quantity + ") / d ln(parameter) at " + spec.at;
    figure.look = spec.look;
    figure.x_title = spec.label.empty() ? FigureText{made} : FigureText{spec.label, spec.markup};
    add_bars(*result, *planned, spec, *at, figure);
    const bool is_finite = !figure.bars.empty() &&
                           std::all_of(figure.bars.begin(), figure.bars.end(),
                                       [](const auto& bar) { return std::isfinite(bar.value); });
    if (is_finite)
      figures.push_back(std::move(figure));
    else
      problems.push_back("figure '" + spec.name + "': " +
                         (figure.bars.empty() ? "there is no bar to draw (" + figure.left_out + ")"
                                              : spec.quantity + " is 0 at " + spec.at +
                                                    ": there are no relative sensitivities"));
  }
  return figures;
}

std::string tornado_script(const TornadoFigure& figure, const std::string& style,
                           const std::string& drawing) {
  std::string script =
      "# Written by springfold; `gnuplot " + figure.name + ".gp` draws it again.\n";
  script += "figure_name = " + gnuplot_string(figure.name) + "\n";
  const std::string count = std::to_string(figure.bars.size());
  script += "bars = " + count + "\n";
  script += "array value[" + count + "]\narray shown[" + count + "]\n";
  for (std::size_t i = 0; i < figure.bars.size(); ++i) {
    const std::string k = "[" + std::to_string(i + 1) + "] = ";
    script += "value" + k + shortest(figure.bars[i].value) + "\n";
    script += "shown" + k + gnuplot_string(rounded(figure.bars[i].value, 4)) + "\n";
  }
  for (const std::string& format : figure.look.formats)
    script += sheet_assignments(figure.look, format) + texts(figure, format == "tikz") + "\n" +
              style + "\n" + drawing;
  return script;
}

}  // namespace springfold::io
