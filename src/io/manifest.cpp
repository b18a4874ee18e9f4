#include "manifest.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "atomic_file.hpp"
#include "json_text.hpp"
#include "run_options.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/version.hpp"

namespace springfold::io {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* manifest_name = "manifest.json";

Json json_of(const ListedFile& file) {
  Json json = {{"path", file.path}};
  if (!file.hash.empty()) {
    json["sha256"] = file.hash;
    json["bytes"] = file.bytes;
  }
  return json;
}

Json json_of(const PlannedRun& planned) {
  Json options = Json::object();
  Json given = Json::array();
  for (const auto& option : options_of(planned)) {
    options[option.name] = option.value;
    if (!option.is_default) given.push_back(option.name);
  }
  return {{"study", planned.study},           {"run", planned.run},     {"label", planned.label},
          {"parameters", planned.parameters}, {"options_given", given}, {"options_used", options}};
}

const char* word_of(SetState state) {
  return state == SetState::whole         ? "whole"
         : state == SetState::interrupted ? "interrupted"
                                          : "being written";
}

/// The manifest of an earlier run, or null: also for a file that is damaged, or that somebody else
/// made, deeply nested or very large.
Json read_manifest(const fs::path& folder) {
  constexpr int deepest = 8;                                   // ours are 4 deep
  constexpr std::uintmax_t largest = std::uintmax_t{1} << 28;  // [byte]
  std::error_code error;
  const fs::path file = folder / manifest_name;
  if (!fs::is_regular_file(file, error) || fs::file_size(file, error) > largest) return nullptr;
  bool is_too_deep = false;
  const auto within = [&](int depth, Json::parse_event_t, Json&) {
    is_too_deep = is_too_deep || depth > deepest;
    return !is_too_deep;
  };
  try {
    const auto json = Json::parse(read_file(file), within, false);
    if (is_too_deep) return nullptr;
    const bool is_ours = json.is_object() && json.value("program", Json{}) == "springfold" &&
                         json.contains("files") && json["files"].is_array();
    return is_ours ? json : Json{};
  } catch (const std::runtime_error&) {
    return nullptr;
  }
}

/// "name", or a name in one of the folders that results have.
bool stays_in_the_set(const std::string& path) {
  const auto slash = path.find('/');
  const auto folder = slash == std::string::npos ? "" : path.substr(0, slash);
  const auto name = slash == std::string::npos ? path : path.substr(slash + 1);
  const bool is_ours = folder.empty() || folder == "branches" || folder == "equilibria" ||
                       folder == "graphs" || folder == "sweeps" || folder == "plots";
  return is_ours && !name.empty() && name.find('/') == std::string::npos && name != "." &&
         name != "..";
}

std::string path_in(const Json& entry) {
  const bool has_path = entry.is_object() && entry.contains("path") && entry["path"].is_string();
  return has_path ? entry["path"].get<std::string>() : std::string{};
}

}  // namespace

std::string manifest_text(const Case& the_case, SetState state,
                          const std::vector<ListedFile>& files) {
  Json json = {{"schema_version", 1},
               {"program", "springfold"},
               {"version", version},
               {"state", word_of(state)}};
  json["case"] = {{"file", the_case.file.filename().string()},
                  {"title", the_case.title},
                  {"hash", the_case.hash}};
  json["overrides"] = Json(the_case.overrides);
  json["runs"] = Json::array();
  // Of runs whose curves are not kept the first one stands for all: tables have what differs.
  for (const auto& planned : the_case.runs)
    if (planned.keeps_curves || planned.run == 1) json["runs"].push_back(json_of(planned));
  json["numerics"] = Json::object();
  for (const auto& [name, number] : continuation::numbers_judged_by)
    json["numerics"][name] = number;
  json["files"] = Json::array();
  for (const auto& file : files) json["files"].push_back(json_of(file));
  return json_text(json);
}

std::vector<std::string> files_listed_in(const fs::path& folder) {
  std::vector<std::string> paths;
  const Json manifest = read_manifest(folder);
  if (manifest.is_null()) return paths;
  for (const auto& entry : manifest["files"])
    if (auto path = path_in(entry); stays_in_the_set(path)) paths.push_back(std::move(path));
  return paths;
}

std::vector<ListedFile> hashes_listed_in(const fs::path& folder) {
  std::vector<ListedFile> files;
  const Json manifest = read_manifest(folder);
  if (manifest.is_null()) return files;
  for (const auto& entry : manifest["files"]) {
    const std::string path = path_in(entry);
    if (!stays_in_the_set(path)) continue;
    const bool has_hash = entry.contains("sha256") && entry["sha256"].is_string();
    files.push_back({path, has_hash ? entry["sha256"].get<std::string>() : ""});
  }
  return files;
}

void set_manifest_state(const fs::path& folder, SetState state,
                        const std::vector<std::string>& pending) {
  Json manifest = read_manifest(folder);
  if (manifest.is_null()) return;
  manifest["state"] = word_of(state);
  manifest["pending"] = pending;
  write_file(folder / manifest_name, json_text(manifest));
}

void list_in_manifest(const fs::path& folder, const std::vector<ListedFile>& files) {
  Json manifest = read_manifest(folder);
  if (manifest.is_null()) return;
  auto& listed = manifest["files"];
  for (const auto& file : files) {
    const auto same = [&](const Json& entry) { return path_in(entry) == file.path; };
    const auto found = std::find_if(listed.begin(), listed.end(), same);
    if (found == listed.end())
      listed.push_back(json_of(file));
    else
      *found = json_of(file);
  }
  write_file(folder / manifest_name, json_text(manifest));
}

}  // namespace springfold::io
