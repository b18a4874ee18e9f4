#include "springfold/io/plots.hpp"

#include <gnuplot-iostream.h>

#include <cstdio>
#include <locale>
#include <stdexcept>
#include <system_error>

#include "atomic_file.hpp"
#include "case_pictures.hpp"
#include "figure.hpp"
#include "gnuplot_process.hpp"
#include "gnuplot_text.hpp"
#include "graph_pictures.hpp"
#include "jump_arrows.hpp"
#include "label_layout.hpp"
#include "manifest.hpp"
#include "map_figure.hpp"
#include "overlaps.hpp"
#include "sha256.hpp"
#include "text.hpp"
#include "tornado_figure.hpp"
#include "work_folder.hpp"

namespace springfold::io {

namespace {

namespace fs = std::filesystem;

struct Templates {
  std::string style{};
  std::string figure{};
  std::string map{};
  std::string tornado{};
};

fs::path template_folder(const fs::path& wanted) {
  if (!wanted.empty()) return wanted;
  // A program that was installed and then moved finds its templates beside itself.
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path beside = program.parent_path().parent_path() / "share/springfold/plots";
  for (const fs::path& folder :
       {beside, fs::path{SPRINGFOLD_INSTALLED_PLOTS}, fs::path{SPRINGFOLD_SOURCE_PLOTS}})
    if (fs::is_regular_file(folder / "style.gp", error)) return folder;
  throw std::runtime_error{"no folder with plot templates: looked for style.gp in " +
                           beside.string() +
                           ", " SPRINGFOLD_INSTALLED_PLOTS " and " SPRINGFOLD_SOURCE_PLOTS};
}

Templates read_templates(const fs::path& wanted, bool with_maps, bool with_tornados) {
  const fs::path folder = template_folder(wanted);
  return {read_file(folder / "style.gp"), read_file(folder / "force-deflection.gp"),
          with_maps ? read_file(folder / "map.gp") : std::string{},
          with_tornados ? read_file(folder / "tornado.gp") : std::string{}};
}

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
    case Stability::driven:
      return "driven";
    case Stability::unstable:
      return "unstable";
  }
  return "";
}

/// @param has_key  the key tells the kinds of lines
void send_parts(Gnuplot& gnuplot, const DrawnLines& drawn, bool has_key) {
  std::string parts, first_parts;
  for (const auto stability : {Stability::stable, Stability::driven, Stability::unstable}) {
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
      if (is_first && has_key) add_word(first_parts, name);
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
  send_parts(gnuplot, drawn, figure.tells_stability);
  gnuplot << assignment("has_mixed", drawn.mixed.empty() ? 0 : 1);
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

void send_marks(Gnuplot& gnuplot, const Figure& figure) {
  std::string codes;
  for (const std::string code :
       {"start", "LP", "CL", "SA", "BP", "KB", "KS", "TP", "FM", "UZ", "SC", "UR", "ES", "EU",
        "CP",    "IC", "CX", "HT", "BB", "C2", "FA", "CR", "TA", "AA", "PT", "EX", "TH", "JP"}) {
    std::vector<PlotPoint> points;
    for (const auto& mark : figure.marks)
      if (mark.code == code) points.push_back(mark.at);
    if (points.empty()) continue;
    gnuplot << "$point_" << code << begin_block;
    gnuplot.send1d(points);
    add_word(codes, code);
  }
  if (codes.empty()) {
    gnuplot << "$point_nothing" << begin_block << "e\n";
    codes = "nothing";
  }
  gnuplot << assignment("point_codes", codes);
}

/// A distance in the picture.
std::string on_screen(const PlotPoint& at, const Canvas& canvas) {
  return "screen " + rounded(at.first / canvas.width, 6) + ", screen " +
         rounded(at.second / canvas.height, 6);
}

/// Text for LaTeX has no markup of gnuplot, and its own signs are escaped.
FigureText text_for(const FigureText& text, bool is_tex) {
  if (!is_tex) return text;
  return {tex_text(text.is_markup ? without_markup(text.text) : text.text)};
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
              << from_anchor(label.leader_to) << " nohead linestyle 4 back\n";
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

void send_insets(Gnuplot& gnuplot, const Figure& figure, const Canvas& canvas) {
  std::string x_low, x_high, y_low, y_high, left, right, bottom, top;
  for (const PlotInset& inset : figure.look.insets) {
    const auto [low, high] = frame_of(inset, canvas);
    add_word(x_low, shortest(inset.x.first)), add_word(x_high, shortest(inset.x.second));
    add_word(y_low, shortest(inset.y.first)), add_word(y_high, shortest(inset.y.second));
    add_word(left, rounded(low.first / canvas.width, 6));
    add_word(right, rounded(high.first / canvas.width, 6));
    add_word(bottom, rounded(low.second / canvas.height, 6));
    add_word(top, rounded(high.second / canvas.height, 6));
  }
  gnuplot << "insets = " << figure.look.insets.size() << "\n"
          << assignment("inset_x_low", x_low) << assignment("inset_x_high", x_high)
          << assignment("inset_y_low", y_low) << assignment("inset_y_high", y_high)
          << assignment("inset_left", left) << assignment("inset_right", right)
          << assignment("inset_bottom", bottom) << assignment("inset_top", top);
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

void send_values(Gnuplot& gnuplot, const Figure& figure, const Canvas& canvas, bool is_tex) {
  gnuplot << assignment("figure_name", figure.name)
          << gnuplot_assignment("figure_title", text_for(figure.title, is_tex))
          << gnuplot_assignment("x_title", text_for(figure.x_title, is_tex))
          << gnuplot_assignment("y_title", text_for(figure.y_title, is_tex))
          << assignment("x_low", figure.low.first) << assignment("x_high", figure.high.first)
          << assignment("y_low", figure.low.second) << assignment("y_high", figure.high.second)
          << "x_log = " << (figure.look.x_log ? 1 : 0)
          << "\ny_log = " << (figure.look.y_log ? 1 : 0) << "\n"
          << assignment("figure_width", canvas.width) << assignment("figure_height", canvas.height)
          << assignment("figure_font", figure.look.font)
          << assignment("figure_font_size", figure.look.font_size)
          << assignment("frame_left", canvas.left / canvas.width)
          << assignment("frame_right", canvas.right / canvas.width)
          << assignment("frame_bottom", canvas.bottom / canvas.height)
          << assignment("frame_top", canvas.top / canvas.height);
}

/// A script that draws the figure alone, without any other file.
void write_script(const fs::path& path, const Figure& figure, const Templates& templates) {
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
  send_marks(gnuplot, figure);
  send_insets(gnuplot, figure, canvas);
  for (const std::string& format : figure.look.formats) {
    const bool is_tex = format == "tikz";
    gnuplot << "\n" << assignment("figure_format", format);
    send_values(gnuplot, figure, canvas, is_tex);
    send_bar(gnuplot, figure, is_tex);
    gnuplot << "\n" << templates.style << "\nunset label\nunset arrow\n";
    send_labels(gnuplot, figure, canvas, is_tex);
    send_jumps(gnuplot, figure);
    gnuplot << "\n" << templates.figure;
  }
  gnuplot.flush();
  if (!gnuplot.good()) throw std::runtime_error{"cannot write " + path.string()};
}

/// Endings of the pictures, with their dots.
std::vector<std::string> endings_of(const std::vector<std::string>& formats) {
  std::vector<std::string> endings;
  for (const std::string& format : formats)
    endings.push_back(format == "tikz" ? ".tex" : "." + format);
  return endings;
}

ListedFile listed(const fs::path& file) {
  const std::string bytes = read_file(file);
  return {"plots/" + file.filename().string(), sha256(bytes), bytes.size()};
}

/// Draws one figure; the reason if there is no picture. @param write  puts its script into a file
std::optional<std::string> draw(const fs::path& folder, const std::string& name,
                                const std::vector<std::string>& endings,
                                const std::function<void(const fs::path&)>& write,
                                const std::optional<fs::path>& gnuplot, const PlotOptions& options,
                                PlotOutcome& outcome) {
  const WorkFolder work{folder / "plots"};
  const std::string script = name + ".gp";
  write(work.path() / script);
  list_in_manifest(folder, {listed(work.path() / script)});
  publish_file(work.path() / script, folder / "plots" / script);
  const std::string kept = " (script kept: " + (folder / "plots" / script).string() + ")";
  if (!gnuplot) return "there is no program '" + options.gnuplot + "'" + kept;

  const auto failure = run_gnuplot({.executable = *gnuplot,
                                    .folder = work.path(),
                                    .script = "../" + script,
                                    .timeout_seconds = options.timeout_seconds,
                                    .stop_requested = options.stop_requested});
  if (failure) return *failure + kept;
  std::vector<ListedFile> pictures;
  for (const std::string& ending : endings) {
    const fs::path picture = work.path() / (name + ending);
    std::error_code error;
    if (!fs::is_regular_file(picture, error) || fs::file_size(picture, error) == 0)
      return "gnuplot wrote no " + picture.filename().string() + kept;
    pictures.push_back(listed(picture));
  }
  // Listed before they are there: what the manifest does not list is never removed later.
  list_in_manifest(folder, pictures);
  for (const std::string& ending : endings) {
    const std::string picture = name + ending;
    publish_file(work.path() / picture, folder / "plots" / picture);
    outcome.files.push_back(folder / "plots" / picture);
    std::erase(outcome.missing, "plots/" + picture);
  }
  return std::nullopt;
}

void expect_pictures(const std::string& name, const std::vector<std::string>& formats,
                     PlotOutcome& outcome) {
  for (const std::string& ending : endings_of(formats))
    outcome.missing.push_back("plots/" + name + ending);
}

/// All pictures share a folder. Names that the case gives stay as they are, those of figures that it does
/// not ask for make way.
template <class Figures, class Maps, class Tornados>
void make_names_differ(const Case& the_case, Figures& figures, Maps& maps, Tornados& tornados) {
  UniqueNames names;
  for (const PictureSpec& picture : the_case.pictures) names.make(safe_file_name(picture.name));
  const auto set_apart = [&names](auto& list) {
    for (auto& figure : list) figure.name = names.make(figure.name);
  };
  set_apart(tornados);
  if (!the_case.map_plots.empty()) set_apart(maps);
  set_apart(figures);
  if (the_case.map_plots.empty()) set_apart(maps);
}

}  // namespace

PlotOutcome draw_plots(const fs::path& folder, const Case& the_case,
                       const std::vector<analysis::StudyResult>& results,
                       const PlotOptions& options) {
  PlotOutcome outcome;
  try {
    draw_case_pictures(folder, the_case, results, options, outcome);
    auto figures = figures_of(the_case, results, outcome.warnings);
    draw_graphs(folder, results, options, outcome);
    auto maps = map_figures_of(the_case, results, outcome.warnings);
    auto tornados = tornado_figures_of(the_case, results, outcome.warnings);
    make_names_differ(the_case, figures, maps, tornados);
    if (figures.empty() && maps.empty() && tornados.empty()) return outcome;
    for (const auto& figure : figures) expect_pictures(figure.name, figure.look.formats, outcome);
    for (const auto& figure : maps) expect_pictures(figure.name, figure.formats, outcome);
    for (const auto& figure : tornados) expect_pictures(figure.name, figure.formats, outcome);
    if (options.stop_requested && options.stop_requested()) return outcome;
    const Templates templates = read_templates(options.templates, !maps.empty(), !tornados.empty());
    const auto gnuplot = find_executable(options.gnuplot);
    make_folder(folder / "plots");
    const auto draw_one = [&](const std::string& name, const std::vector<std::string>& formats,
                              const auto& write) {
      if (options.stop_requested && options.stop_requested()) return;
      const auto failure =
          draw(folder, name, endings_of(formats), write, gnuplot, options, outcome);
      if (failure) outcome.warnings.push_back("figure '" + name + "': " + *failure);
    };
    for (const auto& figure : figures)
      draw_one(figure.name, figure.look.formats,
               [&](const fs::path& file) { write_script(file, figure, templates); });
    for (const auto& figure : maps)
      draw_one(figure.name, figure.formats, [&](const fs::path& file) {
        write_file(file, map_script(figure, templates.style, templates.map));
      });
    for (const auto& figure : tornados)
      draw_one(figure.name, figure.formats, [&](const fs::path& file) {
        write_file(file, tornado_script(figure, templates.style, templates.tornado));
      });
  } catch (const std::exception& error) {
    outcome.warnings.push_back(std::string{"no further figures: "} + error.what());
  }
  return outcome;
}

}  // namespace springfold::io
