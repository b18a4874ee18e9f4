#include "seen_parts.hpp"

#include <algorithm>

#include "stability_parts.hpp"

namespace springfold::io {
namespace {

/// A part of the picture that shows something of the figure [pixel].
struct Window {
  PlotPoint low{}, high{};
};

/// The frame, and what insets show, where it would lie beside it.
std::vector<Window> windows_of(const Figure& figure, const Canvas& canvas) {
  std::vector<Window> windows{{{canvas.left, canvas.bottom}, {canvas.right, canvas.top}}};
  for (const PlotInset& inset : figure.look.insets)
    windows.push_back({in_pixels(figure, canvas, {inset.x.first, inset.y.first}),
                       in_pixels(figure, canvas, {inset.x.second, inset.y.second})});
  return windows;
}

bool window_holds(const Window& window, const PlotPoint& p) {
  constexpr double edge = 0.5;  // pixel: rounding
  return p.first > window.low.first - edge && p.first < window.high.first + edge &&
         p.second > window.low.second - edge && p.second < window.high.second + edge;
}

/// Does the straight line pass through the window? It is cut by the window's sides, one after the other.
bool passes(const Window& window, const PlotPoint& from, const PlotPoint& to) {
  double begin = 0, end = 1;
  const auto cut = [&](double start, double change, double low, double high) {
    if (change == 0) return start > low && start < high;
    const double a = (low - start) / change, b = (high - start) / change;
    begin = std::max(begin, std::min(a, b)), end = std::min(end, std::max(a, b));
    return begin < end;
  };
  return cut(from.first, to.first - from.first, window.low.first, window.high.first) &&
         cut(from.second, to.second - from.second, window.low.second, window.high.second);
}

}  // namespace

bool is_in_view(const Figure& figure, const Canvas& canvas, const PlotPoint& at) {
  const PlotPoint p = in_pixels(figure, canvas, at);
  const auto windows = windows_of(figure, canvas);
  return is_finite(p) && std::any_of(windows.begin(), windows.end(), [&p](const Window& window) {
           return window_holds(window, p);
         });
}

bool is_in_view(const Figure& figure, const Canvas& canvas, const Polyline& line) {
  const auto windows = windows_of(figure, canvas);
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const PlotPoint a = in_pixels(figure, canvas, line[i]);
    const PlotPoint b = in_pixels(figure, canvas, line[i + 1]);
    if (is_finite(a) && is_finite(b) &&
        std::any_of(windows.begin(), windows.end(),
                    [&](const Window& window) { return passes(window, a, b); }))
      return true;
  }
  return false;
}

}  // namespace springfold::io
