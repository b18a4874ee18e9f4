#include "plain_frame.hpp"

#include <algorithm>
#include <cmath>

#include "gnuplot_text.hpp"
#include "round_ticks.hpp"
#include "springfold/io/shown_text.hpp"
#include "stability_parts.hpp"
#include "text.hpp"

namespace springfold::io::plain {
namespace {

using drawing::Anchor;
using drawing::Box;
using drawing::Disc;
using drawing::Mark;
using drawing::Path;
using drawing::Picture;
using drawing::Place;
using drawing::Words;

double part_between(double value, double low, double high, bool is_log) {
  if (!is_log) return (value - low) / (high - low);
  return std::log(value / low) / std::log(high / low);
}

/// A half plane: value(place) >= 0 lies inside.
struct Side {
  double x = 0, y = 0, constant = 0;
  double value(const Place& p) const { return x * p.x + y * p.y + constant; }
};

std::vector<Side> sides_of(const Box& box) {
  return {{1, 0, -box.left}, {-1, 0, box.right}, {0, 1, -box.top}, {0, -1, box.bottom}};
}

Place between(const Place& a, const Place& b, double t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

/// The part of a straight line inside the box (Liang and Barsky): from and to as shares of it; false if there is none.
bool clip(const Box& box, const Place& a, const Place& b, double& from, double& to) {
  from = 0, to = 1;
  for (const Side& side : sides_of(box)) {
    const double u = side.value(a), v = side.value(b);
    if (u < 0 && v < 0) return false;
    if (u < 0) from = std::max(from, u / (u - v));
    if (v < 0) to = std::min(to, u / (u - v));
  }
  return from < to;
}

bool is_known(const Place& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

}  // namespace

Place Frame::place(const PlotPoint& at) const {
  const double u = part_between(at.first, low.first, high.first, x_log);
  const double v = part_between(at.second, low.second, high.second, y_log);
  return {box.left + u * (box.right - box.left), box.bottom - v * (box.bottom - box.top)};
}

bool Frame::holds(const Place& p) const {
  constexpr double edge = 1e-6;  // pixels: a point on the frame is inside
  return p.x >= box.left - edge && p.x <= box.right + edge && p.y >= box.top - edge &&
         p.y <= box.bottom + edge;
}

std::vector<std::vector<Place>> clipped(const Frame& frame, const Polyline& line) {
  std::vector<std::vector<Place>> parts;
  bool goes_on = false;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Place a = frame.place(line[i]), b = frame.place(line[i + 1]);
    double from = 0, to = 1;
    if (!is_known(a) || !is_known(b) || !clip(frame.box, a, b, from, to)) {
      goes_on = false;
      continue;
    }
    if (!goes_on || from > 0) parts.push_back({between(a, b, from)});
    parts.back().push_back(between(a, b, to));
    goes_on = to == 1;
  }
  return parts;
}

std::vector<Place> clipped_outline(const Frame& frame, const Polyline& outline) {
  std::vector<Place> corners;
  for (const PlotPoint& corner : outline)
    if (const Place p = frame.place(corner); is_known(p)) corners.push_back(p);
  for (const Side& side : sides_of(frame.box)) {  // Sutherland and Hodgman
    std::vector<Place> kept;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Place &a = corners[i], &b = corners[(i + 1) % corners.size()];
      const double u = side.value(a), v = side.value(b);
      if (u >= 0) kept.push_back(a);
      if ((u < 0) != (v < 0)) kept.push_back(between(a, b, u / (u - v)));
    }
    corners = std::move(kept);
  }
  return corners;
}

void add_axes(const Frame& frame, const Axes& axes, Picture& picture) {
  const Box& box = frame.box;
  const auto line = [&](Place a, Place b, const char* colour, double width) {
    picture.marks.emplace_back(Path{{a, b}, false, {colour, "", width, {}}, "", false});
  };
  const auto number = [&](Place at, const std::string& text, Anchor anchor) {
    picture.marks.emplace_back(
        Words{.at = at, .text = text, .anchor = anchor, .size = axes.text_size});
  };
  const PlotPoint inside{frame.low.first, frame.low.second};
  for (const std::string& tick : axes.x_ticks) {
    const double x = frame.place({std::stod(tick), inside.second}).x;
    if (axes.has_grid) line({x, box.top}, {x, box.bottom}, "#d9d9d9", 0.8);
    line({x, box.bottom}, {x, box.bottom + 5}, ink, 1.2);
    number({x, box.bottom + 8 + axes.text_size}, tick, Anchor::middle);
  }
  for (const std::string& tick : axes.y_ticks) {
    const double y = frame.place({inside.first, std::stod(tick)}).y;
    if (axes.has_grid) line({box.left, y}, {box.right, y}, "#d9d9d9", 0.8);
    line({box.left - 5, y}, {box.left, y}, ink, 1.2);
    number({box.left - 9, y + 0.35 * axes.text_size}, tick, Anchor::end);
  }
  const Place zero = frame.place({0, 0});
  if (axes.has_grid && frame.holds({zero.x, box.bottom}))
    line({zero.x, box.top}, {zero.x, box.bottom}, "#999999", 1.2);
  if (axes.has_grid && frame.holds({box.left, zero.y}))
    line({box.left, zero.y}, {box.right, zero.y}, "#999999", 1.2);
  line({box.left, box.top}, {box.left, box.bottom}, ink, 1.2);
  line({box.left, box.bottom}, {box.right, box.bottom}, ink, 1.2);
}

std::string text_of(const FigureText& text) {
  return shown_in_line(text.is_markup ? without_markup(text.text) : text.text);
}

Mark moved(Mark mark, Place by) {
  const auto move = [by](Place& place) { place.x += by.x, place.y += by.y; };
  if (auto* path = std::get_if<Path>(&mark))
    for (Place& place : path->places) move(place);
  else if (auto* disc = std::get_if<Disc>(&mark))
    move(disc->centre);
  else
    move(std::get<Words>(mark).at);
  return mark;
}

void add_key(const std::vector<Entry>& entries, const Box& room, double text_size,
             Picture& picture) {
  constexpr double sample = 40, gap = 8, between_entries = 26;
  struct Line {
    std::size_t first = 0, count = 0;
    double width = 0;
  };
  const auto width_of_entry = [&](const Entry& entry) {
    const Box box = box_of(Words{.text = entry.text, .size = text_size});
    return sample + gap + box.right - box.left;
  };
  std::vector<Line> lines;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const double width = width_of_entry(entries[i]);
    if (lines.empty() || lines.back().width + between_entries + width > room.right - room.left)
      lines.push_back({i, 0, -between_entries});
    lines.back().width += between_entries + width;
    ++lines.back().count;
  }
  const double pitch = 1.3 * text_size;
  double y = room.bottom - pitch * static_cast<double>(lines.size());
  for (const Line& line : lines) {
    y += pitch;
    double x = (room.left + room.right - line.width) / 2;
    for (std::size_t i = line.first; i < line.first + line.count; ++i) {
      for (const Mark& mark : entries[i].marks)
        picture.marks.push_back(moved(mark, {x + sample / 2, y - 0.35 * text_size}));
      picture.marks.emplace_back(
          Words{.at = {x + sample + gap, y}, .text = entries[i].text, .size = text_size});
      x += width_of_entry(entries[i]) + between_entries;
    }
  }
}

void add_bar(const Frame& frame, const ColourBar& bar, double text_size,
             std::string (*colour)(double), Picture& picture) {
  constexpr int steps = 64;
  constexpr double away = 25, wide = 20;
  const double left = frame.box.right + away, right = left + wide;
  const double tall = frame.box.bottom - frame.box.top;
  for (int i = 0; i < steps; ++i) {
    const double low = frame.box.bottom - tall * i / steps, high = low - tall / steps;
    const std::string tint = colour((i + 0.5) / steps);  // its own stroke: no gaps of rounding
    picture.marks.emplace_back(Path{
        {{left, low}, {right, low}, {right, high}, {left, high}}, true, {tint, tint, 0.5, {}}});
  }
  constexpr std::size_t most = 8;
  for (const std::string& tick : round_ticks({bar.low, bar.high}, false, most)) {
    const double y = frame.box.bottom - tall * (std::stod(tick) - bar.low) / (bar.high - bar.low);
    picture.marks.emplace_back(
        Words{.at = {right + 6, y + 0.35 * text_size}, .text = tick, .size = text_size});
  }
  picture.marks.emplace_back(Words{.at = {picture.width - 10, frame.box.top - 0.8 * text_size},
                                   .text = shown_in_line(bar.title),
                                   .anchor = Anchor::end,
                                   .size = text_size});
}

}  // namespace springfold::io::plain
