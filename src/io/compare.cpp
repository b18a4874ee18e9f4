// Our values beside published and closed-form ones.
#include <algorithm>
#include <cmath>
#include <limits>

#include "compared_quantity.hpp"
#include "comparison_text.hpp"
#include "fitted_table.hpp"
#include "nothing.hpp"
#include "result_access.hpp"
#include "springfold/io/results.hpp"
#include "springfold/io/shown_text.hpp"
#include "text.hpp"

namespace springfold::io {

namespace {

using analysis::StudyResult;

/// False for NaN.
bool agrees(const ExpectedValue& expected, double ours) {
  switch (expected.agreement) {
    case Agreement::equal:
      return std::abs(ours - expected.expected) <= expected.tolerance;
    case Agreement::at_least:
      return ours >= expected.expected - expected.tolerance;
    case Agreement::at_most:
      return ours <= expected.expected + expected.tolerance;
  }
  return false;
}

/// The value of a run of which only its row is kept: the how-manieth of this run it is says where it stands.
double kept_value(const Expectations& expected, const ExpectedValue& value,
                  const StudyResult& result) {
  std::size_t at = 0;
  for (const ExpectedValue& other : expected.values) {
    if (&other == &value) break;
    if (other.study == value.study && other.run == value.run) ++at;
  }
  return at < result.row->compared.size() ? result.row->compared[at] : nothing;
}

/// Headings in order of first appearance.
std::vector<std::string> groups_of(const std::vector<Comparison>& comparisons) {
  std::vector<std::string> groups;
  for (const Comparison& comparison : comparisons)
    if (std::find(groups.begin(), groups.end(), comparison.expected.group) == groups.end())
      groups.push_back(comparison.expected.group);
  return groups;
}

std::string source_number(std::size_t i) { return "[" + std::to_string(i + 1) + "]"; }

/// A row, and further ones for the words of its name that have no room. Sources stand below, each once.
void add_rows(const Comparison& comparison, std::vector<std::string>& sources,
              std::vector<std::vector<std::string>>& rows) {
  constexpr std::size_t name_width = 26;  // so that the numbers fit behind it
  std::vector<std::string> cells = comparison_cells(comparison);
  if (std::string& source = cells.back(); !source.empty()) {
    const auto known = std::find(sources.begin(), sources.end(), source);
    const auto number = static_cast<std::size_t>(known - sources.begin());
    if (known == sources.end()) sources.push_back(source);
    source = source_number(number);
  }
  const std::vector<std::string> name = wrapped(shown(cells.front()), name_width);
  for (std::size_t i = 1; i < name.size(); ++i) rows.push_back({name[i - 1]});
  if (!name.empty()) cells.front() = name.back();
  rows.push_back(std::move(cells));
}

/// In lines that fit a terminal, the first one after `lead`, the others below its text.
std::string hanging(std::string lead, const std::string& words) {
  std::string text;
  for (const auto& line : wrapped(words, table_width - lead.size())) {
    text += lead + shown(line) + "\n";
    lead.assign(lead.size(), ' ');
  }
  return text;
}

}  // namespace

std::vector<Comparison> compare(const Expectations& expected,
                                const std::vector<StudyResult>& results) {
  std::vector<Comparison> comparisons;
  for (const auto& value : expected.values) {
    const StudyResult* result = result_of(results, value.study, value.run);
    const double ours = result == nullptr ? nothing
                        : result->row     ? kept_value(expected, value, *result)
                                          : value.factor * found_value(value, *result);
    comparisons.push_back({.expected = value, .ours = ours, .holds = agrees(value, ours)});
  }
  return comparisons;
}

std::string comparison_table(const std::vector<Comparison>& comparisons,
                             const Expectations& expected) {
  if (comparisons.empty()) return "";
  constexpr Align l = Align::left, r = Align::right;
  // One table for all groups, so that their columns stand under each other.
  std::vector<std::vector<std::string>> rows = {
      {"value", "ours", "reference", "difference", "tolerance", "", "from"}};
  std::vector<std::pair<std::size_t, std::string>> headings;  // before which row
  std::vector<std::string> sources;
  for (const auto& group : groups_of(comparisons)) {
    headings.emplace_back(rows.size(), group);
    for (const auto& comparison : comparisons)
      if (comparison.expected.group == group) add_rows(comparison, sources, rows);
  }

  std::string text = "Compared with reference values\n\n";
  const std::string table = aligned(rows, {l, r, r, r, r, l, l}, 4);
  std::size_t row = 0;
  auto heading = headings.begin();
  for (std::size_t at = 0; at < table.size(); ++row) {
    if (heading != headings.end() && heading->first == row) {
      if (!heading->second.empty())
        text += (row > 1 ? "\n  " : "  ") + shown(heading->second) + "\n";
      ++heading;
    }
    const std::size_t end = table.find('\n', at) + 1;
    text += table.substr(at, end - at);
    at = end;
  }
  if (!sources.empty()) text += "\n  Sources\n";
  for (std::size_t i = 0; i < sources.size(); ++i)
    text += hanging("  " + source_number(i) + " ", sources[i]);
  if (!expected.notes.empty()) text += "\n  Notes\n";
  for (const auto& note : expected.notes) text += hanging("  - ", note);
  return text;
}

}  // namespace springfold::io
