#include "point_summary.hpp"

#include <cmath>

#include "counts_beside.hpp"
#include "fitted_table.hpp"
#include "quantity_sizes.hpp"
#include "result_access.hpp"
#include "summary_line.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

using analysis::Branch;
using analysis::StudyResult;

/// At a limit or branch point an eigenvalue is zero: the neighbours say what changes there.
std::string index_text(const StudyResult& result, const Branch& branch,
                       const analysis::Event& event, std::string_view name) {
  const CountsBeside counts = counts_beside(result, branch, event, name);
  const std::string before = count_text(counts.before, counts.before_rests),
                    after = count_text(counts.after, counts.after_rests);
  if (before == after || after.empty()) return before;
  return (before.empty() ? "?" : before) + " > " + after;
}

}  // namespace

std::string point_number(double value) {
  return std::isnan(value) ? "" : rounded(value, summary_digits);
}

std::string point_lines(const StudyResult& result, const Branch& branch,
                        const std::vector<double>& sizes) {
  if (branch.events.empty()) return summary_line("points", "none");
  std::vector<std::string> columns;
  for (const char* name : {"lambda", "deflection", "force"})
    if (column_of(result, name)) columns.emplace_back(name);
  std::vector<std::vector<std::string>> rows = {{"points"}};
  for (const std::string& name : columns) rows.front().push_back(shown_name(result, name));
  std::vector<std::string> indices = {"index"};
  for (const char* name : {"index_force", "index_driven"})
    if (column_of(result, name)) indices.emplace_back(name);
  rows.front().insert(rows.front().end(), indices.begin(), indices.end());
  for (const auto& event : branch.events) {
    auto& row = rows.emplace_back();
    row.push_back(event.label);
    for (const auto& name : columns)
      row.push_back(point_number(shown_in(sizes, column_of(result, name).value_or(sizes.size()),
                                          value_at(result, branch, event.row, name))));
    const bool is_unresolved = event.kind == analysis::EventKind::unresolved;
    for (const auto& name : indices) row.push_back(index_text(result, branch, event, name));
    row.push_back(is_unresolved ? unresolved_text(event.detail) : event.detail);
  }
  std::vector<Align> align(1 + columns.size() + indices.size(), Align::right);
  align.front() = Align::left;
  align.push_back(Align::left);
  rows.front().front().resize(summary_label_width - 2, ' ');
  return fitted(rows, align, summary_indent);
}

}  // namespace springfold::io
