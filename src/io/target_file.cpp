// Targets in a file of comma-separated values.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "command_reader.hpp"

namespace springfold::io {
namespace {

std::string unquoted(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '"'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return std::string{text};
}

std::vector<std::string> fields_of(std::string_view line) {
  std::vector<std::string> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(unquoted(line.substr(0, comma)));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

/// A finite number that is the whole field.
std::optional<double> number_in(const std::string& field) {
  double value = 0;
  const char* first = field.data() + (field.starts_with('+') ? 1 : 0);
  const char* last = field.data() + field.size();
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc{} || end != last || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// Column of every name; a missing one is reported if it is needed.
std::vector<std::optional<std::size_t>> columns_of(const std::vector<std::string>& names,
                                                   const std::vector<std::string>& header,
                                                   bool needed, const Place& place,
                                                   Problems& problems) {
  std::vector<std::optional<std::size_t>> columns;
  for (const std::string& name : names) {
    const auto found = std::find(header.begin(), header.end(), name);
    columns.push_back(found == header.end() ? std::nullopt
                                            : std::optional<std::size_t>{static_cast<std::size_t>(
                                                  found - header.begin())});
    if (!columns.back() && needed) problems.add(place, "", "need a column \"" + name + "\"");
  }
  return columns;
}

}  // namespace

void read_target_file(const TargetFile& file, const std::string& shown_name,
                      const std::string& text, CommandDraft& draft, NumberTable& numbers,
                      Problems& problems) {
  std::vector<std::string> header;
  std::vector<std::optional<std::size_t>> targets, wrenches;
  int number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line = std::string_view{text}.substr(at, end - at);
    at = end + 1;
    ++number;
    line = line.substr(0, line.find('#'));
    if (unquoted(line).empty()) continue;
    const Place place{shown_name, number, 1};
    const std::vector<std::string> fields = fields_of(line);
    if (header.empty()) {
      header = fields;
      targets = columns_of(file.coordinates, header, true, place, problems);
      wrenches = columns_of(file.wrench, header, false, place, problems);
      for (const std::string& name : header)
        if (std::find(file.coordinates.begin(), file.coordinates.end(), name) ==
                file.coordinates.end() &&
            std::find(file.wrench.begin(), file.wrench.end(), name) == file.wrench.end())
          problems.add(place, "",
                       "unknown column \"" + name + "\"; known here: " + choices(file.coordinates) +
                           " and " + choices(file.wrench));
      continue;
    }
    if (fields.size() != header.size()) {
      problems.add(place, "",
                   "got " + std::to_string(fields.size()) + " fields, need " +
                       std::to_string(header.size()) + " as in the first line");
      continue;
    }
    const auto take = [&](const std::vector<std::optional<std::size_t>>& columns) {
      std::vector<NumberId> ids;
      for (const auto& column : columns) {
        const auto value = column ? number_in(fields[*column]) : std::optional<double>{0};
        if (!value)
          problems.add(place, header[*column], "got \"" + fields[*column] + "\", need a number");
        ids.push_back(numbers.add(value.value_or(0)));
      }
      return ids;
    };
    draft.targets.push_back(take(targets));
    const bool has_wrench = std::any_of(wrenches.begin(), wrenches.end(),
                                        [](const auto& column) { return column.has_value(); });
    if (has_wrench) draft.loads.push_back(take(wrenches));
  }
  if (draft.targets.empty())
    problems.add(file.place, file.key, "\"" + file.name + "\" has no targets, need at least one");
}

}  // namespace springfold::io
