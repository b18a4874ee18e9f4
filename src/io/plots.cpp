#include "springfold/io/plots.hpp"

#include <stdexcept>
#include <system_error>

#include "atomic_file.hpp"
#include "case_pictures.hpp"
#include "figure_script.hpp"
#include "gnuplot_process.hpp"
#include "graph_pictures.hpp"
#include "manifest.hpp"
#include "map_figure.hpp"
#include "plain_figure.hpp"
#include "sha256.hpp"
#include "text.hpp"
#include "tornado_figure.hpp"
#include "undated.hpp"
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

/// Finished pictures of the work folder become files of the results.
void publish(const fs::path& folder, const fs::path& work, const std::vector<std::string>& files,
             PlotOutcome& outcome) {
  std::vector<ListedFile> pictures;
  for (const std::string& file : files) pictures.push_back(listed(work / file));
  // Listed before they are there: what the manifest does not list is never removed later.
  list_in_manifest(folder, pictures);
  for (const std::string& file : files) {
    publish_file(work / file, folder / "plots" / file);
    outcome.files.push_back(folder / "plots" / file);
    std::erase(outcome.missing, "plots/" + file);
  }
}

/// One figure as it is drawn, with gnuplot or without.
struct Drawing {
  std::string name{};
  std::vector<std::string> endings{};
  std::function<void(const fs::path&)> write{};         ///< puts its script into a file
  std::function<drawing::Picture()> without_gnuplot{};  ///< more plainly
};

/// The SVG file alone; what is missing otherwise, in words.
std::string draw_plainly(const fs::path& folder, const fs::path& work, const Drawing& figure,
                         PlotOutcome& outcome) {
  std::string others;
  for (const std::string& ending : figure.endings) {
    if (ending != ".svg") {
      others += (others.empty() ? "" : ", ") + ending.substr(1);
      continue;
    }
    write_file(work / (figure.name + ending), drawing::svg_text(figure.without_gnuplot()));
    publish(folder, work, {figure.name + ending}, outcome);
  }
  return others.empty() ? "its SVG file is drawn more plainly" : "no " + others + " file";
}

/// Draws one figure; the reason if there is no picture.
std::optional<std::string> draw(const fs::path& folder, const Drawing& figure,
                                const std::optional<fs::path>& gnuplot, const PlotOptions& options,
                                PlotOutcome& outcome) {
  const WorkFolder work{folder / "plots"};
  const std::string script = figure.name + ".gp";
  figure.write(work.path() / script);
  list_in_manifest(folder, {listed(work.path() / script)});
  publish_file(work.path() / script, folder / "plots" / script);
  const std::string kept = " (script kept: " + (folder / "plots" / script).string() + ")";
  if (!gnuplot)
    return "there is no program '" + options.gnuplot +
           "': " + draw_plainly(folder, work.path(), figure, outcome) + kept;

  const auto failure = run_gnuplot({.executable = *gnuplot,
                                    .folder = work.path(),
                                    .script = "../" + script,
                                    .timeout_seconds = options.timeout_seconds,
                                    .stop_requested = options.stop_requested});
  if (failure) return *failure + kept;
  std::vector<std::string> files;
  for (const std::string& ending : figure.endings) {
    files.push_back(figure.name + ending);
    std::error_code error;
    const fs::path picture = work.path() / files.back();
    if (!fs::is_regular_file(picture, error) || fs::file_size(picture, error) == 0)
      return "gnuplot wrote no " + picture.filename().string() + kept;
    finish_picture(picture);
  }
  publish(folder, work.path(), files, outcome);
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
    for (const auto& figure : maps) expect_pictures(figure.name, figure.look.formats, outcome);
    for (const auto& figure : tornados) expect_pictures(figure.name, figure.look.formats, outcome);
    if (options.stop_requested && options.stop_requested()) return outcome;
    const Templates templates = read_templates(options.templates, !maps.empty(), !tornados.empty());
    const auto gnuplot = find_executable(options.gnuplot);
    make_folder(folder / "plots");
    const auto draw_one = [&](const auto& figure, const std::vector<std::string>& formats,
                              const auto& write) {
      if (options.stop_requested && options.stop_requested()) return;
      const auto failure = draw(folder,
                                {figure.name, endings_of(formats), write,
                                 [&figure] { return plain::picture_of(figure); }},
                                gnuplot, options, outcome);
      if (failure) outcome.warnings.push_back("figure '" + figure.name + "': " + *failure);
    };
    for (const auto& figure : figures)
      draw_one(figure, figure.look.formats, [&](const fs::path& file) {
        write_figure_script(file, figure, templates.style, templates.figure);
      });
    for (const auto& figure : maps)
      draw_one(figure, figure.look.formats, [&](const fs::path& file) {
        write_file(file, map_script(figure, templates.style, templates.map));
      });
    for (const auto& figure : tornados)
      draw_one(figure, figure.look.formats, [&](const fs::path& file) {
        write_file(file, tornado_script(figure, templates.style, templates.tornado));
      });
  } catch (const std::exception& error) {
    outcome.warnings.push_back(std::string{"no further figures: "} + error.what());
  }
  return outcome;
}

}  // namespace springfold::io
