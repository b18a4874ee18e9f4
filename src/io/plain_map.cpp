// Figures of maps, and of relative sensitivities, without gnuplot.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "gnuplot_text.hpp"
#include "plain_figure.hpp"
#include "plain_frame.hpp"
#include "round_ticks.hpp"
#include "text.hpp"

namespace springfold::io::plain {
namespace {

using drawing::Anchor;
using drawing::Ink;
using drawing::Path;
using drawing::Picture;
using drawing::Place;
using drawing::Words;

/// Pixels of the words of axes: 96 stand for 72 points.
double words_of(const SheetLook& look) { return look.font_size * 19 / 14; }

/// What is left of a wanted length, or the usual one.
double room_of(double wanted, double taken, double usual, double least) {
  return wanted > 0 ? std::max(wanted - taken, least) : usual;
}

/// Viridis (van der Walt, Smith, Firing), as plots/map.gp has it.
std::string map_colour(double part) {
  constexpr std::array<std::array<int, 3>, 16> stops{{{0x44, 0x01, 0x54},
                                                      {0x48, 0x1a, 0x6c},
                                                      {0x47, 0x2f, 0x7d},
                                                      {0x41, 0x44, 0x87},
                                                      {0x39, 0x56, 0x8c},
                                                      {0x31, 0x68, 0x8e},
                                                      {0x2a, 0x78, 0x8e},
                                                      {0x23, 0x88, 0x8e},
                                                      {0x1f, 0x98, 0x8b},
                                                      {0x22, 0xa8, 0x84},
                                                      {0x35, 0xb7, 0x79},
                                                      {0x54, 0xc5, 0x68},
                                                      {0x7a, 0xd1, 0x51},
                                                      {0xa5, 0xdb, 0x36},
                                                      {0xd2, 0xe2, 0x1b},
                                                      {0xfd, 0xe7, 0x25}}};
  const double at = std::clamp(part, 0.0, 1.0) * (stops.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  const double t = at - static_cast<double>(i);
  std::array<char, 8> text{};
  const auto channel = [&](std::size_t k) {
    return static_cast<int>(std::lround(stops[i][k] + t * (stops[i + 1][k] - stops[i][k])));
  };
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", channel(0), channel(1), channel(2));
  return text.data();
}

/// Edges of the cells around ascending or descending nodes.
std::vector<double> edges_of(const std::vector<double>& nodes) {
  if (nodes.size() == 1) return {nodes[0] - 0.5, nodes[0] + 0.5};
  std::vector<double> edges{1.5 * nodes[0] - 0.5 * nodes[1]};
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) edges.push_back((nodes[i] + nodes[i + 1]) / 2);
  const std::size_t last = nodes.size() - 1;
  edges.push_back(1.5 * nodes[last] - 0.5 * nodes[last - 1]);
  return edges;
}

/// Cells of one colour beside each other are one patch.
void add_field(const GridField& field, double low, double high, const Frame& frame,
               Picture& picture) {
  const std::vector<double> xs = edges_of(field.xs), ys = edges_of(field.ys);
  const auto colour_at = [&](std::size_t i, std::size_t j) -> std::string {
    const double value = field.values[j * field.xs.size() + i];
    return std::isnan(value) ? std::string{} : map_colour((value - low) / (high - low));
  };
  for (std::size_t j = 0; j < field.ys.size(); ++j)
    for (std::size_t i = 0; i < field.xs.size();) {
      const std::string colour = colour_at(i, j);
      std::size_t end = i + 1;
      while (end < field.xs.size() && colour_at(end, j) == colour) ++end;
      const Polyline cell{
          {xs[i], ys[j]}, {xs[end], ys[j]}, {xs[end], ys[j + 1]}, {xs[i], ys[j + 1]}};
      i = end;
      // A thin stroke of its own colour: no gaps of rounding between patches.
      if (auto corners = clipped_outline(frame, cell); !colour.empty() && corners.size() > 2)
        picture.marks.emplace_back(Path{std::move(corners), true, {colour, colour, 0.5, {}}});
    }
}

/// Segments that follow each other are one line.
void add_segments(const std::vector<Segment>& segments, const Ink& look, const Frame& frame,
                  Picture& picture) {
  Polyline line;
  const auto finish = [&] {
    for (auto& part : clipped(frame, line))
      picture.marks.emplace_back(Path{std::move(part), false, look});
    line.clear();
  };
  for (const auto& [a, b] : segments) {
    if (line.empty() || line.back() != a) {
      finish();
      line.push_back(a);
    }
    line.push_back(b);
  }
  finish();
}

const Ink contour_ink{"#ffffff", "", 1.2, {}}, edge_ink{ink, "", 3, {}};
const Ink activation_ink{"#d55e00", "", 3, {12, 8}}, unstable_ink{"#cc79a7", "", 3, {3, 6}};

std::vector<Entry> map_key_of(const MapFigure& figure) {
  const auto any = [&](std::vector<Segment> MapPanel::*lines) {
    return std::any_of(figure.panels.begin(), figure.panels.end(),
                       [&](const MapPanel& panel) { return !(panel.*lines).empty(); });
  };
  const auto line = [](const Ink& look) { return Path{{{-20, 0}, {20, 0}}, false, look}; };
  std::vector<Entry> entries;
  if (any(&MapPanel::edge)) entries.push_back({{line(edge_ink)}, "edge of the workspace"});
  if (any(&MapPanel::activation)) entries.push_back({{line(activation_ink)}, "a spring switches"});
  if (any(&MapPanel::unstable)) entries.push_back({{line(unstable_ink)}, "stability is lost"});
  if (figure.has_gaps)
    entries.push_back(
        {{Path{{{-8, -8}, {8, -8}, {8, 8}, {-8, 8}}, true, {"", "#dddddd", 0, {}}}}, "no value"});
  if (figure.has_infinite) entries.push_back({{}, "infinite: colour at the end"});
  if (figure.clipped > 0)
    entries.push_back({{}, std::to_string(figure.clipped) + " values beyond the colours"});
  return entries;
}

void add_panel(const MapFigure& figure, const MapPanel& panel, const Frame& frame, bool is_first,
               Picture& picture) {
  const double text_size = words_of(figure.look);
  picture.marks.emplace_back(Path{{{frame.box.left, frame.box.top},
                                   {frame.box.right, frame.box.top},
                                   {frame.box.right, frame.box.bottom},
                                   {frame.box.left, frame.box.bottom}},
                                  true,
                                  {"", "#eeeeee", 0, {}}});
  add_field(panel.field, figure.low, figure.high, frame, picture);
  add_segments(panel.contours, contour_ink, frame, picture);
  add_segments(panel.activation, activation_ink, frame, picture);
  add_segments(panel.unstable, unstable_ink, frame, picture);
  add_segments(panel.edge, edge_ink, frame, picture);
  for (const LineNumber& number : panel.numbers) {
    const Place at = frame.place(number.at);
    Words words{.at = {at.x, at.y + 0.3 * text_size},
                .text = rounded(number.level, 4),
                .anchor = Anchor::middle,
                .size = 0.85 * text_size};
    const drawing::Box box = box_of(words);
    picture.marks.emplace_back(Path{{{box.left, box.top},
                                     {box.right, box.top},
                                     {box.right, box.bottom},
                                     {box.left, box.bottom}},
                                    true,
                                    {"", "#ffffff", 0, {}}});
    picture.marks.emplace_back(words);
  }
  constexpr std::size_t most = 6;
  add_axes(
      frame,
      {round_ticks({frame.low.first, frame.high.first}, false, most),
       round_ticks({frame.low.second, frame.high.second}, false, most), 0.9 * text_size, false},
      picture);
  const double middle = (frame.box.left + frame.box.right) / 2;
  const auto words = [&](Place at, const FigureText& text, Anchor anchor) {
    if (!text.text.empty())
      picture.marks.emplace_back(
          Words{.at = at, .text = text_of(text), .anchor = anchor, .size = text_size});
  };
  words({middle, frame.box.top - 10}, panel.title, Anchor::middle);
  words({middle, frame.box.bottom + 3.3 * text_size}, figure.x_title, Anchor::middle);
  if (is_first) words({12, frame.box.top - 10}, figure.y_title, Anchor::start);
}

}  // namespace

Picture picture_of(const MapFigure& figure) {
  const double text_size = words_of(figure.look), scale = text_size / 19;
  const double left = 110 * scale, gap = 85 * scale, right = 150 * scale, bottom = 85 * scale;
  const double top = 140 * scale;
  const auto count = static_cast<double>(figure.panels.size());
  const double beside = left + (count - 1) * gap + right;
  const double usual = 470, least = 60;  // a panel
  const double width = room_of(figure.look.width, beside, count * usual, count * least) / count;
  const double height = room_of(figure.look.height, top + bottom, usual, least);
  Picture picture{.width = beside + count * width,
                  .height = top + height + bottom,
                  .title = text_of(figure.title)};
  const GridField& field = figure.panels.front().field;
  const auto [x0, x1] = std::minmax(field.xs.front(), field.xs.back());
  const auto [y0, y1] = std::minmax(field.ys.front(), field.ys.back());
  Frame frame{{0, top, 0, top + height}, {x0, y0}, {x1, y1}};
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    frame.box.left = left + static_cast<double>(i) * (width + gap);
    frame.box.right = frame.box.left + width;
    add_panel(figure, figure.panels[i], frame, i == 0, picture);
  }
  add_bar(frame, {text_of(figure.value_title), figure.low, figure.high}, 0.9 * text_size,
          map_colour, picture);
  picture.marks.emplace_back(Words{.at = {picture.width / 2, 1.6 * text_size},
                                   .text = picture.title,
                                   .anchor = Anchor::middle,
                                   .size = 1.28 * text_size});
  add_key(map_key_of(figure), {12, 2.1 * text_size, picture.width - 12, top - 2.1 * text_size},
          0.9 * text_size, picture);
  return picture;
}

Picture picture_of(const TornadoFigure& figure) {
  const double text_size = words_of(figure.look), scale = text_size / 19;
  const double top = 80 * scale, letter = 11 * scale, bar = 0.34;
  const auto count = static_cast<double>(figure.bars.size());
  const double bottom = (95.0 + (figure.left_out.empty() ? 0 : 24)) * scale;
  const double width = room_of(figure.look.width, 0, 1000, 0);
  const double usual = 46 * scale, least = 12;  // a row
  const double row =
      room_of(figure.look.height, top + bottom, count * usual, count * least) / count;
  Picture picture{
      .width = width, .height = top + row * count + bottom, .title = text_of(figure.title)};
  double low = 0, high = 0;
  std::size_t longest = 0;
  for (const TornadoBar& b : figure.bars) {
    low = std::min(low, b.value), high = std::max(high, b.value);
    longest = std::max(longest, width_of(b.parameter));
  }
  const double room = high > low ? high - low : 1;
  const Frame frame{{40 * scale + letter * static_cast<double>(longest), top, 0.97 * width,
                     picture.height - bottom},
                    {low - (low < 0 ? 0.16 : 0.02) * room, 0},
                    {high + (high > 0 ? 0.16 : 0.02) * room, 1}};
  constexpr std::size_t most = 8;
  add_axes(frame, {round_ticks({frame.low.first, frame.high.first}, false, most), {}, text_size},
           picture);
  const auto words = [&](Place at, const std::string& text, Anchor anchor, double size) {
    picture.marks.emplace_back(Words{.at = at, .text = text, .anchor = anchor, .size = size});
  };
  const double zero = frame.place({0, 0}).x;
  for (std::size_t i = 0; i < figure.bars.size(); ++i) {
    const TornadoBar& b = figure.bars[i];
    const double y = top + row * (static_cast<double>(i) + 0.5), x = frame.place({b.value, 0}).x;
    picture.marks.emplace_back(
        Path{{{zero, y - bar * row}, {x, y - bar * row}, {x, y + bar * row}, {zero, y + bar * row}},
             true,
             {"", b.value < 0 ? "#d55e00" : "#0072b2", 0, {}}});
    words({frame.box.left - 12, y + 0.35 * text_size}, b.parameter, Anchor::end, text_size);
    words({x + (b.value < 0 ? -7 : 7), y + 0.35 * text_size}, rounded(b.value, 4),
          b.value < 0 ? Anchor::end : Anchor::start, 0.93 * text_size);
  }
  words({width / 2, 1.6 * text_size}, picture.title, Anchor::middle, 1.28 * text_size);
  words({(frame.box.left + frame.box.right) / 2, frame.box.bottom + 3.2 * text_size},
        text_of(figure.x_title), Anchor::middle, text_size);
  if (!figure.left_out.empty())
    words({width / 2, picture.height - 14}, figure.left_out, Anchor::middle, 0.93 * text_size);
  return picture;
}

}  // namespace springfold::io::plain
