// Figures of curves without gnuplot.
#include "plain_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "canvas.hpp"
#include "jump_arrows.hpp"
#include "label_layout.hpp"
#include "overlaps.hpp"
#include "plain_frame.hpp"
#include "point_names.hpp"
#include "round_ticks.hpp"
#include "seen_parts.hpp"

namespace springfold::io::plain {
namespace {

using drawing::Anchor;
using drawing::Box;
using drawing::Disc;
using drawing::Ink;
using drawing::Mark;
using drawing::Path;
using drawing::Picture;
using drawing::Place;
using drawing::Words;

// As plots/style.gp has them.
constexpr const char *stable_blue = "#0072b2", *unstable_red = "#d55e00", *mixed_pale = "#f5cba7";
constexpr std::array<const char*, 8> branch_hues{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                 "#e69f00", "#56b4e9", "#882255", "#999933"};
constexpr double line_width = 3.2;

const char* hue_of(std::size_t number) { return branch_hues[(number - 1) % branch_hues.size()]; }

Ink ink_of(Stability stability, const std::string& colour) {
  Ink line{colour, "", line_width, {}};
  if (stability == Stability::unknown) line.dashes = {22, 6, 5, 6};
  if (stability == Stability::driven) line.dashes = {22, 10};
  if (stability == Stability::unstable) line.dashes = {7, 8};
  return line;
}

std::string colour_of(const FigureCurve& curve, Stability stability) {
  if (!curve.colour.empty()) return curve.colour;
  if (curve.hue > 0) return hue_of(static_cast<std::size_t>(curve.hue));
  if (stability == Stability::unknown) return ink;
  return stability == Stability::stable ? stable_blue : unstable_red;
}

/// @param of_points  of critical points, which are unstable in one mode at any rate
const char* words_of(Stability stability, bool of_points) {
  switch (stability) {
    case Stability::stable:
      return of_points ? "no other mode unstable" : "stable";
    case Stability::unknown:
      return of_points ? "other modes not counted" : "stability not known";
    case Stability::driven:
      return of_points ? "another unstable under dead load" : "unstable under dead load";
    case Stability::unstable:
      return of_points ? "another mode unstable" : "unstable";
  }
  return "";
}

/// A regular polygon, its first corner at this angle from the right [turns].
Path polygon(int corners, double radius, double first, const Ink& look) {
  Path path{.is_closed = true, .ink = look};
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * (first + static_cast<double>(i) / corners);
    path.places.push_back({radius * std::cos(angle), -radius * std::sin(angle)});
  }
  return path;
}

std::vector<Mark> cross(double radius, double turn, const Ink& look) {
  std::vector<Mark> marks;
  for (const double angle : {turn, turn + 0.25}) {
    const double c = radius * std::cos(2 * std::numbers::pi * angle);
    const double s = radius * std::sin(2 * std::numbers::pi * angle);
    marks.emplace_back(Path{{{-c, -s}, {c, s}}, false, look});
  }
  return marks;
}

/// The shape of a code around the origin.
std::vector<Mark> shape_of(const std::string& code) {
  const Ink filled{"", ink, 0, {}}, open{ink, "#ffffff", 2.2, {}};
  constexpr double r = 8;
  if (code == "start") return {Disc{{}, r, {ink, "", 2.2, {}}, ""}};
  if (code == "LP") return {Disc{{}, 6.5, filled, ""}};
  if (code == "CL") return {polygon(3, 1.2 * r, 0.25, filled)};
  if (code == "KB") return {polygon(3, 1.2 * r, 0.75, filled)};
  if (code == "SC") return {polygon(3, 1.2 * r, 0.25, open)};
  if (code == "SA") return {polygon(4, r, 0.125, filled)};
  if (code == "FM") return {polygon(4, r, 0.125, open)};
  if (code == "TP") return {polygon(4, 1.1 * r, 0, open)};
  if (code == "UZ" || code == "KS") return cross(r, 0.125, {ink, "", 2.2, {}});
  if (code == "UR") return cross(1.3 * r, 0.125, {"#cc0000", "", 3.5, {}});
  if (code == "EX" || code == "JP") return cross(r, 0, {ink, "", 2.2, {}});
  if (code == "ES") return {Disc{{}, r, {"", stable_blue, 0, {}}, ""}};
  if (code == "EU") return {Disc{{}, r, {unstable_red, "#ffffff", 2.5, {}}, ""}};
  return {polygon(4, 1.1 * r, 0, filled)};  // branch points and degeneracies
}

/// Everything between the axes: also what an inset shows again.
void add_content(const Figure& figure, const DrawnLines& drawn, const Frame& frame,
                 Picture& picture) {
  for (const FigureRegion& region : figure.regions)
    for (const Polyline& outline : region.parts)
      if (auto corners = clipped_outline(frame, outline); corners.size() > 2)
        picture.marks.emplace_back(
            Path{std::move(corners), true, {"", region.is_wanted ? "#e1eef7" : "#f7e3d4", 0, {}}});
  const auto add = [&](const Polyline& line, const Ink& look) {
    for (auto& part : clipped(frame, line))
      picture.marks.emplace_back(Path{std::move(part), false, look});
  };
  for (const Polyline& line : drawn.mixed) add(line, {mixed_pale, "", 11, {}});
  for (const auto stability :
       {Stability::stable, Stability::unknown, Stability::driven, Stability::unstable})
    for (std::size_t i = 0; i < drawn.curves.size(); ++i)
      for (const CurvePart& part : drawn.curves[i])
        if (part.stability == stability)
          add(part.line, ink_of(stability, colour_of(figure.curves[i], stability)));
  for (const FigureMark& mark : figure.marks) {
    const Place at = frame.place(mark.at);
    if (!frame.holds(at)) continue;
    for (const Mark& shape : shape_of(mark.code)) picture.marks.push_back(moved(shape, at));
  }
}

void add_jumps(const Figure& figure, const Frame& frame, Picture& picture) {
  for (const ShownArrow& arrow : arrows_inside(figure)) {
    const Place a = frame.place(arrow.from), b = frame.place(arrow.to);
    const double long_ = std::hypot(b.x - a.x, b.y - a.y);
    const Ink head{grey, "", 1.8, {}};
    picture.marks.emplace_back(Path{{a, b}, false, {grey, "", 1.8, {3, 5}}});
    if (!arrow.has_head || !(long_ > 0)) continue;
    const Place u{12 * (b.x - a.x) / long_, 12 * (b.y - a.y) / long_};
    picture.marks.emplace_back(Path{{{b.x - u.x - 0.5 * u.y, b.y - u.y + 0.5 * u.x},
                                     b,
                                     {b.x - u.x + 0.5 * u.y, b.y - u.y - 0.5 * u.x}},
                                    false,
                                    head});
  }
}

void add_labels(const Figure& figure, const Canvas& canvas, Picture& picture) {
  const auto flipped = [&](const PlotPoint& p) { return Place{p.first, canvas.height - p.second}; };
  for (const PlacedLabel& label : place_labels(figure, canvas)) {
    if (label.has_leader)
      picture.marks.emplace_back(
          Path{{flipped(label.leader_from), flipped(label.leader_to)}, false, {grey, "", 1, {}}});
    if (label.has_leader && label.is_curve_label)
      picture.marks.emplace_back(Disc{flipped(label.leader_from), 2.4, {"", ink, 0, {}}, ""});
    const Place at = flipped(label.at);
    const double size = label.is_curve_label ? canvas.text_height : 0.93 * canvas.text_height;
    picture.marks.emplace_back(Words{.at = {at.x, at.y + 0.35 * size},
                                     .text = text_of(label.text),
                                     .anchor = Anchor::middle,
                                     .size = size});
  }
}

Path sample_line(const Ink& look) { return {{{-20, 0}, {20, 0}}, false, look}; }

Path sample_patch(const char* colour) {
  return {{{-20, -8}, {20, -8}, {20, 8}, {-20, 8}}, true, {"", colour, 0, {}}};
}

std::vector<Entry> key_of(const Figure& figure, const Canvas& canvas, const DrawnLines& drawn) {
  std::vector<Entry> entries;
  const auto add_once = [&](const std::string& text, const Mark& mark) {
    const bool is_new = std::none_of(entries.begin(), entries.end(),
                                     [&](const Entry& e) { return e.text == text; });
    if (is_new) entries.push_back({{mark}, text});
  };
  for (const FigureRegion& region : figure.regions)
    if (!region.name.empty())
      add_once(text_of({region.name}), sample_patch(region.is_wanted ? "#e1eef7" : "#f7e3d4"));
  if (std::any_of(drawn.mixed.begin(), drawn.mixed.end(),
                  [&](const Polyline& line) { return is_in_view(figure, canvas, line); }))
    add_once("with a less stable one on it", sample_line({mixed_pale, "", 11, {}}));
  for (const auto stability :
       {Stability::stable, Stability::unknown, Stability::driven, Stability::unstable})
    for (std::size_t i = 0; i < drawn.curves.size() && figure.tells_stability; ++i)
      for (const CurvePart& part : drawn.curves[i]) {
        if (part.stability != stability || !is_in_view(figure, canvas, part.line)) continue;
        const FigureCurve& curve = figure.curves[i];
        const bool tells_branch = curve.hue > 0 || !curve.colour.empty();
        const std::string colour = tells_branch ? ink : colour_of(curve, stability);
        add_once(words_of(stability, figure.is_of_points), sample_line(ink_of(stability, colour)));
      }
  for (std::size_t n = 0; n < figure.quantities.size(); ++n)
    add_once(text_of({figure.quantities[n]}), sample_line({hue_of(n + 1), "", line_width, {}}));
  for (const FigureMark& mark : figure.marks)
    if (is_in_view(figure, canvas, mark.at)) {
      const std::string name = point_name(mark.code);
      if (std::none_of(entries.begin(), entries.end(),
                       [&](const Entry& e) { return e.text == name; }))
        entries.push_back({shape_of(mark.code), name});
    }
  return entries;
}

void add_inset(const Figure& figure, const PlotInset& inset, const Canvas& canvas,
               const DrawnLines& drawn, Picture& picture) {
  const InsetPlace place = place_of_inset(inset, figure.look, canvas);
  const Frame frame{{place.low.first, canvas.height - place.high.second, place.high.first,
                     canvas.height - place.low.second},
                    {inset.x.first, inset.y.first},
                    {inset.x.second, inset.y.second},
                    figure.look.x_log,
                    figure.look.y_log};
  const double left = frame.box.left - place.left_room;
  const double bottom = frame.box.bottom + place.bottom_room;
  picture.marks.emplace_back(Path{{{left, frame.box.top},
                                   {frame.box.right, frame.box.top},
                                   {frame.box.right, bottom},
                                   {left, bottom}},
                                  true,
                                  {"", "#ffffff", 0, {}}});
  add_axes(frame, {place.x_ticks, place.y_ticks, 0.9 * canvas.text_height}, picture);
  add_content(figure, drawn, frame, picture);
  picture.marks.emplace_back(Path{{{frame.box.left, frame.box.top},
                                   {frame.box.right, frame.box.top},
                                   {frame.box.right, frame.box.bottom},
                                   {frame.box.left, frame.box.bottom}},
                                  true,
                                  {ink, "", 1.2, {}}});
}

}  // namespace

Picture picture_of(const Figure& figure) {
  const Canvas canvas = canvas_of(figure.look, figure.bar.has_value());
  const double size = canvas.text_height;
  Picture picture{.width = canvas.width, .height = canvas.height, .title = text_of(figure.title)};
  const Frame frame{
      {canvas.left, canvas.height - canvas.top, canvas.right, canvas.height - canvas.bottom},
      figure.low,
      figure.high,
      figure.look.x_log,
      figure.look.y_log};
  constexpr std::size_t most_ticks = 9;
  const Axes axes{
      round_ticks({figure.low.first, figure.high.first}, figure.look.x_log, most_ticks),
      round_ticks({figure.low.second, figure.high.second}, figure.look.y_log, most_ticks), size};
  add_axes(frame, axes, picture);
  const DrawnLines drawn = without_overlaps(figure, canvas);
  add_content(figure, drawn, frame, picture);
  add_jumps(figure, frame, picture);
  add_labels(figure, canvas, picture);
  for (const PlotInset& inset : figure.look.insets)
    add_inset(figure, inset, canvas, drawn, picture);
  if (figure.bar) add_bar(frame, *figure.bar, 0.9 * size, sweep_colour, picture);
  const double middle = (frame.box.left + frame.box.right) / 2;
  const auto words = [&](Place at, const std::string& text, Anchor anchor, double height) {
    if (!text.empty())
      picture.marks.emplace_back(Words{.at = at, .text = text, .anchor = anchor, .size = height});
  };
  words({middle, 1.6 * size}, picture.title, Anchor::middle, 1.28 * size);
  words({middle, canvas.height - 0.9 * size}, text_of(figure.x_title), Anchor::middle, size);
  words({12, frame.box.top - 0.9 * size}, text_of(figure.y_title), Anchor::start, size);
  add_key(key_of(figure, canvas, drawn),
          {12, 1.9 * size, canvas.width - 12, frame.box.top - 2.2 * size}, 0.9 * size, picture);
  return picture;
}

}  // namespace springfold::io::plain
