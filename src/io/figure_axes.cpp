// How far the axes of a figure reach.
#include <algorithm>
#include <cmath>
#include <limits>

#include "canvas.hpp"
#include "stability_parts.hpp"

namespace springfold::io {
namespace {

struct AxisRange {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  bool is_log = false;
  double least = 0;  ///< of a logarithmic axis

  void include(double value) {
    if (is_log && !(value > 0 && value >= least)) return;
    low = std::min(low, value), high = std::max(high, value);
  }

  /// Some room on both sides; a single value gets room of its own size.
  AxisRange padded() const {
    if (is_log) {
      const double factor = high > low ? std::pow(high / low, 0.05) : 1.05;
      return {low / factor, high * factor, true};
    }
    // Nothing but zeros: ticks of any size would be wrong but those around 0.
    if (low == 0 && high == 0) return {-1, 1};
    const double room = 0.05 * (high > low ? high - low : std::abs(low));
    return {low - room, high + room};
  }
};

/// Makes a unit as long along x as along y; what lies in between stays in the middle.
void equalise(const Canvas& canvas, AxisRange& x, AxisRange& y) {
  const double wide = canvas.right - canvas.left, high = canvas.top - canvas.bottom;
  const double unit = std::max((x.high - x.low) / wide, (y.high - y.low) / high);
  const auto widen = [](AxisRange& range, double length) {
    const double middle = 0.5 * (range.low + range.high);
    range = {middle - 0.5 * length, middle + 0.5 * length};
  };
  widen(x, unit * wide);
  widen(y, unit * high);
}

}  // namespace

bool fit_axes(Figure& figure, bool polar) {
  const PlotLook& look = figure.look;
  AxisRange x{.is_log = look.x_log, .least = figure.least.first};
  AxisRange y{.is_log = look.y_log, .least = figure.least.second};
  const auto include = [&](const PlotPoint& at) {
    const bool out_of_x =
        look.x_range && (at.first < look.x_range->first || at.first > look.x_range->second);
    const bool out_of_y =
        look.y_range && (at.second < look.y_range->first || at.second > look.y_range->second);
    if (!out_of_x && !out_of_y) x.include(at.first), y.include(at.second);
  };
  for (const auto& curve : figure.curves)
    for (const auto& part : curve.parts) std::for_each(part.line.begin(), part.line.end(), include);
  for (const auto& mark : figure.marks) include(mark.at);
  for (const auto& [from, to] : figure.arrows) include(from), include(to);
  for (const FigureRegion& region : figure.regions)
    for (const Polyline& outline : region.parts)
      for (const PlotPoint& corner : outline) {  // what is infinite reaches to the edge
        if (std::isfinite(corner.first)) x.include(corner.first);
        if (std::isfinite(corner.second)) y.include(corner.second);
      }
  if (!(x.low <= x.high) || !(y.low <= y.high)) return false;
  if (polar) include({0, 0});
  AxisRange padded_x = x.padded(), padded_y = y.padded();
  if (look.x_range) padded_x.low = look.x_range->first, padded_x.high = look.x_range->second;
  if (look.y_range) padded_y.low = look.y_range->first, padded_y.high = look.y_range->second;
  if (polar || look.equal) equalise(canvas_of(look, figure.bar.has_value()), padded_x, padded_y);
  figure.low = {padded_x.low, padded_y.low};
  figure.high = {padded_x.high, padded_y.high};
  fit_regions(figure);
  return true;
}

}  // namespace springfold::io
