#include "sweep_tables.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compared_quantity.hpp"
#include "springfold/io/start_text.hpp"
#include "springfold/io/sweep.hpp"
#include "summary_line.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

using analysis::StudyResult;

/// Rows of a study in the order of its runs.
template <class Visit>
void for_each_run(const Case& the_case, const SweepTable& sweep,
                  const std::vector<StudyResult>& results, const Visit& visit) {
  std::vector<const StudyResult*> by_run;
  for (const StudyResult& result : results) {
    if (result.study != sweep.study) continue;
    const auto run = static_cast<std::size_t>(result.run);
    if (by_run.size() < run) by_run.resize(run, nullptr);
    by_run[run - 1] = &result;
  }
  for (const PlannedRun& planned : the_case.runs) {
    if (planned.study != sweep.study) continue;
    const auto run = static_cast<std::size_t>(planned.run);
    visit(planned, run <= by_run.size() ? by_run[run - 1] : nullptr);
  }
}

}  // namespace

std::string run_status(const PlannedRun& planned, const StudyResult& result) {
  const auto plain = [](std::string text) {
    for (char& c : text)
      if (static_cast<unsigned char>(c) < ' ') c = ' ';
    return text;
  };
  const std::string problem = start_problem(result.start, &planned);
  if (!result.start.found) return plain("no start point: " + problem);
  if (!problem.empty()) return plain("nothing was traced: " + problem);
  for (const analysis::Branch& branch : result.branches)
    for (const auto* stop : {&branch.backward, &branch.forward})
      if (!stop->complete) return plain("stopped early: " + stop->reason);
  if (!result.doubts.empty()) return plain("unresolved: " + result.doubts.front());
  return analysis::complete(result) ? "complete" : "has points that could not be resolved";
}

analysis::SweepRow sweep_row(const Case& the_case, const PlannedRun& planned,
                             const StudyResult& result) {
  if (result.row) return *result.row;
  analysis::SweepRow row;
  row.status = run_status(planned, result);
  row.complete = row.status == "complete";
  for (const ExpectedValue& column : planned.columns)
    row.values.push_back(column.factor * found_value(column, result));
  for (const ExpectedValue& value : the_case.expected.values)
    if (value.study == planned.study && value.run == planned.run)
      row.compared.push_back(value.factor * found_value(value, result));
  return row;
}

StudyResult row_alone(const Case& the_case, const PlannedRun& planned, const StudyResult& result) {
  StudyResult kept;
  kept.study = planned.study;
  kept.run = planned.run;
  kept.label = planned.label;
  kept.start.found = result.start.found;
  kept.seconds = result.seconds;
  kept.row = std::make_shared<const analysis::SweepRow>(sweep_row(the_case, planned, result));
  return kept;
}

std::string sweep_csv(const Case& the_case, const SweepTable& sweep,
                      const std::vector<StudyResult>& results) {
  std::string csv = "run";
  for (const auto* names : {&sweep.parameters, &sweep.columns})
    for (const std::string& name : *names) csv += "," + csv_text(name);
  csv += ",status\n";
  for_each_run(the_case, sweep, results, [&](const PlannedRun& planned, const StudyResult* result) {
    if (result == nullptr) return;
    const analysis::SweepRow row = sweep_row(the_case, planned, *result);
    csv += std::to_string(planned.run);
    for (const std::string& name : sweep.parameters)
      csv += "," + csv_number(planned.parameters.at(name));
    for (const double value : row.values) csv += "," + csv_number(value);
    csv += "," + csv_text(row.status) + "\n";
  });
  return csv;
}

std::vector<std::string> sweep_files(const Case& the_case) {
  std::vector<std::string> files;
  UniqueNames names;
  for (const SweepTable& sweep : the_case.sweeps)
    files.push_back("sweeps/" + names.make(safe_file_name(sweep.study)) + ".csv");
  return files;
}

SweepCounts counts_of(const Case& the_case, const SweepTable& sweep,
                      const std::vector<StudyResult>& results) {
  SweepCounts counts;
  for_each_run(the_case, sweep, results, [&](const PlannedRun&, const StudyResult* result) {
    ++counts.planned;
    if (result == nullptr) return;
    ++counts.done;
    if (analysis::complete(*result)) ++counts.complete;
  });
  return counts;
}

std::vector<std::string> sweep_words(const Case& the_case, const SweepTable& sweep,
                                     const std::vector<StudyResult>& results) {
  struct Reached {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    int count = 0;
  };
  constexpr std::size_t most = 2;
  constexpr int outlined = 4;  // digits
  std::vector<Reached> ranges(std::min(most, sweep.columns.size()));
  int runs = 0;
  for_each_run(the_case, sweep, results, [&](const PlannedRun& planned, const StudyResult* result) {
    if (result == nullptr) return;
    ++runs;
    const analysis::SweepRow row = sweep_row(the_case, planned, *result);
    for (std::size_t i = 0; i < std::min(ranges.size(), row.values.size()); ++i) {
      const double value = row.values[i];
      if (!std::isfinite(value)) continue;
      ranges[i].low = std::min(ranges[i].low, value);
      ranges[i].high = std::max(ranges[i].high, value);
      ++ranges[i].count;
    }
  });
  std::vector<std::string> words;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const Reached& range = ranges[i];
    const std::string name = shown(sweep.columns[i]);
    words.push_back(range.count == 0
                        ? name + " in none of the runs"
                        : name + " from " + rounded(range.low, outlined) + " to " +
                              rounded(range.high, outlined) +
                              (range.count < runs ? ", in " + std::to_string(range.count) + " of " +
                                                        counted(runs, "run")
                                                  : std::string{}));
  }
  return words;
}

}  // namespace springfold::io
