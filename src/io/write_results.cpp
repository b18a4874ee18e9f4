// One folder of results: every file complete or not there, none left over from an earlier run.
#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>

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
  bool is_left_out = false;  ///< there was no time for it
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

/// The tables of all branches, the short ones first: once it is over, the others are left out.
std::vector<PlannedFile> branch_tables(const std::vector<StudyResult>& results,
                                       const std::function<bool()>& is_over) {
  std::vector<PlannedFile> files;
  std::vector<std::pair<const StudyResult*, const analysis::Branch*>> from;
  const auto names = branch_files(results);
  for (std::size_t i = 0; i < results.size(); ++i)
    for (std::size_t b = 0; b < results[i].branches.size(); ++b) {
      files.push_back({.path = names[i][b]});
      from.emplace_back(&results[i], &results[i].branches[b]);
    }
  std::vector<std::size_t> order(files.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return from[a].second->samples.size() < from[b].second->samples.size();
  });
  for (const std::size_t k : order) {
    auto table =
        is_over && is_over() ? std::nullopt : branch_csv(*from[k].first, *from[k].second, is_over);
    files[k].is_left_out = !table;
    if (table) files[k].bytes = std::move(*table);
  }
  return files;
}

std::vector<PlannedFile> planned_files(const Case& the_case,
                                       const std::vector<StudyResult>& results, bool with_report,
                                       const std::function<bool()>& is_over) {
  std::vector<PlannedFile> files = branch_tables(results, is_over);
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
  if (with_report && is_over && is_over())
    files.push_back({.path = "report.html", .is_left_out = true});
  else if (with_report)
    files.push_back({"report.html", report_html(the_case, results)});
  files.push_back({"timings.json", timings_json(results), false});
  return files;
}

bool has_graphs(const std::vector<StudyResult>& results) {
  return std::any_of(results.begin(), results.end(), has_transitions);
}

/// Files that are written whatever the time: each takes a few milliseconds.
bool is_short(const PlannedFile& file) { return file.bytes.size() < std::size_t{1} << 22; }

/// With their hashes, but those that are left out: also the long ones that there is no time to hash.
std::vector<ListedFile> listed(std::vector<PlannedFile>& files,
                               const std::function<bool()>& is_over) {
  std::vector<ListedFile> list;
  for (PlannedFile& file : files) {
    if (file.is_left_out) continue;
    std::optional<std::string> hash = "";
    if (file.is_reproducible)
      hash = is_short(file) ? sha256(file.bytes) : sha256(file.bytes, is_over);
    file.is_left_out = !hash;
    if (hash) list.push_back({file.path, *hash, hash->empty() ? 0 : file.bytes.size()});
  }
  return list;
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
                                    bool with_report, Deadline* deadline) {
  const std::function<bool()> is_over = deadline != nullptr ? deadline->is_over : nullptr;
  make_folder(folder / "branches");
  if (std::any_of(results.begin(), results.end(),
                  [](const StudyResult& result) { return result.equilibria.has_value(); }))
    make_folder(folder / "equilibria");
  if (has_graphs(results)) make_folder(folder / "graphs");
  auto files = planned_files(the_case, results, with_report, is_over);
  if (std::any_of(files.begin(), files.end(),
                  [](const PlannedFile& file) { return file.path.starts_with("sweeps/"); }))
    make_folder(folder / "sweeps");
  std::vector<ListedFile> list = listed(files, is_over);
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
  for (auto& file : files) {
    if (file.is_left_out) continue;
    const bool may_wait = file.path.starts_with("branches/") && !is_short(file);
    file.is_left_out =
        !write_file(folder / file.path, file.bytes, may_wait ? is_over : std::function<bool()>{});
    if (!file.is_left_out) written.push_back(folder / file.path);
  }
  for (const auto& file : leftovers) remove_file(folder / file.path);
  std::vector<std::string> unwritten;
  for (const auto& file : files) {
    if (!file.is_left_out) continue;
    unwritten.push_back(file.path);
    remove_file(folder / file.path);  // that of an earlier run
    std::erase_if(list, [&](const ListedFile& l) { return l.path == file.path; });
  }
  if (!unwritten.empty() && state == SetState::whole) state = SetState::interrupted;
  write_file(manifest, manifest_text(the_case, state, list));
  if (!unwritten.empty()) set_manifest_state(folder, state, unwritten);
  if (deadline != nullptr) deadline->unwritten = std::move(unwritten);
  written.push_back(manifest);
  return written;
}

void close_results(const fs::path& folder, SetState state,
                   const std::vector<std::string>& pending) {
  set_manifest_state(folder, state, pending);
}

}  // namespace springfold::io
