// Our values beside published and closed-form ones.
#include <algorithm>
#include <cmath>
#include <limits>

#include "result_access.hpp"
#include "springfold/io/results.hpp"
#include "text.hpp"

namespace springfold::io {

namespace {

using analysis::StudyResult;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view count_prefix = "count.";

double count_of(const StudyResult& result, std::string_view code) {
  const auto counts = event_counts(result);
  const auto found = counts.find(std::string{code});
  return found == counts.end() ? 0 : found->second;
}

/// Value at the event with this label. A point where branches meet is taken on the first of them.
double value_at_event(const StudyResult& result, std::string_view label,
                      std::string_view quantity) {
  for (const auto& branch : result.branches)
    for (const auto& event : branch.events)
      if (event.label == label) return value_at(result, branch, event.row, quantity);
  return nothing;
}

double found_value(const ExpectedValue& expected, const StudyResult& result) {
  const std::string_view quantity = expected.quantity;
  if (quantity.starts_with(count_prefix))
    return result.start.found ? count_of(result, quantity.substr(count_prefix.size())) : nothing;
  if (result.branches.empty()) return nothing;
  const auto& first = result.branches.front();
  if (expected.at == "start") return value_at(result, first, first.start_row, quantity);
  if (expected.at != "end") return value_at_event(result, expected.at, quantity);
  return first.samples.empty() ? nothing
                               : value_at(result, first, first.samples.size() - 1, quantity);
}

std::string signed_rounded(double value, int digits) {
  return (value >= 0 ? "+" : "") + rounded(value, digits);
}

/// Headings in order of first appearance.
std::vector<std::string> groups_of(const std::vector<Comparison>& comparisons) {
  std::vector<std::string> groups;
  for (const auto& [expected, ours, holds] : comparisons)
    if (std::find(groups.begin(), groups.end(), expected.group) == groups.end())
      groups.push_back(expected.group);
  return groups;
}

std::vector<std::string> row_of(const Comparison& comparison) {
  const auto& [expected, ours, holds] = comparison;
  return {expected.name,
          std::isnan(ours) ? "not found" : rounded(ours, 10),
          rounded(expected.expected, 12),
          std::isnan(ours) ? "" : signed_rounded(ours - expected.expected, 2),
          rounded(expected.tolerance, 12),
          holds ? "ok" : "NOT OK",
          expected.source};
}

}  // namespace

std::vector<Comparison> compare(const Expectations& expected,
                                const std::vector<StudyResult>& results) {
  std::vector<Comparison> comparisons;
  for (const auto& value : expected.values) {
    const StudyResult* result = result_of(results, value.study, value.run);
    const double ours = result == nullptr ? nothing : value.factor * found_value(value, *result);
    const bool holds = std::abs(ours - value.expected) <= value.tolerance;  // false for NaN
    comparisons.push_back({.expected = value, .ours = ours, .holds = holds});
  }
  return comparisons;
}

std::string comparison_table(const std::vector<Comparison>& comparisons,
                             const Expectations& expected) {
  if (comparisons.empty()) return "";
  constexpr Align l = Align::left, r = Align::right;
  // One table for all groups, so that their columns stand under each other.
  std::vector<std::vector<std::string>> rows = {
      {"value", "ours", "reference", "difference", "tolerance", "", "source"}};
  std::vector<std::pair<std::size_t, std::string>> headings;  // before which row
  for (const auto& group : groups_of(comparisons)) {
    headings.emplace_back(rows.size(), group);
    for (const auto& comparison : comparisons)
      if (comparison.expected.group == group) rows.push_back(row_of(comparison));
  }

  std::string text = "Compared with reference values\n\n";
  const std::string table = aligned(rows, {l, r, r, r, r, l, l}, 4);
  std::size_t row = 0;
  auto heading = headings.begin();
  for (std::size_t at = 0; at < table.size(); ++row) {
    if (heading != headings.end() && heading->first == row) {
      if (!heading->second.empty()) text += (row > 1 ? "\n  " : "  ") + heading->second + "\n";
      ++heading;
    }
    const std::size_t end = table.find('\n', at) + 1;
    text += table.substr(at, end - at);
    at = end;
  }
  if (!expected.notes.empty()) text += "\n  Notes\n";
  for (const auto& note : expected.notes) {
    std::string lead = "  - ";
    for (const auto& line : wrapped(note, 96)) {
      text += lead + line + "\n";
      lead = "    ";
    }
  }
  return text;
}

}  // namespace springfold::io
