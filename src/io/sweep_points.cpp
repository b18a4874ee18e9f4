#include "sweep_points.hpp"

#include <algorithm>
#include <charconv>
#include <tuple>

#include "compared_quantity.hpp"
#include "fitted_table.hpp"
#include "nothing.hpp"
#include "quantity_sizes.hpp"
#include "result_access.hpp"
#include "springfold/io/start_text.hpp"
#include "summary_line.hpp"
#include "sweep_tables.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

using analysis::Branch;
using analysis::Event;
using analysis::StudyResult;

bool is_special_point(const Event& event) {
  return event.kind != analysis::EventKind::end_of_range && is_event_label(event.label);
}

/// "LP2" before "LP10" before "BP1".
std::tuple<std::ptrdiff_t, int> label_rank(const std::string& label) {
  const auto& codes = event_codes();
  const auto code = std::find(codes.begin(), codes.end(), label.substr(0, 2));
  int number = 0;
  std::from_chars(label.data() + 2, label.data() + label.size(), number);
  return {code - codes.begin(), number};
}

void add_labels(const StudyResult& result, std::vector<std::string>& labels) {
  for (const Branch& branch : result.branches)
    for (const Event& event : branch.events)
      if (is_special_point(event) &&
          std::find(labels.begin(), labels.end(), event.label) == labels.end())
        labels.push_back(event.label);
}

/// Where branches meet the point is taken on the first of them.
std::optional<RowPlace> row_with(const StudyResult& result, const std::string& label) {
  for (const Branch& branch : result.branches)
    for (const Event& event : branch.events)
      if (event.label == label) return RowPlace{&branch, event.row};
  return std::nullopt;
}

SweepPoints points_of_study(const Case& the_case, const std::string& study,
                            const std::vector<StudyResult>& results) {
  SweepPoints sweep{.study = study};
  for (const PlannedRun& planned : the_case.runs) {
    if (planned.study != study || !planned.keeps_curves) continue;
    const StudyResult* result = result_of(results, study, planned.run);
    if (result == nullptr || result->row) continue;
    sweep.parameters = planned.varied;
    sweep.runs.push_back({.planned = &planned, .result = result});
    if (start_problem(result->start, &planned).empty()) add_labels(*result, sweep.labels);
  }
  std::sort(sweep.labels.begin(), sweep.labels.end(),
            [](const auto& a, const auto& b) { return label_rank(a) < label_rank(b); });
  for (const std::string& label : sweep.labels) sweep.codes.push_back(label.substr(0, 2));
  for (SweepPoints::Run& run : sweep.runs)
    for (const std::string& label : sweep.labels)
      run.places.push_back(start_problem(run.result->start, run.planned).empty()
                               ? row_with(*run.result, label)
                               : std::nullopt);
  return sweep;
}

std::string pair_of(std::string first, const char* between, const std::string& second) {
  first += between;
  return first += second;
}

/// Quantities that any run has, of these.
std::vector<std::string> point_columns(const SweepPoints& sweep) {
  std::vector<std::string> columns;
  for (const char* name : {"lambda", "deflection", "force"})
    if (std::any_of(sweep.runs.begin(), sweep.runs.end(),
                    [name](const auto& run) { return column_of(*run.result, name).has_value(); }))
      columns.emplace_back(name);
  return columns;
}

/// A number for people; a dash where there is none.
/// @param sizes  of the run's quantities
std::string point_cell(const SweepPoints::Run& run, const std::vector<double>& sizes,
                       std::size_t point, const std::string& name) {
  const auto& place = run.places[point];
  const auto column = column_of(*run.result, name);
  if (!place || !column) return "-";
  constexpr int digits = 7;  // the blocks of the runs have more
  return rounded(shown_in(sizes, *column, place->branch->samples[place->row].values[*column]),
                 digits);
}

}  // namespace

std::vector<SweepPoints> sweep_points_of(const Case& the_case,
                                         const std::vector<StudyResult>& results) {
  std::vector<SweepPoints> sweeps;
  std::vector<std::string> seen;
  for (const PlannedRun& planned : the_case.runs) {
    const bool is_new = std::find(seen.begin(), seen.end(), planned.study) == seen.end();
    if (!is_new || planned.varied.empty()) continue;
    seen.push_back(planned.study);
    SweepPoints sweep = points_of_study(the_case, planned.study, results);
    if (sweep.runs.size() > 1 && !sweep.labels.empty()) sweeps.push_back(std::move(sweep));
  }
  return sweeps;
}

std::vector<std::string> sweep_points_files(const Case& the_case,
                                            const std::vector<SweepPoints>& sweeps) {
  UniqueNames names;
  for (const SweepTable& sweep : the_case.sweeps) names.make(safe_file_name(sweep.study));
  std::vector<std::string> files;
  files.reserve(sweeps.size());
  for (const SweepPoints& sweep : sweeps)
    files.push_back("sweeps/" + names.make(safe_file_name(sweep.study) + "-points") + ".csv");
  return files;
}

std::string sweep_points_csv(const SweepPoints& sweep) {
  const std::vector<std::string> columns = point_columns(sweep);
  std::string csv = "run";
  for (const std::string& name : sweep.parameters) csv += "," + csv_text(parameter_prefix + name);
  for (const std::string& label : sweep.labels)
    for (const std::string& column : columns) csv += "," + csv_text(pair_of(label, ".", column));
  csv += ",status\n";
  for (const SweepPoints::Run& run : sweep.runs) {
    csv += std::to_string(run.planned->run);
    for (const std::string& name : sweep.parameters)
      csv += "," + csv_number(varied_value(run.planned, name));
    for (const auto& place : run.places)
      for (const std::string& column : columns)
        csv += "," + csv_number(place ? value_at(*run.result, *place->branch, place->row, column)
                                      : nothing);
    csv += "," + csv_text(run_status(*run.planned, *run.result)) + "\n";
  }
  return csv;
}

std::string sweep_points_lines(const SweepPoints& sweep, const std::string& file) {
  constexpr std::size_t most_rows = 40;
  std::string parameters;
  for (const std::string& name : sweep.parameters)
    parameters += (parameters.empty() ? "" : ", ") + name;
  std::string text = shown(sweep.study) + ", special points over " + shown(parameters) + "\n" +
                     summary_line("table", file);
  if (sweep.runs.size() > most_rows) return text;
  const std::vector<std::string> columns = point_columns(sweep);
  if (columns.empty()) return text;
  const std::string quantity = columns.back() == "deflection" ? columns.front() : columns.back();
  std::vector<std::vector<std::string>> rows{sweep.parameters};
  for (const std::string& label : sweep.labels)
    rows.front().push_back(pair_of(label, " ", shown_name(*sweep.runs.front().result, quantity)));
  for (const SweepPoints::Run& run : sweep.runs) {
    auto& row = rows.emplace_back();
    for (const std::string& name : sweep.parameters)
      row.push_back(rounded(varied_value(run.planned, name), summary_digits));
    const std::vector<double> sizes = quantity_sizes(*run.result);
    for (std::size_t i = 0; i < sweep.labels.size(); ++i)
      row.push_back(point_cell(run, sizes, i, quantity));
  }
  return text + fitted(rows, std::vector<Align>(rows.front().size(), Align::right), summary_indent);
}

}  // namespace springfold::io
