// Colours of the runs of a sweep: dark to light is small to large, told apart in grey too.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "figure.hpp"

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

/// The one parameter that differs between runs of one study; empty if there is none, or several do.
std::string varied_parameter(const std::vector<RunCurves>& runs) {
  std::string found;
  for (const RunCurves& run : runs)
    if (run.planned == nullptr || run.planned->study != runs.front().planned->study) return {};
  for (const std::string& name : runs.front().planned->varied) {
    const double first = runs.front().planned->parameters.at(name);
    const bool differs = std::any_of(runs.begin(), runs.end(), [&](const RunCurves& run) {
      return run.planned->parameters.at(name) != first;
    });
    if (differs && !found.empty()) return {};
    if (differs) found = name;
  }
  return found;
}

/// Numbers of runs stand for labels, as many as can be read.
void number_runs(const std::vector<RunCurves>& runs, Figure& figure) {
  constexpr std::size_t most_numbers = 12;
  const std::size_t every = (runs.size() + most_numbers - 1) / most_numbers;
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (std::size_t c = runs[i].first; c < runs[i].first + runs[i].count; ++c) {
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

void colour_by_value(const std::vector<RunCurves>& runs, Figure& figure) {
  constexpr std::size_t fewest_coloured = 3, most_labels = 6;
  if (runs.size() < fewest_coloured || runs.front().planned == nullptr) return;
  const std::string name = varied_parameter(runs);
  if (name.empty()) return;
  ColourBar bar{name, runs.front().planned->parameters.at(name), 0};
  bar.high = bar.low;
  for (const RunCurves& run : runs) {
    const double value = run.planned->parameters.at(name);
    bar.low = std::min(bar.low, value), bar.high = std::max(bar.high, value);
  }
  for (const RunCurves& run : runs) {
    const double part = (run.planned->parameters.at(name) - bar.low) / (bar.high - bar.low);
    for (std::size_t c = run.first; c < run.first + run.count; ++c)
      figure.curves[c].colour = sweep_colour(part);
  }
  if (runs.size() <= most_labels) return;
  number_runs(runs, figure);
  figure.bar = bar;
}

}  // namespace springfold::io
