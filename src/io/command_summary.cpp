#include "command_summary.hpp"

#include <cmath>

#include "critical_summary.hpp"
#include "fitted_table.hpp"
#include "quantity_sizes.hpp"
#include "result_access.hpp"
#include "summary_line.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

using analysis::Branch;
using analysis::StudyKind;
using analysis::StudyResult;

constexpr std::size_t most_targets = 24;

std::string with_unit(const StudyResult& result, std::size_t column, const UnitLabels& units) {
  const auto unit = unit_label(result.quantities[column].unit, result.lambda_unit, units);
  return unit.empty() ? "" : " [" + unit + "]";
}

std::string stop_lines(const Branch& branch) {
  return summary_line("end",
                      (branch.forward.complete ? "" : "INCOMPLETE: ") + branch.forward.reason);
}

/// Commands of the first targets, and the special points on the way.
std::string control_lines(const StudyResult& result, const UnitLabels& units) {
  const Branch& branch = result.branches.front();
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < result.quantities.size(); ++i) {
    const std::string& name = result.quantities[i].name;
    if (name == "path" || name.ends_with(".rho") || name.ends_with(".compensation") ||
        name == "index_force")
      columns.push_back(i);
  }
  std::vector<std::vector<std::string>> rows(1);
  std::vector<Align> align;
  for (const std::size_t i : columns) {
    rows[0].push_back(result.quantities[i].name + with_unit(result, i, units));
    align.push_back(Align::right);
  }
  const std::vector<double> sizes = quantity_sizes(result);
  std::size_t targets = 0;
  for (const auto& sample : branch.samples) {
    if (!sample.event.empty() || ++targets > most_targets) continue;
    auto& row = rows.emplace_back();
    for (const std::size_t i : columns)
      row.push_back(std::isnan(sample.values[i])
                        ? "-"
                        : rounded(shown_in(sizes, i, sample.values[i]), summary_digits));
    row.push_back(sample.status);
  }
  align.push_back(Align::left);
  std::string text =
      summary_line("method", result.start.method + ", residual at the first target " +
                                 rounded(result.start.residual, 2));
  text +=
      summary_line("targets", std::to_string(targets)) + fitted(rows, align, summary_indent + 2);
  if (targets > most_targets)
    text += summary_line(
        "", "... and " + std::to_string(targets - most_targets) + " more in the table");
  for (const auto& event : branch.events)
    text += summary_line(
        event.label,
        "at path = " + rounded(value_at(result, branch, event.row, "path"), summary_digits) + ": " +
            event.detail);
  return text + stop_lines(branch);
}

/// Least and greatest value of a quantity over the nodes, and where.
/// @param sizes  of the result's quantities
std::vector<std::string> range_row(const StudyResult& result, std::size_t column, std::size_t axes,
                                   const std::vector<double>& sizes, const UnitLabels& units) {
  const auto& samples = result.branches.front().samples;
  const analysis::Sample *least = nullptr, *greatest = nullptr;
  for (const auto& sample : samples) {
    if (!std::isfinite(sample.values[column])) continue;
    if (!least || sample.values[column] < least->values[column]) least = &sample;
    if (!greatest || sample.values[column] > greatest->values[column]) greatest = &sample;
  }
  if (!least) return {};
  const auto place = [&](const analysis::Sample& sample) {
    std::string text;
    for (std::size_t i = 0; i < axes; ++i)
      text += (i == 0 ? "at (" : ", ") + rounded(sample.values[i], 6);
    return text + ")";
  };
  return {result.quantities[column].name + with_unit(result, column, units),
          rounded(shown_in(sizes, column, least->values[column]), 7), place(*least),
          rounded(shown_in(sizes, column, greatest->values[column]), 7), place(*greatest)};
}

std::string map_lines(const PlannedRun& planned, const StudyResult& result,
                      const UnitLabels& units) {
  const auto& map = planned.plan.map;
  std::string grid;
  for (const auto& axis : map.axes)
    grid += (grid.empty() ? "" : ", ") + axis.name + " from " + rounded(axis.from, 6) + " to " +
            rounded(axis.to, 6) + " in " + std::to_string(axis.points);
  std::string text = summary_line("grid", grid) + stop_lines(result.branches.front());
  const std::vector<double> sizes = quantity_sizes(result);
  std::vector<std::vector<std::string>> rows{{"", "least", "", "greatest"}};
  for (std::size_t i = 0; i < result.quantities.size(); ++i) {
    const std::string& name = result.quantities[i].name;
    const bool is_shown = name.starts_with("K_") || name.starts_with("C_") ||
                          name.starts_with("stiffness") || name.starts_with("compliance") ||
                          name.ends_with(".compensation") || name == "velocity_min" ||
                          name == "velocity_max" || name == "condition" ||
                          name == "critical_load" || name == "index_force" || name == "iterations";
    if (!is_shown) continue;
    if (auto row = range_row(result, i, map.axes.size(), sizes, units); !row.empty())
      rows.push_back(std::move(row));
  }
  for (const auto& doubt : result.doubts) text += summary_line("UNRESOLVED", doubt);
  if (rows.size() == 1) return text;
  return text + fitted(rows, {Align::left, Align::right, Align::left, Align::right, Align::left},
                       summary_indent + 2);
}

std::string workspace_lines(const StudyResult& result, const UnitLabels& units) {
  const Branch& branch = result.branches.front();
  std::string text = summary_line("region", branch.samples.front().status);
  for (std::size_t i = 0; i < result.quantities.size(); ++i) {
    const double value = branch.samples.front().values[i];
    if (std::isnan(value)) continue;
    const auto unit = unit_label(result.quantities[i].unit, result.lambda_unit, units);
    text += summary_line(result.quantities[i].name,
                         rounded(value, 12) + (unit.empty() ? "" : " " + unit));
  }
  return text;
}

}  // namespace

std::string command_lines(const Case& the_case, const PlannedRun& planned,
                          const StudyResult& result) {
  if (analysis::is_of_critical_points(planned.plan.kind)) return critical_lines(planned, result);
  if (!result.start.found || result.branches.empty())
    return summary_line("start", "NOT FOUND: " + result.start.message);
  if (planned.plan.kind == StudyKind::control) return control_lines(result, the_case.units);
  if (planned.plan.kind == StudyKind::map) return map_lines(planned, result, the_case.units);
  return workspace_lines(result, the_case.units);
}

}  // namespace springfold::io
