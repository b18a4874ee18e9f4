// Figures drawn again from their scripts, which have all that they need.
#include <algorithm>
#include <exception>

#include "atomic_file.hpp"
#include "gnuplot_process.hpp"
#include "manifest.hpp"
#include "sha256.hpp"
#include "springfold/io/plots.hpp"
#include "undated.hpp"
#include "work_folder.hpp"

namespace springfold::io {
namespace {

namespace fs = std::filesystem;

/// Scripts that the manifest lists, with their hashes.
std::vector<ListedFile> scripts_of(const fs::path& folder) {
  std::vector<ListedFile> scripts = hashes_listed_in(folder);
  std::erase_if(scripts, [](const ListedFile& file) {
    return !file.path.starts_with("plots/") || !file.path.ends_with(".gp");
  });
  return scripts;
}

/// Pictures that a script has left in the work folder, in the order of their names.
std::vector<std::string> pictures_in(const fs::path& work) {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(work)) {
    const std::string ending = entry.path().extension().string();
    const bool is_picture =
        ending == ".png" || ending == ".svg" || ending == ".pdf" || ending == ".tex";
    if (is_picture && entry.is_regular_file() && entry.file_size() > 0)
      names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// @returns why there is no picture; empty when it is drawn
std::string redraw(const fs::path& folder, const std::string& script, const fs::path& gnuplot,
                   const PlotOptions& options, PlotOutcome& outcome) {
  const WorkFolder work{folder / "plots"};
  const auto failure = run_gnuplot({.executable = gnuplot,
                                    .folder = work.path(),
                                    .script = "../" + fs::path{script}.filename().string(),
                                    .timeout_seconds = options.timeout_seconds,
                                    .stop_requested = options.stop_requested});
  if (failure) return *failure;
  const std::vector<std::string> pictures = pictures_in(work.path());
  std::vector<ListedFile> list;
  for (const std::string& name : pictures) {
    finish_picture(work.path() / name);
    const std::string bytes = read_file(work.path() / name);
    list.push_back({"plots/" + name, sha256(bytes), bytes.size()});
  }
  list_in_manifest(folder, list);
  for (const std::string& name : pictures) {
    publish_file(work.path() / name, folder / "plots" / name);
    outcome.files.push_back(folder / "plots" / name);
  }
  return pictures.empty() ? "gnuplot drew nothing" : "";
}

}  // namespace

PlotOutcome redraw_plots(const fs::path& folder, bool with_changed, const PlotOptions& options) {
  PlotOutcome outcome;
  try {
    const std::vector<ListedFile> scripts = scripts_of(folder);
    const auto gnuplot = find_executable(options.gnuplot);
    if (scripts.empty())
      outcome.warnings.push_back("no script of a figure is listed in " +
                                 (folder / "manifest.json").string());
    else if (!gnuplot)
      outcome.warnings.push_back("there is no program '" + options.gnuplot + "'");
    for (const ListedFile& script : scripts) {
      if (!gnuplot || (options.stop_requested && options.stop_requested())) break;
      const bool is_ours = sha256(read_file(folder / script.path)) == script.hash;
      const std::string problem = !is_ours && !with_changed
                                      ? "is not as springfold wrote it, and a script may run other "
                                        "programs: look at it, then "
                                        "draw it with --changed"
                                      : redraw(folder, script.path, *gnuplot, options, outcome);
      if (!problem.empty()) outcome.warnings.push_back(script.path + ": " + problem);
    }
  } catch (const std::exception& error) {
    outcome.warnings.push_back(std::string{"no further figures: "} + error.what());
  }
  return outcome;
}

}  // namespace springfold::io
