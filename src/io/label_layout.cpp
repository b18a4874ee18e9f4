#include "label_layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "gnuplot_text.hpp"
#include "stability_parts.hpp"
#include "text.hpp"

namespace springfold::io {

namespace {

constexpr double curve_spacing = 4;   // between the points that stand for a curve [pixel]
constexpr double mark_radius = 8;     // half size of a marker [pixel]
constexpr double leader_needed = 26;  // longest gap between point and text without a line [pixel]

struct Box {
  PlotPoint centre{};
  double half_width = 0, half_height = 0;

  bool holds(const PlotPoint& p, double margin) const {
    return std::abs(p.first - centre.first) <= half_width + margin &&
           std::abs(p.second - centre.second) <= half_height + margin;
  }
  bool overlaps(const Box& other, double margin) const {
    return std::abs(centre.first - other.centre.first) <= half_width + other.half_width + margin &&
           std::abs(centre.second - other.centre.second) <=
               half_height + other.half_height + margin;
  }
  /// Point of the box nearest to p.
  PlotPoint nearest(const PlotPoint& p) const {
    return {std::clamp(p.first, centre.first - half_width, centre.first + half_width),
            std::clamp(p.second, centre.second - half_height, centre.second + half_height)};
  }
};

double distance(const PlotPoint& a, const PlotPoint& b) {
  return std::hypot(a.first - b.first, a.second - b.second);
}

/// Everything that a label must not hide.
struct Scene {
  std::vector<std::vector<PlotPoint>> curves{};  ///< evenly spaced points of each curve
  std::vector<Box> marks{};
  std::vector<Box> labels{};
  PlotPoint zero{};  ///< where the axes through zero are
  Box frame{};
};

bool is_in_frame(const PlotPoint& p, const Canvas& canvas) {
  return p.first >= canvas.left && p.first <= canvas.right && p.second >= canvas.bottom &&
         p.second <= canvas.top;
}

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
      const double length = last ? distance(*last, here) : 0;
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

Scene scene_of(const Figure& figure, const Canvas& canvas) {
  Scene scene;
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

/// A text of average letters; a little too wide is better than too narrow.
Box box_of(const FigureText& label, const Canvas& canvas) {
  const std::string text = label.is_markup ? without_markup(label.text) : label.text;
  const double width = 0.56 * canvas.text_height * static_cast<double>(width_of(text));
  return {{}, width / 2, canvas.text_height / 2};
}

/// How bad it would be to have a text there: hidden curve points, marks and texts.
double badness(const Scene& scene, const Box& box) {
  double sum = 0;
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

struct Candidate {
  Box box{};
  PlotPoint anchor{};
  double badness = std::numeric_limits<double>::infinity();
};

double gap_between(const Box& box, const std::vector<PlotPoint>& points) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& point : points) nearest = std::min(nearest, distance(box.nearest(point), point));
  return nearest;
}

/// How much nearer the text is to another curve than to the one that it names.
double misleading(const Scene& scene, const Box& box, std::size_t own) {
  double nearest_other = std::numeric_limits<double>::infinity();
  for (std::size_t other = 0; other < scene.curves.size(); ++other)
    if (other != own)
      nearest_other = std::min(nearest_other, gap_between(box, scene.curves[other]));
  return 1.5 * std::max(0.0, gap_between(box, scene.curves[own]) - nearest_other);
}

/// Curve that a text names; none for a special point.
using Owner = std::optional<std::size_t>;

/// Keeps the better one; the earlier one when both are as good.
void consider(Candidate& best, const Scene& scene, const Box& box, const PlotPoint& anchor,
              double extra, Owner owner) {
  double value = badness(scene, box) + extra;
  if (owner && value < best.badness) value += misleading(scene, box, *owner);
  if (value < best.badness) best = {box, anchor, value};
}

/// Tries places around the anchor, `gap` pixels between it and the text.
void try_around(Candidate& best, const Scene& scene, Box box, const PlotPoint& anchor, double gap,
                double extra, Owner owner = std::nullopt) {
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
    consider(best, scene, box, anchor, extra + 0.01 * static_cast<double>(i), owner);
  }
}

/// Curves that lie on each other have the same points: one label is enough.
bool is_labelled_already(const Figure& figure, const Scene& scene, std::size_t mark) {
  constexpr double near = 14;
  for (std::size_t i = 0; i < mark; ++i)
    if (figure.marks[i].label == figure.marks[mark].label &&
        distance(scene.marks[i].centre, scene.marks[mark].centre) < near)
      return true;
  return false;
}

/// Do two marks of one kind lie on each other? Mirrored points do where the mirror is not shown.
bool is_covered(const Figure& figure, const Scene& scene, std::size_t a, std::size_t b) {
  constexpr double near = 3;
  return figure.marks[a].code == figure.marks[b].code &&
         distance(scene.marks[a].centre, scene.marks[b].centre) < near;
}

/// "LP3, LP6": labels of all marks that lie on this one; empty if an earlier one has said them.
std::string shared_label(const Figure& figure, const Scene& scene, std::size_t mark) {
  for (std::size_t i = 0; i < mark; ++i)
    if (is_covered(figure, scene, i, mark)) return "";
  std::vector<std::string> labels;
  for (std::size_t i = mark; i < figure.marks.size(); ++i) {
    const std::string& label = figure.marks[i].label;
    const bool is_new = std::find(labels.begin(), labels.end(), label) == labels.end();
    if (is_new && !label.empty() && is_covered(figure, scene, i, mark)) labels.push_back(label);
  }
  std::string text;
  for (const std::string& label : labels) text += (text.empty() ? "" : ", ") + label;
  return text;
}

PlacedLabel placed(const FigureText& text, const Candidate& best) {
  PlacedLabel label{.text = text, .at = best.box.centre};
  label.leader_from = best.anchor;
  label.leader_to = best.box.nearest(best.anchor);
  label.has_leader = distance(label.leader_from, label.leader_to) > leader_needed;
  return label;
}

Candidate place_of_mark(const Scene& scene, const Box& box, const PlotPoint& anchor) {
  Candidate best;
  for (const double gap : {12.0, 18.0, 26.0, 40.0, 60.0, 85.0, 115.0})
    try_around(best, scene, box, anchor, gap, 0.4 * gap);
  return best;
}

/// Beside its curve, rather at an end than in the middle, where all other curves are farther away.
Candidate place_on_curve(const Scene& scene, const Box& box, std::size_t own) {
  const auto& points = scene.curves[own];
  Candidate best;
  constexpr std::size_t tries = 60;
  for (std::size_t i = 0; i <= tries; ++i) {
    const PlotPoint& anchor = points[i * (points.size() - 1) / tries];
    double nearest_other = std::numeric_limits<double>::infinity();
    for (std::size_t other = 0; other < scene.curves.size(); ++other)
      if (other != own)
        nearest_other = std::min(nearest_other, gap_between({anchor, 0, 0}, scene.curves[other]));
    const double ambiguity = 30 / (1 + nearest_other / 4);
    const double to_end =
        std::min(distance(points.front(), anchor), distance(points.back(), anchor));
    const double inside = std::min(8.0, to_end / 30);
    for (const double gap : {10.0, 16.0, 24.0, 40.0, 70.0})
      try_around(best, scene, box, anchor, gap, ambiguity + inside + 0.5 * gap, own);
  }
  return best;
}

}  // namespace

std::vector<PlacedLabel> place_labels(const Figure& figure, const Canvas& canvas) {
  Scene scene = scene_of(figure, canvas);
  std::vector<PlacedLabel> labels;
  const auto keep = [&](const FigureText& text, const Candidate& best, bool is_curve_label) {
    if (std::any_of(scene.labels.begin(), scene.labels.end(),
                    [&best](const Box& other) { return best.box.overlaps(other, 0); }))
      return;  // two texts on each other: neither could be read
    scene.labels.push_back(best.box);
    labels.push_back(placed(text, best));
    labels.back().is_curve_label = is_curve_label;
  };
  for (std::size_t i = 0; i < figure.marks.size(); ++i) {
    if (!is_in_frame(scene.marks[i].centre, canvas)) continue;
    if (is_labelled_already(figure, scene, i)) continue;
    const FigureText text{shared_label(figure, scene, i)};
    if (text.text.empty()) continue;
    keep(text, place_of_mark(scene, box_of(text, canvas), scene.marks[i].centre), false);
  }
  for (std::size_t i = 0; i < figure.curves.size(); ++i) {
    const auto& text = figure.curves[i].label;
    if (text.text.empty() || scene.curves[i].empty()) continue;
    keep(text, place_on_curve(scene, box_of(text, canvas), i), true);
  }
  return labels;
}

}  // namespace springfold::io
