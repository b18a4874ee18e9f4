#include "figure_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "result_access.hpp"
#include "stability_parts.hpp"

namespace springfold::io {
namespace {

using analysis::Branch;
using analysis::StudyResult;

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

/// A column at this row, or a parameter of the run.
double value_of(const Case& the_case, const StudyResult& result, const Branch& branch,
                std::size_t row, const std::string& name) {
  if (column_of(result, name)) return value_at(result, branch, row, name);
  const PlannedRun* planned = plan_of(the_case, result);
  if (planned == nullptr) return undefined;
  const auto known = planned->parameters.find(name);
  return known == planned->parameters.end() ? undefined : known->second;
}

/// A special point of a run, and what it is called there.
struct Found {
  PlotPoint place{undefined, undefined};
  std::string name{}, code{};
};

Found found_in(const Case& the_case, const PlotSpec& spec, const std::string& at,
               const StudyResult& result, const PlacePoint& place) {
  for (const Branch& branch : result.branches)
    for (const auto& event : branch.events)
      if (event.label == at)
        return {place(value_of(the_case, result, branch, event.row, spec.x),
                      value_of(the_case, result, branch, event.row, spec.y)),
                event.detail, analysis::code_of(event.kind)};
  return {};
}

/// Viridis (van der Walt, Smith, Firing) at 16 values: the palette of maps.
std::string viridis(double part) {
  static constexpr std::array<std::array<double, 3>, 16> colours{
      {{0x44, 0x01, 0x54}, {0x48, 0x1a, 0x6c}, {0x47, 0x2f, 0x7d}, {0x41, 0x44, 0x87},
       {0x39, 0x56, 0x8c}, {0x31, 0x68, 0x8e}, {0x2a, 0x78, 0x8e}, {0x23, 0x88, 0x8e},
       {0x1f, 0x98, 0x8b}, {0x22, 0xa8, 0x84}, {0x35, 0xb7, 0x79}, {0x54, 0xc5, 0x68},
       {0x7a, 0xd1, 0x51}, {0xa5, 0xdb, 0x36}, {0xd2, 0xe2, 0x1b}, {0xfd, 0xe7, 0x25}}};
  const double place = std::clamp(part, 0.0, 1.0) * static_cast<double>(colours.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(place), colours.size() - 2);
  const double rest = place - static_cast<double>(low);
  std::string text = "#";
  for (std::size_t i = 0; i < 3; ++i)
    text += fmt::format("{:02x}", static_cast<int>(std::lround(colours[low][i] * (1 - rest) +
                                                               colours[low + 1][i] * rest)));
  return text;
}

}  // namespace

void add_over_runs(Figure& figure, const Case& the_case, const PlotSpec& spec,
                   const std::string& at, const std::vector<const StudyResult*>& runs,
                   const PlacePoint& place) {
  std::string before;
  bool is_open = false;
  for (const StudyResult* result : runs) {
    const Found found = found_in(the_case, spec, at, *result, place);
    if (!is_finite(found.place)) {
      is_open = false;
      continue;
    }
    if (!is_open || found.name != before) {
      const int hue = static_cast<int>(figure.curves.size()) + 1;
      figure.curves.push_back({{found.name}, {{Stability::stable, {}}}, hue});
    }
    is_open = true;
    before = found.name;
    figure.curves.back().parts.front().line.push_back(found.place);
    figure.marks.push_back({found.code, "", found.place});
  }
}

void shade_stable(Figure& figure, const PlotSpec& spec,
                  const std::vector<const StudyResult*>& runs, const PlacePoint& place) {
  for (const StudyResult* result : runs) {
    double covered = undefined;
    for (const Branch& branch : result->branches) {
      Polyline region;
      double first = undefined, last = undefined;
      for (std::size_t row = 0; row < branch.samples.size(); ++row) {
        const double x = value_at(*result, branch, row, spec.x);
        const double y = value_at(*result, branch, row, spec.y);
        if (!is_finite({x, y})) continue;
        if (region.empty()) {
          first = x;
          region.push_back(place(x, 0));
        }
        last = x;
        region.push_back(place(x, y));
      }
      if (region.empty()) continue;
      region.push_back(place(last, 0));
      figure.shades.push_back(std::move(region));
      if (!spec.polar && covered < first) {
        const double left = covered * spec.x_factor, right = first * spec.x_factor;
        const double top = figure.high.second;
        figure.shades.push_back({{left, 0}, {left, top}, {right, top}, {right, 0}});
      }
      covered = last;
    }
  }
}

void colour_by(Figure& figure, const std::string& parameter, const std::vector<double>& values) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : values)
    if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  if (!(low < high)) return;
  figure.scale_title = parameter;
  figure.scale = {low, high};
  for (std::size_t i = 0; i < figure.curves.size() && i < values.size(); ++i)
    figure.curves[i].colour = std::isfinite(values[i]) ? viridis((values[i] - low) / (high - low))
                                                       : "#777777";
}

}  // namespace springfold::io
