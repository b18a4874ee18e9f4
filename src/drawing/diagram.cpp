#include "diagram.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "glyphs.hpp"
#include "name_places.hpp"
#include "painter.hpp"
#include "springfold/core/number_text.hpp"

namespace springfold::drawing {
namespace {

/// Smallest and largest value, a little wider; a range around a single one.
void measure(std::vector<double> values, double& from, double& to) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return;
  from = *std::min_element(values.begin(), values.end());
  to = *std::max_element(values.begin(), values.end());
  // What rounding leaves of a constant is no range.
  constexpr double resolution = 1e-9;
  const double size = std::max(std::abs(from), std::abs(to));
  const double room =
      to - from > resolution * size ? 0.06 * (to - from) : (size > 0 ? 0.5 * size : 1);
  from -= room;
  to += room;
}

/// About five round numbers (1, 2 or 5 times a power of ten) within the range.
std::vector<double> ticks_within(double from, double to) {
  const double coarse = (to - from) / 5, power = std::pow(10, std::floor(std::log10(coarse)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * power >= coarse) step = factor * power;
  std::vector<double> ticks;
  const auto first = std::llround(std::ceil(from / step)),
             last = std::llround(std::floor(to / step));
  for (auto i = first; i <= last; ++i) ticks.push_back(static_cast<double>(i) * step);
  return ticks;
}

/// The curve between two points is as unstable as the worse of them: special points count fewer modes.
std::string colour_between(const DiagramPoint& a, const DiagramPoint& b) {
  Panel panel;
  if (a.unstable_dead && b.unstable_dead)
    panel.unstable_dead = std::max(*a.unstable_dead, *b.unstable_dead);
  if (a.unstable_driven && b.unstable_driven)
    panel.unstable_driven = std::max(*a.unstable_driven, *b.unstable_driven);
  return stability_colour(panel);
}

struct Style {
  Ink ink{};
  int rank = 0;  ///< the more stable ones first
};

Style style_of(const std::string& colour) {
  Style style{{colour, "", 2, {}}};
  const auto dash = [&](int rank, std::vector<double> dashes) {
    style.rank = rank;
    style.ink.dashes = std::move(dashes);
  };
  if (colour == ink_colour) dash(1, {8, 3, 2, 3});  // not known
  if (colour == driven_colour) dash(2, {8, 4});
  if (colour == unstable_colour) dash(3, {3, 4});
  return style;
}

}  // namespace

bool is_known(const DiagramPoint& point) {
  return std::isfinite(point.x) && std::isfinite(point.y);
}

DiagramAxes::DiagramAxes(const Diagram& diagram, const Box& frame)
    : diagram_{diagram}, frame_{frame} {
  std::vector<double> xs, ys;
  for (const DiagramPoint& point : diagram.points)
    if (is_known(point)) {
      xs.push_back(point.x);
      ys.push_back(point.y);
    }
  measure(std::move(xs), left_, right_);
  measure(std::move(ys), low_, high_);
}

Place DiagramAxes::place(const DiagramPoint& point) const {
  return {frame_.left + (frame_.right - frame_.left) * (point.x - left_) / (right_ - left_),
          frame_.bottom - (frame_.bottom - frame_.top) * (point.y - low_) / (high_ - low_)};
}

bool DiagramAxes::paint(Picture& picture) const {
  paint_ticks(picture);
  const bool is_mixed = paint_curve(picture);
  paint_points(picture);
  return is_mixed;
}

void DiagramAxes::paint_ticks(Picture& picture) const {
  const Ink faint{"#e4e4e4", "", 1, {}}, edge{"#777777", "", 1, {}};
  const auto line = [&](Place a, Place b) {
    picture.marks.emplace_back(Path{{a, b}, false, faint, "", false});
  };
  const auto words = [&](Place at, const std::string& text, Anchor anchor) {
    picture.marks.emplace_back(
        Words{.at = at, .text = text, .anchor = anchor, .size = 11, .colour = "#444444"});
  };
  for (const double tick : ticks_within(left_, right_)) {
    const double x = place({.x = tick}).x;
    line({x, frame_.top}, {x, frame_.bottom});
    words({x, frame_.bottom + 15}, rounded(tick), Anchor::middle);
  }
  for (const double tick : ticks_within(low_, high_)) {
    const double y = place({.y = tick}).y;
    line({frame_.left, y}, {frame_.right, y});
    words({frame_.left - 6, y + 4}, rounded(tick), Anchor::end);
  }
  picture.marks.emplace_back(Path{{{frame_.left, frame_.top},
                                   {frame_.right, frame_.top},
                                   {frame_.right, frame_.bottom},
                                   {frame_.left, frame_.bottom}},
                                  true,
                                  edge});
  words({(frame_.left + frame_.right) / 2, frame_.bottom + 33}, diagram_.x_name, Anchor::middle);
  words({frame_.left, frame_.top - 8}, diagram_.y_name, Anchor::start);
}

std::vector<Path> DiagramAxes::curve() const {
  constexpr double visible = 0.6;  // pixels between points of a line
  std::vector<Path> parts;
  Path path;
  const auto finish = [&] {
    if (path.places.size() > 1) parts.push_back(path);
    path.places.clear();
  };
  for (std::size_t i = 1; i < diagram_.points.size(); ++i) {
    const DiagramPoint &a = diagram_.points[i - 1], &b = diagram_.points[i];
    if (!is_known(a) || !is_known(b)) {
      finish();
      continue;
    }
    const std::string colour = colour_between(a, b);
    if (!path.places.empty() && path.ink.stroke != colour) {
      path.places.push_back(place(a));
      finish();
    }
    if (path.places.empty()) {
      path.ink = style_of(colour).ink;
      path.places.push_back(place(a));
    }
    const bool is_last = i + 1 == diagram_.points.size() || !is_known(diagram_.points[i + 1]);
    if (is_last || length(place(b) - path.places.back()) > visible) path.places.push_back(place(b));
  }
  finish();
  return parts;
}

bool DiagramAxes::paint_curve(Picture& picture) const {
  const std::vector<Path> parts = curve();
  std::vector<RankedLine> lines;
  for (const Path& part : parts)
    lines.push_back({.rank = style_of(part.ink.stroke).rank, .places = part.places});
  const std::vector<SeenLine> seen = without_overlaps(lines, frame_.right, frame_.bottom);
  for (const SeenLine& line : seen)
    for (const Stretch& stretch : line.beneath)
      picture.marks.emplace_back(Path{stretch.places, false, {mixed_colour, "", mixed_width, {}}});
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (seen[i].is_whole) picture.marks.emplace_back(parts[i]);
    for (const Stretch& stretch : seen[i].stretches)
      picture.marks.emplace_back(Path{stretch.places, false, parts[i].ink});
  }
  return std::any_of(seen.begin(), seen.end(),
                     [](const SeenLine& line) { return !line.beneath.empty(); });
}

void DiagramAxes::paint_points(Picture& picture) const {
  constexpr double radius = 3;
  std::vector<WantedName> names;
  for (const DiagramPoint& point : diagram_.points) {
    if (point.label.empty() || !is_known(point)) continue;
    picture.marks.emplace_back(Disc{place(point), radius, {ink_colour, "#ffffff", 1.4, {}}});
    names.push_back({place(point), {.text = point.label, .size = 11}, radius + 1});
  }
  place_names(names, frame_, picture);
}

}  // namespace springfold::drawing
