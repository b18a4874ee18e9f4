#include "label_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "curve_labels.hpp"
#include "gnuplot_text.hpp"
#include "stability_parts.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

constexpr double curve_spacing = 4;  // between the points that stand for a curve [pixel]
constexpr double mark_radius = 8;    // half size of a marker [pixel]

std::vector<PlotPoint> dense_points(const Figure& figure, const Canvas& canvas,
                                    const FigureCurve& curve) {
  std::vector<PlotPoint> dense;
  for (const auto& part : curve.parts) {
    std::optional<PlotPoint> last;  // end of the last stretch, `left_over` pixels after a point
    double left_over = curve_spacing;
    for (const auto& at : part.line) {
      const PlotPoint here = in_pixels(figure, canvas, at);
      if (!is_finite(here)) {  // no place on a logarithmic axis
        last.reset();
        continue;
      }
      const double length = last ? pixels_between(*last, here) : 0;
      const bool is_near = length < 2 * (canvas.width + canvas.height);
      for (double along = curve_spacing - left_over; last && is_near && along <= length;
           along += curve_spacing)
        if (const PlotPoint p{last->first + (here.first - last->first) * along / length,
                              last->second + (here.second - last->second) * along / length};
            is_in_frame(p, canvas))
          dense.push_back(p);
      left_over = std::fmod(left_over + length, curve_spacing);
      last = here;
    }
  }
  return dense;
}

/// Does the line from one point to the other lead through a text?
bool leads_through(const LabelBox& box, const PlotPoint& from, const PlotPoint& to) {
  constexpr double step = 3;  // pixels
  const int count = static_cast<int>(pixels_between(from, to) / step) + 1;
  for (int i = 0; i <= count; ++i) {
    const double t = static_cast<double>(i) / count;
    if (box.holds(
            {from.first + t * (to.first - from.first), from.second + t * (to.second - from.second)},
            1))
      return true;
  }
  return false;
}

constexpr double dot_radius = 5;  // of the end of a line on a curve, with room around it [pixel]

/// Do two lines cross?
bool cross(const std::pair<PlotPoint, PlotPoint>& a, const std::pair<PlotPoint, PlotPoint>& b) {
  const auto side = [](const PlotPoint& p, const std::pair<PlotPoint, PlotPoint>& of) {
    return (of.second.first - of.first.first) * (p.second - of.first.second) -
           (of.second.second - of.first.second) * (p.first - of.first.first);
  };
  return side(a.first, b) * side(a.second, b) < 0 && side(b.first, a) * side(b.second, a) < 0;
}

/// Its own line through the dots and marks of others, or theirs through its dot, would name the wrong thing; lines that
/// cross have to be looked at twice.
double misleading_dots(const LabelScene& scene, const PlotPoint& anchor, const PlotPoint& text) {
  constexpr double misleading = 100, tangled = 40;
  const auto dot_at = [](const PlotPoint& at) { return LabelBox{at, dot_radius, dot_radius}; };
  double sum = 0;
  for (const LabelBox& mark : scene.marks)
    if (!mark.holds(anchor, 0) && leads_through(mark, anchor, text)) sum += misleading;
  for (const auto& [from, to] : scene.leaders)
    if (leads_through(dot_at(from), anchor, text) || leads_through(dot_at(anchor), from, to))
      sum += misleading;
    else if (cross({anchor, text}, {from, to}))
      sum += tangled;
  return sum;
}

/// Lines to what texts name: those of others through this one, and its own through others.
double crossed_by_leaders(const LabelScene& scene, const LabelBox& box, const PlotPoint& anchor) {
  constexpr double crossed = 100;
  double sum = 0;
  for (const auto& [from, to] : scene.leaders)
    if (leads_through(box, from, to)) sum += crossed;
  if (!needs_leader(box, anchor)) return sum;
  for (const LabelBox& label : scene.labels)
    if (leads_through(label, anchor, box.nearest(anchor))) sum += crossed;
  return sum + misleading_dots(scene, anchor, box.nearest(anchor));
}

/// How bad it would be to have a text there: hidden curve points, marks, texts and lines to what texts name.
double badness(const LabelScene& scene, const LabelBox& box, const PlotPoint& anchor) {
  double sum = crossed_by_leaders(scene, box, anchor);
  for (const auto& curve : scene.curves)
    for (const auto& point : curve)
      if (box.holds(point, 4)) sum += 3;
  for (const auto& mark : scene.marks)
    if (box.overlaps(mark, 1)) sum += 60;
  for (const auto& label : scene.labels)
    if (box.overlaps(label, 5)) sum += 200;
  const bool is_on_axis = std::abs(box.centre.first - scene.zero.first) < box.half_width + 2 ||
                          std::abs(box.centre.second - scene.zero.second) < box.half_height + 2;
  if (is_on_axis) sum += 5;
  const bool sticks_out =
      std::abs(box.centre.first - scene.frame.centre.first) + box.half_width >
          scene.frame.half_width - 4 ||
      std::abs(box.centre.second - scene.frame.centre.second) + box.half_height >
          scene.frame.half_height - 4;
  return sticks_out ? sum + 1000 : sum;
}

/// Keeps the better one; the earlier one when both are as good.
void consider(LabelCandidate& best, const LabelScene& scene, const LabelBox& box,
              const PlotPoint& anchor, double extra, const ExtraBadness& more) {
  if (extra >= best.badness) return;  // whatever is hidden
  double value = badness(scene, box, anchor) + extra;
  if (more && value < best.badness) value += more(box, anchor);
  if (value < best.badness) best = {box, anchor, value};
}

}  // namespace

double pixels_between(const PlotPoint& a, const PlotPoint& b) {
  return std::hypot(a.first - b.first, a.second - b.second);
}

bool is_in_frame(const PlotPoint& p, const Canvas& canvas) {
  return p.first >= canvas.left && p.first <= canvas.right && p.second >= canvas.bottom &&
         p.second <= canvas.top;
}

LabelScene label_scene_of(const Figure& figure, const Canvas& canvas) {
  LabelScene scene;
  for (const auto& curve : figure.curves)
    scene.curves.push_back(dense_points(figure, canvas, curve));
  for (const auto& mark : figure.marks)
    scene.marks.push_back({in_pixels(figure, canvas, mark.at), mark_radius, mark_radius});
  for (const PlotInset& inset : figure.look.insets) {
    const InsetPlace place = place_of_inset(inset, figure.look, canvas);
    const double left = place.low.first - place.left_room, right = place.high.first;
    const double bottom = place.low.second - place.bottom_room, top = place.high.second;
    scene.labels.push_back(
        {{(left + right) / 2, (bottom + top) / 2}, (right - left) / 2, (top - bottom) / 2});
  }
  scene.zero = in_pixels(figure, canvas, {0, 0});
  scene.frame = {{(canvas.left + canvas.right) / 2, (canvas.bottom + canvas.top) / 2},
                 (canvas.right - canvas.left) / 2,
                 (canvas.top - canvas.bottom) / 2};
  return scene;
}

LabelBox box_of(const FigureText& label, const Canvas& canvas) {
  const std::string text = label.is_markup ? without_markup(label.text) : label.text;
  const double width = 0.56 * canvas.text_height * static_cast<double>(width_of(text));
  return {{}, width / 2, canvas.text_height / 2};
}

double gap_between(const LabelBox& box, const std::vector<PlotPoint>& points) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& point : points)
    nearest = std::min(nearest, pixels_between(box.nearest(point), point));
  return nearest;
}

void try_around(LabelCandidate& best, const LabelScene& scene, LabelBox box,
                const PlotPoint& anchor, double gap, double extra, const ExtraBadness& more) {
  // Above and to the right first: where readers look first.
  constexpr std::array<double, 12> eighths = {1, 2, 0, 7, 3, 6, 4, 5, 0.5, 1.5, 2.5, 6.5};
  for (std::size_t i = 0; i < eighths.size(); ++i) {
    const double angle = eighths[i] * std::numbers::pi / 4;
    const double c = std::cos(angle), s = std::sin(angle);
    const double larger = std::max(std::abs(c), std::abs(s));  // along the sides of a rectangle
    box.centre = {anchor.first + box.half_width * c / larger + gap * c,
                  anchor.second + box.half_height * s / larger + gap * s};
    // A text wider than the frame is seen in part, rather than not at all.
    if (box.half_width > scene.frame.half_width) box.centre.first = scene.frame.centre.first;
    consider(best, scene, box, anchor, extra + 0.01 * static_cast<double>(i), more);
  }
}

}  // namespace springfold::io
