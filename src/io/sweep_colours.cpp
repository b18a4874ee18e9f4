// Colours of the runs of a sweep: dark to light is small to large, told apart in grey too.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "figure.hpp"
#include "result_access.hpp"

namespace springfold::io {
namespace {

/// Viridis (van der Walt, Smith, Firing) without its light end, which is not seen on white.
constexpr std::array<std::array<double, 3>, 8> stops{{{68, 1, 84},
                                                      {72, 40, 120},
                                                      {62, 73, 137},
                                                      {49, 104, 142},
                                                      {38, 130, 142},
                                                      {31, 158, 137},
                                                      {53, 183, 121},
                                                      {122, 199, 63}}};

/// The values of a parameter in the runs.
std::vector<double> values_of(const std::vector<RunCurves>& runs, const std::string& name) {
  std::vector<double> values;
  for (const RunCurves& run : runs) values.push_back(run.planned->parameters.at(name));
  return values;
}

/// Parameters that differ between runs of one study.
std::vector<std::string> differing_parameters(const std::vector<RunCurves>& runs) {
  for (const RunCurves& run : runs)
    if (run.planned == nullptr || run.planned->study != runs.front().planned->study) return {};
  std::vector<std::string> names;
  for (const std::string& name : runs.front().planned->varied) {
    const auto values = values_of(runs, name);
    if (std::any_of(values.begin(), values.end(), [&](double v) { return v != values.front(); }))
      names.push_back(name);
  }
  return names;
}

std::size_t different(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values.size();
}

/// What the colours of runs say.
struct ColourScale {
  std::string title{};
  std::vector<double> values{};  ///< one per run
};

/// The parameter that differs; of several the one that has the most values, and of these the first. Where it does not
/// tell all runs apart, as on a grid, the title says what their numbers run over. No values where nothing differs.
ColourScale colour_scale(const std::vector<RunCurves>& runs, const UnitLabels& units) {
  const std::vector<std::string> names = differing_parameters(runs);
  std::string list;
  ColourScale scale;
  std::size_t most = 0;
  for (const std::string& name : names) {
    const std::vector<double> values = values_of(runs, name);
    list += (list.empty() ? "" : ", ") + name;
    if (different(values) <= most) continue;
    most = different(values);
    scale = {parameter_title(name, units), values};
  }
  if (names.size() > 1 && most < runs.size()) scale.title += "; numbers: runs over " + list;
  return scale;
}

/// Numbers of runs stand for labels, as many as can be read.
void number_runs(const std::vector<RunCurves>& runs, Figure& figure) {
  constexpr std::size_t most_numbers = 12;
  const std::size_t every = (runs.size() + most_numbers - 1) / most_numbers;
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (std::size_t c = runs[i].first; c < runs[i].first + runs[i].count && !runs[i].is_named;
         ++c) {
      const bool is_numbered = c == runs[i].first && (i % every == 0 || i + 1 == runs.size());
      figure.curves[c].label = {is_numbered ? std::to_string(runs[i].planned->run) : ""};
    }
}

}  // namespace

std::string sweep_colour(double part) {
  const double place = std::clamp(part, 0.0, 1.0) * (stops.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const double t = place - static_cast<double>(i);
  std::string colour = "#";
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<char, 3> text{};
    const double level = stops[i][k] + t * (stops[i + 1][k] - stops[i][k]);
    std::snprintf(text.data(), text.size(), "%02X", static_cast<unsigned>(std::lround(level)));
    colour += text.data();
  }
  return colour;
}

void colour_by_value(const std::vector<RunCurves>& runs, const UnitLabels& units, Figure& figure) {
  constexpr std::size_t fewest_coloured = 3, most_labels = 6;
  if (runs.size() < fewest_coloured || runs.front().planned == nullptr) return;
  const auto [title, values] = colour_scale(runs, units);
  if (values.empty()) return;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const ColourBar bar{title, *low, *high};
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (std::size_t c = runs[i].first; c < runs[i].first + runs[i].count; ++c)
      figure.curves[c].colour = sweep_colour((values[i] - bar.low) / (bar.high - bar.low));
  figure.bar = bar;
  if (runs.size() > most_labels) number_runs(runs, figure);
}

}  // namespace springfold::io
