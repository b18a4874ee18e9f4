#include "case_pictures.hpp"

#include <algorithm>
#include <system_error>

#include "atomic_file.hpp"
#include "gnuplot_process.hpp"
#include "manifest.hpp"
#include "result_access.hpp"
#include "sha256.hpp"
#include "springfold/io/postures.hpp"
#include "springfold/io/shown_text.hpp"
#include "text.hpp"
#include "undated.hpp"
#include "work_folder.hpp"

namespace springfold::io {
namespace {

namespace fs = std::filesystem;
using analysis::StudyResult;

const PlannedRun* planned_run(const Case& the_case, const std::string& study, int run) {
  const auto found = std::find_if(
      the_case.runs.begin(), the_case.runs.end(),
      [&](const PlannedRun& planned) { return planned.study == study && planned.run == run; });
  return found == the_case.runs.end() ? nullptr : &*found;
}

/// What stands above a panel: beside others only what tells it from them.
std::string panel_title(const PictureSpec& spec, const PlannedRun& planned,
                        const std::string& label) {
  const bool is_alone =
      spec.postures.size() == 1 && spec.runs.size() == 1 && spec.postures.front().label != "all";
  if (is_alone) return posture_title(planned, label);
  const bool has_other_study =
      std::any_of(spec.postures.begin(), spec.postures.end(),
                  [&](const PostureSpec& other) { return other.study != planned.study; });
  const std::string run = spec.runs.size() == 1   ? ""
                          : planned.label.empty() ? "run " + std::to_string(planned.run)
                                                  : planned.label;
  std::string title = has_other_study ? planned.study : "";
  if (!run.empty()) title += (title.empty() ? "" : ", ") + run;
  return shown_in_line(title + (title.empty() ? "" : ": ") + label);
}

/// The postures of one label.
void add_panels(const PictureSpec& spec, const PostureSpec& posture, const PlannedRun& planned,
                const StudyResult& result, const UnitLabels& units,
                std::vector<drawing::Panel>& panels, std::vector<std::string>& problems) {
  const RowScenes scenes{planned, result};
  const std::size_t before = panels.size();
  const bool is_all = posture.label == "all";
  for (const FoundRow& row :
       is_all ? special_postures(result) : std::vector{row_at(result, posture.label)}) {
    if (row.row == nullptr) continue;
    if (auto panel = scenes.panel_of(*row.row, panel_title(spec, planned, row.title), units))
      panels.push_back(std::move(*panel));
  }
  if (panels.size() == before)
    problems.push_back("picture '" + spec.name +
                       "': " + why_no_posture(planned, result, is_all ? "" : posture.label));
}

/// The picture's files in the work folder, in the formats that could be made.
/// @param failure  why some are missing
std::vector<std::string> draw_files(const PictureSpec& spec, const std::string& name,
                                    const drawing::Picture& picture, const fs::path& work,
                                    const PlotOptions& options, std::string& failure) {
  const std::string svg = name + ".svg";
  write_file(work / svg, drawing::svg_text(picture));
  std::vector<std::string> files;
  const auto converter = find_executable("rsvg-convert");
  const auto fail = [&failure](const std::string& format, const std::string& why) {
    failure += (failure.empty() ? "" : "; ") + ("no " + format + " file: ") + why;
  };
  for (const std::string& format : spec.formats) {
    const std::string file = name + "." + format;
    if (format == "svg") {
      files.push_back(svg);
      continue;
    }
    if (!converter) {
      fail(format, "it needs the program rsvg-convert (Debian: librsvg2-bin)");
      continue;
    }
    // The names are ours: none can be taken for an option.
    const auto problem = run_gnuplot(
        {.executable = *converter,
         .folder = work,
         .timeout_seconds = options.timeout_seconds,
         .stop_requested = options.stop_requested,
         .words = {"rsvg-convert", "--format", format, "--output", "./" + file, "./" + svg}});
    std::error_code error;
    if (problem)
      fail(format, *problem);
    else if (fs::file_size(work / file, error) == 0 || error)
      fail(format, "rsvg-convert wrote nothing");
    else {
      finish_picture(work / file);
      files.push_back(file);
    }
  }
  return files;
}

void draw_picture(const fs::path& folder, const PictureSpec& spec, const std::string& name,
                  const drawing::Picture& picture, const PlotOptions& options,
                  PlotOutcome& outcome) {
  make_folder(folder / "plots");
  const WorkFolder work{folder / "plots"};
  std::string failure;
  const auto files = draw_files(spec, name, picture, work.path(), options, failure);
  if (!failure.empty()) outcome.warnings.push_back("picture '" + spec.name + "': " + failure);
  std::vector<ListedFile> list;
  for (const std::string& file : files) {
    const std::string bytes = read_file(work.path() / file);
    list.push_back({"plots/" + file, sha256(bytes), bytes.size()});
  }
  // Listed before they are there: what the manifest does not list is never removed later.
  list_in_manifest(folder, list);
  for (const std::string& file : files) {
    publish_file(work.path() / file, folder / "plots" / file);
    outcome.files.push_back(folder / "plots" / file);
    std::erase(outcome.missing, "plots/" + file);
  }
}

}  // namespace

std::vector<drawing::Panel> panels_of(const PictureSpec& spec, const Case& the_case,
                                      const std::vector<StudyResult>& results,
                                      std::vector<std::string>& problems) {
  std::vector<drawing::Panel> panels;
  for (const int run : spec.runs)
    for (const PostureSpec& posture : spec.postures) {
      const PlannedRun* planned = planned_run(the_case, posture.study, run);
      if (planned == nullptr) continue;
      const StudyResult* result = result_of(results, posture.study, run);
      if (posture.label == "guess")
        panels.push_back(guess_panel(*planned, panel_title(spec, *planned, posture.label)));
      else if (result != nullptr)
        add_panels(spec, posture, *planned, *result, the_case.units, panels, problems);
    }
  return panels;
}

void draw_case_pictures(const fs::path& folder, const Case& the_case,
                        const std::vector<StudyResult>& results, const PlotOptions& options,
                        PlotOutcome& outcome) {
  UniqueNames names;
  std::vector<std::string> files;
  for (const PictureSpec& spec : the_case.pictures) {
    files.push_back(names.make(safe_file_name(spec.name)));
    for (const std::string& format : spec.formats)
      outcome.missing.push_back("plots/" + files.back() + "." + format);
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    const PictureSpec& spec = the_case.pictures[i];
    if (options.stop_requested && options.stop_requested()) return;
    const auto panels = panels_of(spec, the_case, results, outcome.warnings);
    if (panels.empty()) continue;
    auto look = illustration_options(the_case, spec.view, spec.colour);
    if (!spec.title.empty()) look.title = shown_in_line(spec.title);
    draw_picture(folder, spec, files[i], illustrate(panels, look), options, outcome);
  }
}

}  // namespace springfold::io
