#include "springfold/io/checkpoint.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <memory>

#include "atomic_file.hpp"
#include "manifest.hpp"
#include "springfold/version.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

namespace fs = std::filesystem;
using analysis::PartialRows;

fs::path path_of(const fs::path& folder, const PlannedRun& planned) {
  return folder /
         (".checkpoint-" + safe_file_name(planned.study) + "-" + std::to_string(planned.run));
}

std::size_t nodes_of(const PlannedRun& planned) {
  return static_cast<std::size_t>(planned.plan.map.nodes());
}

std::string header_of(const Case& the_case, const PlannedRun& planned) {
  return "springfold checkpoint 1 " + std::string{version} + " " + the_case.hash + " " +
         std::to_string(nodes_of(planned)) + " " + planned.study + "\n";
}

/// Takes the text up to the next separator off the front.
std::string_view taken(std::string_view& text, char separator) {
  const std::size_t end = std::min(text.find(separator), text.size());
  const std::string_view front = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return front;
}

template <class Number>
bool read_number(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

/// node, state, piece, status, values; tabs between them, nothing for NaN.
bool read_row(std::string_view line, PartialRows& all) {
  std::size_t node = 0;
  if (!read_number(taken(line, '\t'), node) || node >= all.rows.size()) return false;
  analysis::Sample sample;
  int state = 0;
  constexpr int last = static_cast<int>(analysis::NodeState::undecided);
  if (!read_number(taken(line, '\t'), state) || state < 0 || state > last) return false;
  sample.state = static_cast<analysis::NodeState>(state);
  sample.piece = taken(line, '\t');
  sample.status = taken(line, '\t');
  while (!line.empty()) {
    double value = std::numeric_limits<double>::quiet_NaN();
    const std::string_view field = taken(line, '\t');
    if (field != "." && !read_number(field, value)) return false;
    sample.values.push_back(value);
  }
  all.rows[node] = std::move(sample);
  all.done[node] = true;
  return true;
}

fs::path row_path_of(const fs::path& folder, const std::string& study) {
  return folder / (".checkpoint-" + safe_file_name(study) + "-rows");
}

std::string row_header_of(const Case& the_case, const std::string& study) {
  return "springfold rows 1 " + std::string{version} + " " + the_case.hash + " " + study + "\n";
}

void append_numbers(std::string& text, const std::vector<double>& values) {
  text += "\t" + std::to_string(values.size());
  for (const double value : values)
    text += "\t" + (std::isnan(value) ? std::string(".") : shortest(value));
}

bool read_numbers(std::string_view& line, std::vector<double>& values) {
  std::size_t count = 0;
  if (!read_number(taken(line, '\t'), count) || count > line.size()) return false;
  for (std::size_t i = 0; i < count; ++i) {
    double value = std::numeric_limits<double>::quiet_NaN();
    const std::string_view field = taken(line, '\t');
    if (field != "." && !read_number(field, value)) return false;
    values.push_back(value);
  }
  return true;
}

/// run, start found, complete, status, values, compared values.
std::optional<analysis::StudyResult> kept_row(std::string_view line, const PlannedRun& planned) {
  analysis::StudyResult result{.study = planned.study, .run = planned.run, .label = planned.label};
  analysis::SweepRow row;
  int found = 0, complete = 0;
  if (!read_number(taken(line, '\t'), found) || !read_number(taken(line, '\t'), complete))
    return std::nullopt;
  result.start.found = found == 1;
  row.complete = complete == 1;
  row.status = taken(line, '\t');
  if (!read_numbers(line, row.values) || !read_numbers(line, row.compared) ||
      row.values.size() != planned.columns.size())
    return std::nullopt;
  result.row = std::make_shared<const analysis::SweepRow>(std::move(row));
  return result;
}

}  // namespace

void write_checkpoint(const fs::path& folder, const Case& the_case, const PlannedRun& planned,
                      const PartialRows& rows) {
  std::string text = header_of(the_case, planned);
  for (std::size_t node = 0; node < rows.rows.size(); ++node) {
    if (!rows.done[node]) continue;
    const analysis::Sample& sample = rows.rows[node];
    text += std::to_string(node) + "\t" + std::to_string(static_cast<int>(sample.state)) + "\t" +
            sample.piece + "\t" + sample.status;
    for (const double value : sample.values)
      text += "\t" + (std::isnan(value) ? std::string(".") : shortest(value));
    text += "\n";
  }
  text += "end\n";
  write_file(path_of(folder, planned), text);
  put_on_disk(path_of(folder, planned));
}

std::optional<PartialRows> read_checkpoint(const fs::path& folder, const Case& the_case,
                                           const PlannedRun& planned) {
  const fs::path path = path_of(folder, planned);
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  const std::string text = read_file(path);
  const std::string header = header_of(the_case, planned);
  if (!text.starts_with(header) || !text.ends_with("\nend\n")) return std::nullopt;
  std::string_view rest = std::string_view{text}.substr(header.size());
  rest.remove_suffix(4);
  PartialRows all{std::vector<analysis::Sample>(nodes_of(planned)),
                  std::vector<bool>(nodes_of(planned), false)};
  while (!rest.empty())
    if (!read_row(taken(rest, '\n'), all)) return std::nullopt;
  return all;
}

std::string row_line(const analysis::StudyResult& result) {
  std::string text = std::to_string(result.run) + "\t" + (result.start.found ? "1" : "0") + "\t" +
                     (result.row->complete ? "1" : "0") + "\t" + result.row->status;
  append_numbers(text, result.row->values);
  append_numbers(text, result.row->compared);
  return text;
}

std::optional<analysis::StudyResult> read_row_line(std::string_view line, const Case& the_case,
                                                   const std::string& study) {
  int run = 0;
  if (!read_number(taken(line, '\t'), run)) return std::nullopt;
  const auto planned = std::find_if(
      the_case.runs.begin(), the_case.runs.end(),
      [&](const PlannedRun& known) { return known.run == run && known.study == study; });
  return planned == the_case.runs.end() ? std::nullopt : kept_row(line, *planned);
}

void write_row_checkpoint(const fs::path& folder, const Case& the_case, const std::string& study,
                          const std::vector<const analysis::StudyResult*>& done) {
  std::string text = row_header_of(the_case, study);
  for (const analysis::StudyResult* result : done) text += row_line(*result) + "\n";
  text += "end\n";
  write_file(row_path_of(folder, study), text);
  put_on_disk(row_path_of(folder, study));
}

std::map<int, analysis::StudyResult> read_row_checkpoint(const fs::path& folder,
                                                         const Case& the_case,
                                                         const std::string& study) {
  const fs::path path = row_path_of(folder, study);
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return {};
  const std::string text = read_file(path);
  const std::string header = row_header_of(the_case, study);
  if (!text.starts_with(header) || !text.ends_with("\nend\n")) return {};
  std::map<int, const PlannedRun*> planned;
  for (const PlannedRun& run : the_case.runs)
    if (run.study == study) planned[run.run] = &run;
  std::string_view rest = std::string_view{text}.substr(header.size());
  rest.remove_suffix(4);
  std::map<int, analysis::StudyResult> known;
  while (!rest.empty()) {
    std::string_view line = taken(rest, '\n');
    int run = 0;
    if (!read_number(taken(line, '\t'), run) || !planned.contains(run)) return {};
    auto result = kept_row(line, *planned[run]);
    if (!result) return {};
    known.emplace(run, std::move(*result));
  }
  return known;
}

void remove_checkpoints(const fs::path& folder, const Case& the_case) {
  std::vector<fs::path> there;
  std::error_code ignored;
  for (const PlannedRun& planned : the_case.runs)
    if (fs::exists(path_of(folder, planned), ignored)) there.push_back(path_of(folder, planned));
  for (const SweepTable& sweep : the_case.sweeps)
    if (fs::exists(row_path_of(folder, sweep.study), ignored))
      there.push_back(row_path_of(folder, sweep.study));
  if (there.empty()) return;
  const auto files = files_listed_in(folder);
  for (const std::string& file : files) put_on_disk(folder / file);
  if (!files.empty()) put_on_disk(folder / "manifest.json");
  for (const fs::path& checkpoint : there) fs::remove(checkpoint, ignored);
}

}  // namespace springfold::io
