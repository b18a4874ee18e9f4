#include "figure_script.hpp"

#include <gnuplot-iostream.h>

#include <cstdio>
#include <locale>
#include <stdexcept>
#include <system_error>
#include <tuple>

#include "gnuplot_text.hpp"
#include "jump_arrows.hpp"
#include "label_layout.hpp"
#include "overlaps.hpp"
#include "round_ticks.hpp"
#include "seen_parts.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

std::string assignment(const std::string& name, double value) {
  return name + " = " + shortest(value) + "\n";
}

std::string assignment(const std::string& name, std::string_view text) {
  return name + " = " + gnuplot_string(text) + "\n";
}

/// gnuplot-iostream ends data with a line "e": the same line ends a named data block.
constexpr const char* begin_block = " << e\n";

/// Adds a word to a list that gnuplot iterates over.
void add_word(std::string& list, const std::string& word) {
  list += (list.empty() ? "" : " ") + word;
}

std::string word_of(Stability stability) {
  switch (stability) {
    case Stability::stable:
      return "stable";
    case Stability::unknown:
      return "unknown";
    case Stability::driven:
      return "driven";
    case Stability::unstable:
      return "unstable";
  }
  return "";
}

bool is_any_in_view(const Figure& figure, const Canvas& canvas,
                    const std::vector<Polyline>& lines) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const Polyline& line) { return is_in_view(figure, canvas, line); });
}

void send_parts(Gnuplot& gnuplot, const Figure& figure, const Canvas& canvas,
                const DrawnLines& drawn) {
  std::string parts, first_parts;
  for (const auto stability :
       {Stability::stable, Stability::unknown, Stability::driven, Stability::unstable}) {
    bool is_first = true;
    for (std::size_t i = 0; i < drawn.curves.size(); ++i) {
      std::vector<Polyline> lines;
      for (const auto& part : drawn.curves[i])
        if (part.stability == stability) lines.push_back(part.line);
      if (lines.empty()) continue;
      const std::string name = word_of(stability) + "_" + std::to_string(i + 1);
      gnuplot << "$" << name << begin_block;
      gnuplot.send2d(lines);  // an empty line between polylines: gnuplot does not connect them
      add_word(parts, name);
      if (!is_first || !figure.tells_stability || !is_any_in_view(figure, canvas, lines)) continue;
      add_word(first_parts, name);
      is_first = false;
    }
  }
  if (parts.empty()) {  // a figure of single points: gnuplot cannot iterate over nothing
    gnuplot << "$nothing" << begin_block << "e\n";
    parts = "nothing";
  }
  gnuplot << assignment("curve_parts", parts) << assignment("first_parts", first_parts);
}

void send_curves(Gnuplot& gnuplot, const Figure& figure, const Canvas& canvas) {
  const DrawnLines drawn = without_overlaps(figure, canvas);
  send_parts(gnuplot, figure, canvas, drawn);
  gnuplot << assignment("has_mixed", drawn.mixed.empty() ? 0 : 1)
          << assignment("mixed_in_key", is_any_in_view(figure, canvas, drawn.mixed) ? 1 : 0);
  if (!drawn.mixed.empty()) {
    gnuplot << "$mixed" << begin_block;
    gnuplot.send2d(drawn.mixed);
  }
  std::string hues, colours;
  for (const auto& curve : figure.curves) {
    add_word(hues, std::to_string(curve.hue));
    add_word(colours, curve.colour.empty() ? "by_hue" : curve.colour);
  }
  gnuplot << assignment("curve_hues", hues) << assignment("curve_colors", colours);
}

void send_marks(Gnuplot& gnuplot, const Figure& figure, const Canvas& canvas) {
  std::string codes, codes_in_key;
  for (const std::string code :
       {"start", "LP", "CL", "SA", "BP", "KB", "KS", "TP", "FM", "UZ", "SC", "UR", "ES", "EU", "CP",
        "IC",    "CX", "HT", "BB", "C2", "FA", "CR", "TA", "AA", "SB", "PT", "EX", "TH", "JP"}) {
    std::vector<PlotPoint> points;
    for (const auto& mark : figure.marks)
      if (mark.code == code) points.push_back(mark.at);
    if (points.empty()) continue;
    gnuplot << "$point_" << code << begin_block;
    gnuplot.send1d(points);
    add_word(codes, code);
    if (std::any_of(points.begin(), points.end(),
                    [&](const PlotPoint& at) { return is_in_view(figure, canvas, at); }))
      add_word(codes_in_key, code);
  }
  if (codes.empty()) {
    gnuplot << "$point_nothing" << begin_block << "e\n";
    codes = "nothing";
  }
  gnuplot << assignment("point_codes", codes) << assignment("key_codes", codes_in_key);
}

/// A distance in the picture.
std::string on_screen(const PlotPoint& at, const Canvas& canvas) {
  return "screen " + rounded(at.first / canvas.width, 6) + ", screen " +
         rounded(at.second / canvas.height, 6);
}

/// Labels hang on points of the axes: they follow where a script is given other ranges.
void send_labels(Gnuplot& gnuplot, const Figure& figure, const Canvas& canvas, bool is_tex) {
  for (const auto& label : place_labels(figure, canvas)) {
    const PlotPoint anchor = from_pixels(figure, canvas, label.leader_from);
    const auto from_anchor = [&](const PlotPoint& to) {
      return on_screen({to.first - label.leader_from.first, to.second - label.leader_from.second},
                       canvas);
    };
    gnuplot << "anchor_x = " << shortest(anchor.first) << "; anchor_y = " << shortest(anchor.second)
            << "\n";
    if (label.has_leader)
      gnuplot << "set arrow from first anchor_x, first anchor_y rto "
              << from_anchor(label.leader_to) << " nohead linestyle 4 "
              << (figure.regions.empty() ? "back" : "front") << "\n";  // shades hide what is behind
    if (label.has_leader && label.is_curve_label)
      gnuplot << "set label '' at first anchor_x, first anchor_y point linestyle 9 front\n";
    const FigureText text = text_for(label.text, is_tex);
    gnuplot << "set label " << gnuplot_string(text.text)
            << " at first anchor_x, first anchor_y offset " << from_anchor(label.at) << " center "
            << gnuplot_mode(text) << " front font "
            << (label.is_curve_label ? "curve_label_font" : "point_label_font") << " textcolor rgb "
            << (label.is_curve_label ? "curve_label_color" : "point_label_color") << "\n";
  }
}

void send_jumps(Gnuplot& gnuplot, const Figure& figure) {
  for (const ShownArrow& arrow : arrows_inside(figure))
    gnuplot << "set arrow from first " << arrow.from.first << ", first " << arrow.from.second
            << " to first " << arrow.to.first << ", first " << arrow.to.second
            << (arrow.has_head ? " head filled size screen 0.012, 20" : " nohead")
            << " linecolor rgb ink linewidth 1.2 front\n";
}

std::string joined_words(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) add_word(list, word);
  return list;
}

void send_insets(Gnuplot& gnuplot, const Figure& figure, const Canvas& canvas) {
  std::string x_low, x_high, y_low, y_high, left, right, bottom, top, left_room, bottom_room;
  for (std::size_t i = 0; i < figure.look.insets.size(); ++i) {
    const PlotInset& inset = figure.look.insets[i];
    const InsetPlace place = place_of_inset(inset, figure.look, canvas);
    const auto& [low, high] = std::tie(place.low, place.high);
    add_word(x_low, decimal(inset.x.first)), add_word(x_high, decimal(inset.x.second));
    add_word(y_low, decimal(inset.y.first)), add_word(y_high, decimal(inset.y.second));
    add_word(left, rounded(low.first / canvas.width, 6));
    add_word(right, rounded(high.first / canvas.width, 6));
    add_word(bottom, rounded(low.second / canvas.height, 6));
    add_word(top, rounded(high.second / canvas.height, 6));
    add_word(left_room, rounded(place.left_room / (high.first - low.first), 6));
    add_word(bottom_room, rounded(place.bottom_room / (high.second - low.second), 6));
    const std::string number = std::to_string(i + 1);
    gnuplot << assignment("inset_x_ticks_" + number, joined_words(place.x_ticks))
            << assignment("inset_y_ticks_" + number, joined_words(place.y_ticks));
  }
  gnuplot << "insets = " << figure.look.insets.size() << "\n"
          << assignment("inset_x_low", x_low) << assignment("inset_x_high", x_high)
          << assignment("inset_y_low", y_low) << assignment("inset_y_high", y_high)
          << assignment("inset_left", left) << assignment("inset_right", right)
          << assignment("inset_bottom", bottom) << assignment("inset_top", top)
          << assignment("inset_left_room", left_room)
          << assignment("inset_bottom_room", bottom_room);
}

/// What the colours of several quantities mean.
void send_quantities(Gnuplot& gnuplot, const Figure& figure, bool is_tex) {
  const std::size_t count = figure.quantities.size();
  gnuplot << "quantities = " << count << "\narray quantity_name[" << std::max<std::size_t>(count, 1)
          << "]\n";
  for (std::size_t i = 0; i < count; ++i)
    gnuplot << assignment("quantity_name[" + std::to_string(i + 1) + "]",
                          text_for({figure.quantities[i]}, is_tex).text);
}

/// Shaded parts of the plane. The colours say whether they are what is wanted.
void send_regions(Gnuplot& gnuplot, const Figure& figure) {
  const std::size_t count = figure.regions.size();
  std::string wanted;
  for (std::size_t i = 0; i < count; ++i) {
    gnuplot << "$region_" << i + 1 << begin_block;
    gnuplot.send2d(figure.regions[i].parts);  // an empty line between outlines
    add_word(wanted, figure.regions[i].is_wanted ? "1" : "0");
  }
  gnuplot << "regions = " << count << "\n"
          << assignment("region_wanted", wanted) << "array region_name["
          << std::max<std::size_t>(count, 1) << "]\n";
}

void send_region_names(Gnuplot& gnuplot, const Figure& figure, bool is_tex) {
  for (std::size_t i = 0; i < figure.regions.size(); ++i)
    gnuplot << assignment("region_name[" + std::to_string(i + 1) + "]",
                          text_for({figure.regions[i].name}, is_tex).text);
}

/// What the colours of the runs of a sweep mean.
void send_bar(Gnuplot& gnuplot, const Figure& figure, bool is_tex) {
  gnuplot << "has_bar = " << (figure.bar ? 1 : 0) << "\n";
  if (!figure.bar) return;
  constexpr int stops = 16;
  std::string palette;
  for (int i = 0; i < stops; ++i)
    palette += (i == 0 ? "" : ", ") + std::to_string(i) + " \"" +
               sweep_colour(static_cast<double>(i) / (stops - 1)) + "\"";
  const auto& [title, low, high] = *figure.bar;
  gnuplot << assignment("palette_text", palette)
          << assignment("bar_title", text_for({title}, is_tex).text) << assignment("bar_low", low)
          << assignment("bar_high", high) << "$bar" << begin_block << shortest(figure.low.first)
          << " " << shortest(figure.low.second) << " " << shortest(low) << "\ne\n";
}

/// Ticks of a logarithmic axis that has hardly a power of ten; otherwise gnuplot's own are good.
std::string ticks_of(bool is_log, const PlotRange& range) {
  constexpr double few = 100;  // times the least value: two powers of ten may be missed
  constexpr std::size_t most = 6;
  return is_log && range.second < few * range.first ? joined_words(round_ticks(range, true, most))
                                                    : "";
}

void send_values(Gnuplot& gnuplot, const Figure& figure, const Canvas& canvas, bool is_tex) {
  gnuplot << assignment("figure_name", figure.name)
          << gnuplot_assignment("figure_title", text_for(figure.title, is_tex))
          << gnuplot_assignment("x_title", text_for(figure.x_title, is_tex))
          << gnuplot_assignment("y_title", text_for(figure.y_title, is_tex))
          << "of_points = " << (figure.is_of_points ? 1 : 0) << "\n"
          << assignment("x_low", figure.low.first) << assignment("x_high", figure.high.first)
          << assignment("y_low", figure.low.second) << assignment("y_high", figure.high.second)
          << "x_log = " << (figure.look.x_log ? 1 : 0)
          << "\ny_log = " << (figure.look.y_log ? 1 : 0) << "\n"
          << assignment("x_ticks",
                        ticks_of(figure.look.x_log, {figure.low.first, figure.high.first}))
          << assignment("y_ticks",
                        ticks_of(figure.look.y_log, {figure.low.second, figure.high.second}))
          << assignment("figure_width", canvas.width) << assignment("figure_height", canvas.height)
          << assignment("figure_font", figure.look.font)
          << assignment("figure_font_size", figure.look.font_size)
          << assignment("frame_left", canvas.left / canvas.width)
          << assignment("frame_right", canvas.right / canvas.width)
          << assignment("frame_bottom", canvas.bottom / canvas.height)
          << assignment("frame_top", canvas.top / canvas.height);
}

}  // namespace

void write_figure_script(const std::filesystem::path& path, const Figure& figure,
                         const std::string& style, const std::string& drawing) {
  std::FILE* file = std::fopen(path.c_str(), "we");
  if (file == nullptr)
    throw std::runtime_error{"cannot write " + path.string() + ": " +
                             std::generic_category().message(errno)};
  Gnuplot gnuplot{file};  // closes the file
  gnuplot.imbue(std::locale::classic());
  gnuplot << std::defaultfloat << std::setprecision(12);
  const Canvas canvas = canvas_of(figure.look, figure.bar.has_value());
  gnuplot << "# Written by springfold; `gnuplot " << figure.name << ".gp` draws it again.\n";
  send_curves(gnuplot, figure, canvas);
  send_marks(gnuplot, figure, canvas);
  send_insets(gnuplot, figure, canvas);
  send_regions(gnuplot, figure);
  for (const std::string& format : figure.look.formats) {
    const bool is_tex = format == "tikz";
    gnuplot << "\n" << assignment("figure_format", format);
    send_values(gnuplot, figure, canvas, is_tex);
    send_bar(gnuplot, figure, is_tex);
    send_quantities(gnuplot, figure, is_tex);
    send_region_names(gnuplot, figure, is_tex);
    gnuplot << "\n" << style << "\nunset label\nunset arrow\n";
    send_labels(gnuplot, figure, canvas, is_tex);
    send_jumps(gnuplot, figure);
    gnuplot << "\n" << drawing;
  }
  gnuplot.flush();
  if (!gnuplot.good()) throw std::runtime_error{"cannot write " + path.string()};
}

}  // namespace springfold::io
