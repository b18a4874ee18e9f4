#include "selection.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <system_error>

namespace springfold::cli {

namespace {

namespace fs = std::filesystem;

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Letters to insert, remove or replace to make one text of the other.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::vector<std::string> study_names(const io::Case& the_case) {
  std::vector<std::string> names;
  for (const auto& run : the_case.runs)
    if (!contains(names, run.study)) names.push_back(run.study);
  return names;
}

std::string unknown_study(const io::Case& the_case, const std::vector<std::string>& wanted) {
  const auto known = study_names(the_case);
  for (const auto& name : wanted) {
    if (contains(known, name) || known.empty()) continue;
    const auto nearest = std::min_element(known.begin(), known.end(),
                                          [&](const std::string& a, const std::string& b) {
                                            return edit_distance(name, a) < edit_distance(name, b);
                                          });
    std::string message = "there is no study \"" + name + "\"";
    if (edit_distance(name, *nearest) <= std::max<std::size_t>(2, name.size() / 3))
      message += ", did you mean \"" + *nearest + "\"?";
    message += message.ends_with('?') ? " Studies of this case:" : "; studies of this case:";
    for (const auto& other : known)
      message += (&other == &known.front() ? " \"" : ", \"") + other + "\"";
    return message;
  }
  return "";
}

namespace {

/// A plain number; of a formula nobody but the reader knows the value.
std::optional<double> number_in(const std::string& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// Does the study give this parameter values of its own? They come before --set.
bool has_own_values(const io::PlannedRun& run, const std::string& name, const std::string& given) {
  if (contains(run.varied, name)) return true;
  const auto used = run.parameters.find(name);
  const auto number = number_in(given);
  return number && used != run.parameters.end() && used->second != *number;
}

}  // namespace

std::vector<std::string> settings_without_effect(
    const io::Case& the_case, const std::map<std::string, std::string>& overrides) {
  std::vector<std::string> messages;
  for (const auto& [name, given] : overrides) {
    std::vector<std::string> studies;
    for (const io::PlannedRun& run : the_case.runs)
      if (!contains(studies, run.study) && has_own_values(run, name, given))
        studies.push_back(run.study);
    if (studies.empty()) continue;
    std::string list;
    for (const std::string& study : studies) list += (list.empty() ? "\"" : ", \"") + study + "\"";
    messages.push_back("--set " + name + "=" + given + " has no effect in " + list +
                       ": the study's own values of " + name + " (vary or set) come first");
  }
  return messages;
}

io::Case with_studies(io::Case the_case, const std::vector<std::string>& wanted) {
  if (wanted.empty()) return the_case;
  const auto is_left_out = [&](const auto& item) { return !contains(wanted, item.study); };
  std::erase_if(the_case.runs, is_left_out);
  std::erase_if(the_case.expected.values, is_left_out);
  for (auto& plot : the_case.plots) std::erase_if(plot.curves, is_left_out);
  std::erase_if(the_case.plots, [](const io::PlotSpec& plot) { return plot.curves.empty(); });
  for (auto& plot : the_case.map_plots) std::erase_if(plot.panels, is_left_out);
  std::erase_if(the_case.map_plots, [](const auto& plot) { return plot.panels.empty(); });
  std::erase_if(the_case.tornados, is_left_out);
  for (auto& picture : the_case.pictures) std::erase_if(picture.postures, is_left_out);
  std::erase_if(the_case.pictures, [](const auto& picture) { return picture.postures.empty(); });
  if (the_case.expected.values.empty()) the_case.expected.notes.clear();
  return the_case;
}

fs::path default_folder(const fs::path& case_file) {
  const fs::path full = fs::absolute(case_file).lexically_normal();
  const bool has_plain_name = full.stem() == "case" && full.parent_path().has_filename();
  if (has_plain_name) return fs::path{"results"} / full.parent_path().filename();
  // Without their ending "..toml" and "...toml" are names of folders above.
  const bool leads_up = full.stem() == "." || full.stem() == "..";
  return fs::path{"results"} / (leads_up ? full.filename() : full.stem());
}

std::string problem_with_folder(const fs::path& folder) {
  std::error_code error;
  for (const fs::path& path : {folder, folder / "branches"}) {
    fs::create_directories(path, error);
    if (!error && !fs::is_directory(path, error) && !error)
      error = std::make_error_code(std::errc::not_a_directory);
    if (error) return "cannot create folder " + path.string() + ": " + error.message();
    std::string name = (path / ".springfold-XXXXXX").string();
    const int file = ::mkstemp(name.data());
    if (file < 0)
      return "cannot write into folder " + path.string() + ": " +
             std::generic_category().message(errno);
    ::close(file);
    ::unlink(name.c_str());
  }
  return "";
}

}  // namespace springfold::cli
