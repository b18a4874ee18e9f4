#include "canvas.hpp"

#include <algorithm>
#include <cmath>

#include "round_ticks.hpp"

namespace springfold::io {
namespace {

/// Part of the way from low to high, 0 to 1 between them.
double part_of(double value, double low, double high, bool is_log) {
  if (!is_log) return (value - low) / (high - low);
  return std::log(value / low) / std::log(high / low);
}

double value_between(double part, double low, double high, bool is_log) {
  if (!is_log) return low + part * (high - low);
  return low * std::pow(high / low, part);
}

}  // namespace

Canvas canvas_of(const PlotLook& look, bool with_bar) {
  const Canvas usual;
  const PlotLook usual_look;
  const double scale = look.font_size / usual_look.font_size;
  Canvas canvas{.width = look.width, .height = look.height};
  constexpr double bar_room = 130;  // of the bar, its numbers and its title
  canvas.left = scale * usual.left;
  canvas.bottom = scale * usual.bottom;
  canvas.right = look.width - scale * (usual.width - usual.right + (with_bar ? bar_room : 0));
  canvas.top = look.height - scale * (usual.height - usual.top);
  canvas.text_height = scale * usual.text_height;
  return canvas;
}

PlotPoint in_pixels(const Figure& figure, const Canvas& canvas, const PlotPoint& at) {
  const double u = part_of(at.first, figure.low.first, figure.high.first, figure.look.x_log);
  const double v = part_of(at.second, figure.low.second, figure.high.second, figure.look.y_log);
  return {canvas.left + u * (canvas.right - canvas.left),
          canvas.bottom + v * (canvas.top - canvas.bottom)};
}

PlotPoint from_pixels(const Figure& figure, const Canvas& canvas, const PlotPoint& pixel) {
  const double u = (pixel.first - canvas.left) / (canvas.right - canvas.left);
  const double v = (pixel.second - canvas.bottom) / (canvas.top - canvas.bottom);
  return {value_between(u, figure.low.first, figure.high.first, figure.look.x_log),
          value_between(v, figure.low.second, figure.high.second, figure.look.y_log)};
}

InsetPlace place_of_inset(const PlotInset& inset, const PlotLook& look, const Canvas& canvas) {
  constexpr double part = 0.34, gap = 0.04;  // of the frame
  constexpr double letter = 0.6;             // width of a digit [text heights]
  constexpr std::size_t most_ticks = 4;
  InsetPlace place{.x_ticks = round_ticks(inset.x, look.x_log, most_ticks),
                   .y_ticks = round_ticks(inset.y, look.y_log, most_ticks)};
  std::size_t longest = 0;
  for (const std::string& tick : place.y_ticks) longest = std::max(longest, tick.size());
  place.left_room = canvas.text_height * (1.2 + letter * static_cast<double>(longest));
  place.bottom_room = 1.9 * canvas.text_height;
  const double wide = canvas.right - canvas.left, high = canvas.top - canvas.bottom;
  const bool right = inset.corner.ends_with("right"), top = inset.corner.starts_with("top");
  const double x =
      right ? canvas.right - (gap + part) * wide : canvas.left + gap / 2 * wide + place.left_room;
  const double y =
      top ? canvas.top - (gap + part) * high : canvas.bottom + gap / 2 * high + place.bottom_room;
  place.low = {x, y};
  place.high = {x + part * wide, y + part * high};
  return place;
}

}  // namespace springfold::io
