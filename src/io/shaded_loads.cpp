// Shaded parts of figures: loads that the path from the start reaches before the first critical one.
#include <algorithm>
#include <cmath>

#include "figure.hpp"
#include "result_access.hpp"

namespace springfold::io {
namespace {

using analysis::StudyResult;

/// A branch of the first critical load: its lines one after the other.
Polyline whole_line(const FigureCurve& curve) {
  Polyline line;
  for (const CurvePart& part : curve.parts)
    line.insert(line.end(), part.line.begin(), part.line.end());
  return line;
}

/// Between two values of the parameter, from the load at the start to the edge: there is no critical load.
Polyline open_part(double from, double to, double start) {
  return {{from, start}, {from, HUGE_VAL}, {to, HUGE_VAL}, {to, start}};
}

/// What lies below the branches of one run, and, where all of it is resolved, beside them.
std::vector<Polyline> held_parts(const PlotSpec& spec, const RunCurves& run,
                                 const StudyResult& result, const Figure& figure) {
  const analysis::CriticalPointSettings& asked = run.planned->plan.critical;
  const double start = 0;  // lambda at the start, but under control of a parameter
  std::vector<Polyline> parts;
  double done = spec.x_factor * asked.low;
  for (std::size_t i = run.first; i < run.first + run.count; ++i) {
    Polyline line = whole_line(figure.curves[i]);
    if (line.size() < 2) continue;
    const double from = line.front().first, to = line.back().first;
    if (complete(result)) parts.push_back(open_part(done, from, start));
    line.emplace_back(to, start);
    line.emplace_back(from, start);
    parts.push_back(std::move(line));
    done = to;
  }
  if (complete(result)) parts.push_back(open_part(done, spec.x_factor * asked.high, start));
  std::erase_if(parts, [](const Polyline& outline) {
    const auto [low, high] = std::minmax_element(outline.begin(), outline.end());
    return high->first - low->first <= 1e-9 * (std::abs(low->first) + std::abs(high->first));
  });
  return parts;
}

}  // namespace

void shade_held_loads(const std::vector<RunCurves>& runs, const PlotSpec& spec,
                      const std::vector<StudyResult>& results, Figure& figure) {
  for (const RunCurves& run : runs) {
    if (run.planned == nullptr || run.planned->plan.kind != analysis::StudyKind::critical_load)
      continue;
    const StudyResult* result = result_of(results, run.planned->study, run.planned->run);
    if (result == nullptr || !result->start.found) continue;
    const bool of_turns = run.planned->plan.critical.unwanted == analysis::Unwanted::limit_point;
    const char* const name = of_turns ? "no limit point from the start on"
                             : result->non_conservative.empty()
                                 ? "stable from the start on"
                                 : "no static loss of stability from the start on";
    figure.regions.push_back({name, true, held_parts(spec, run, *result, figure)});
  }
}

void fit_regions(Figure& figure) {
  const auto fit = [](double& value, double low, double high) {
    value = std::clamp(value, low, high);
  };
  for (FigureRegion& region : figure.regions)
    for (Polyline& outline : region.parts)
      for (PlotPoint& corner : outline) {
        if (std::isinf(corner.first) || figure.look.x_log)
          fit(corner.first, figure.low.first, figure.high.first);
        if (std::isinf(corner.second) || figure.look.y_log)
          fit(corner.second, figure.low.second, figure.high.second);
      }
}

}  // namespace springfold::io
