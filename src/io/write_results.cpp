// One folder of results: every file complete or not there, none left over from an earlier run.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "atomic_file.hpp"
#include "cycle_access.hpp"
#include "json_text.hpp"
#include "jump_access.hpp"
#include "manifest.hpp"
#include "result_tables.hpp"
#include "sha256.hpp"
#include "springfold/analysis/snap.hpp"
#include "springfold/io/report.hpp"
#include "springfold/io/results.hpp"
#include "sweep_points.hpp"
#include "sweep_tables.hpp"
#include "text.hpp"
#include "transition_access.hpp"

namespace springfold::io {

namespace {

namespace fs = std::filesystem;
using analysis::StudyResult;

/// A file before it is written.
struct PlannedFile {
  std::string path{};
  std::string bytes{};
  bool is_reproducible = true;
};

std::string timings_json(const std::vector<StudyResult>& results) {
  nlohmann::ordered_json json = {{"schema_version", 1}};
  double total = 0;
  json["runs"] = nlohmann::ordered_json::array();
  for (const auto& result : results) {
    json["runs"].push_back(
        {{"study", result.study}, {"run", result.run}, {"cpu_seconds", result.seconds}});
    total += result.seconds;
  }
  json["cpu_seconds"] = total;
  return json_text(json);
}

bool has_transitions(const StudyResult& result) { return result.snap && result.snap->transitions; }

std::vector<PlannedFile> planned_files(const Case& the_case,
                                       const std::vector<StudyResult>& results, bool with_report) {
  std::vector<PlannedFile> files;
  const auto names = branch_files(results);
  for (std::size_t i = 0; i < results.size(); ++i)
    for (std::size_t b = 0; b < results[i].branches.size(); ++b)
      files.push_back({names[i][b], branch_csv(results[i], results[i].branches[b])});
  const auto equilibria = equilibria_files(results);
  for (std::size_t i = 0; i < results.size(); ++i)
    if (results[i].equilibria) files.push_back({equilibria[i], equilibria_csv(results[i])});
  const auto sweeps = sweep_files(the_case);
  for (std::size_t i = 0; i < sweeps.size(); ++i)
    files.push_back({sweeps[i], sweep_csv(the_case, the_case.sweeps[i], results)});
  const auto points = sweep_points_of(the_case, results);
  const auto tables = sweep_points_files(the_case, points);
  for (std::size_t i = 0; i < tables.size(); ++i)
    files.push_back({tables[i], sweep_points_csv(points[i])});
  files.push_back({"events.csv", events_csv(the_case, results)});
  if (std::any_of(results.begin(), results.end(), [](const auto& r) { return r.snap != nullptr; }))
    files.push_back({"jumps.csv", jumps_csv(results)});
  for (const auto& [path, bytes] : {std::pair{"motions.csv", motions_csv(results)},
                                    {"cycles.csv", cycles_csv(results)},
                                    {"states.csv", states_csv(results)},
                                    {"transitions.csv", transitions_csv(results)},
                                    {"barriers.csv", barriers_csv(results)},
                                    {"escapes.csv", escapes_csv(results)}})
    if (!bytes.empty()) files.push_back({path, bytes});
  const auto graphs = graph_names(results);
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (graphs[i].empty()) continue;
    files.push_back({"graphs/" + graphs[i] + ".graphml", transitions_graphml(results[i])});
    files.push_back({"graphs/" + graphs[i] + ".gv", transitions_dot(results[i])});
  }
  files.push_back({"steps.csv", steps_csv(results)});
  files.push_back({"summary.json", summary_json(the_case, results)});
  if (with_report) files.push_back({"report.html", report_html(the_case, results)});
  files.push_back({"timings.json", timings_json(results), false});
  return files;
}

bool has_graphs(const std::vector<StudyResult>& results) {
  return std::any_of(results.begin(), results.end(), has_transitions);
}

ListedFile listed(const PlannedFile& file) {
  if (!file.is_reproducible) return {file.path};
  return {file.path, sha256(file.bytes), file.bytes.size()};
}

bool contains(const std::vector<ListedFile>& files, const std::string& path) {
  return std::any_of(files.begin(), files.end(), [&](const auto& f) { return f.path == path; });
}

void remove_file(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) fs::remove(path, error);
  if (error) throw std::runtime_error{"cannot remove " + path.string() + ": " + error.message()};
}

}  // namespace

std::vector<fs::path> write_results(const fs::path& folder, const Case& the_case,
                                    const std::vector<StudyResult>& results, SetState state,
                                    bool with_report) {
  make_folder(folder / "branches");
  if (std::any_of(results.begin(), results.end(),
                  [](const StudyResult& result) { return result.equilibria.has_value(); }))
    make_folder(folder / "equilibria");
  if (has_graphs(results)) make_folder(folder / "graphs");
  const auto files = planned_files(the_case, results, with_report);
  if (std::any_of(files.begin(), files.end(),
                  [](const PlannedFile& file) { return file.path.starts_with("sweeps/"); }))
    make_folder(folder / "sweeps");
  std::vector<ListedFile> list;
  for (const auto& file : files) list.push_back(listed(file));
  std::vector<ListedFile> leftovers;
  for (const auto& path : files_listed_in(folder))
    if (!contains(list, path)) leftovers.push_back({path});

  // Killed from here on, the folder says itself that it is not whole, and a later run still knows
  // every file that it has to remove.
  std::vector<ListedFile> old_and_new = list;
  old_and_new.insert(old_and_new.end(), leftovers.begin(), leftovers.end());
  const fs::path manifest = folder / "manifest.json";
  write_file(manifest, manifest_text(the_case, SetState::being_written, old_and_new));

  std::vector<fs::path> written;
  for (const auto& file : files) {
    write_file(folder / file.path, file.bytes);
    written.push_back(folder / file.path);
  }
  for (const auto& file : leftovers) remove_file(folder / file.path);
  write_file(manifest, manifest_text(the_case, state, list));
  written.push_back(manifest);
  return written;
}

void close_results(const fs::path& folder, SetState state,
                   const std::vector<std::string>& pending) {
  set_manifest_state(folder, state, pending);
}

}  // namespace springfold::io
