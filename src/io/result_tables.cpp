#include "result_tables.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "counts_beside.hpp"
#include "result_access.hpp"
#include "text.hpp"

namespace springfold::io {

namespace {

using analysis::Branch;
using analysis::StudyResult;

/// Names of all quantities of all results, in order of first appearance.
std::vector<std::string> all_quantities(const std::vector<StudyResult>& results) {
  std::vector<std::string> names;
  for (const auto& result : results)
    for (const auto& quantity : result.quantities)
      if (std::find(names.begin(), names.end(), quantity.name) == names.end())
        names.push_back(quantity.name);
  return names;
}

/// Numbers of rows, each with a comma behind it. Digits that stand in the row before are copied: many columns
/// change rarely.
class CsvNumbers {
 public:
  explicit CsvNumbers(std::size_t columns) : last_(columns) {}

  void append(std::string& csv, const std::vector<double>& values) {
    last_.resize(std::max(last_.size(), values.size()));
    for (std::size_t i = 0; i < values.size(); ++i) {
      Cell& last = last_[i];
      const auto bits = std::bit_cast<std::uint64_t>(values[i]);
      const std::size_t begin = csv.size();
      if (last.length > 0 && last.bits == bits) {
        csv.append(csv, last.begin, last.length);
      } else {
        append_csv_number(csv, values[i]);
        csv += ',';
      }
      last = {bits, begin, csv.size() - begin};
    }
  }

 private:
  struct Cell {
    std::uint64_t bits = 0;
    std::size_t begin = 0, length = 0;
  };
  std::vector<Cell> last_;
};

/// Per row the largest count of the pieces where springs rest and the state is unstable, elsewhere nothing; empty
/// where there is no such row.
std::vector<std::optional<int>> largest_counts(const Branch& branch) {
  std::vector<std::optional<int>> counts;
  for (const analysis::RestingRows& rows : branch.resting) {
    if (rows.stable != analysis::RestingRows::Stable::no) continue;
    counts.resize(branch.samples.size());
    for (std::size_t row = rows.first; row <= rows.last && row < counts.size(); ++row)
      counts[row] = rows.most;
  }
  return counts;
}

/// "study,run,label,branch," of a row.
std::string row_start(const StudyResult& result, std::size_t branch) {
  return csv_text(result.study) + "," + std::to_string(result.run) + "," + csv_text(result.label) +
         "," + std::to_string(branch + 1) + ",";
}

std::vector<std::string> counts_among(const std::vector<std::string>& names) {
  std::vector<std::string> counts;
  for (const std::string_view name : count_columns)
    if (std::find(names.begin(), names.end(), name) != names.end()) counts.emplace_back(name);
  return counts;
}

}  // namespace

std::string branch_csv(const StudyResult& result, const Branch& branch) {
  return *branch_csv(result, branch, {});
}

std::optional<std::string> branch_csv(const StudyResult& result, const Branch& branch,
                                      const std::function<bool()>& is_over) {
  std::string csv;
  // Targets and nodes say how they are; points of curves have nothing to say.
  const bool has_status =
      std::any_of(branch.samples.begin(), branch.samples.end(),
                  [](const analysis::Sample& sample) { return !sample.status.empty(); });
  for (const auto& quantity : result.quantities) csv += csv_text(quantity.name) + ",";
  const std::vector<std::optional<int>> largest = largest_counts(branch);
  if (!largest.empty()) csv += "index_largest,";
  csv += has_status ? "piece,event,status\n" : "piece,event\n";
  constexpr std::size_t usual = 18;  // characters of a number and its comma
  csv.reserve(csv.size() + branch.samples.size() * (usual * result.quantities.size() + 8));
  CsvNumbers numbers{result.quantities.size()};
  constexpr std::size_t block = 1000;  // rows: a few milliseconds
  std::size_t rows = 0;
  for (const auto& sample : branch.samples) {
    const std::size_t row = rows++;
    if (rows % block == 0 && is_over && is_over()) return std::nullopt;
    numbers.append(csv, sample.values);
    if (!largest.empty()) csv += (largest[row] ? std::to_string(*largest[row]) : "") + ",";
    append_csv_text(csv, sample.piece);
    csv += ',';
    append_csv_text(csv, sample.event);
    if (has_status) append_csv_text(csv += ',', sample.status);
    csv += '\n';
  }
  return csv;
}

std::string equilibria_csv(const StudyResult& result) {
  const auto is_shown = [](const analysis::Quantity& q) {
    return q.name != "s" && q.name != "lambda" && q.name != "force" && q.name != "deflection";
  };
  std::string csv = "equilibrium,start,potential,";
  for (const auto& quantity : result.quantities)
    if (is_shown(quantity)) csv += csv_text(quantity.name) + ",";
  csv += "piece,note\n";
  for (const auto& e : result.equilibria->list) {
    csv += e.label + "," + (e.is_start ? "true" : "false") + "," + csv_number(e.potential) + ",";
    for (std::size_t q = 0; q < result.quantities.size(); ++q)
      if (is_shown(result.quantities[q])) csv += csv_number(e.sample.values[q]) + ",";
    csv += csv_text(e.sample.piece) + "," + csv_text(e.note) + "\n";
  }
  return csv;
}

std::vector<std::string> equilibria_files(const std::vector<StudyResult>& results) {
  std::vector<std::string> files;
  UniqueNames names;
  for (const auto& result : results) {
    const std::string stem = safe_file_name(result.study) + "-" + std::to_string(result.run);
    files.push_back(result.equilibria ? "equilibria/" + names.make(stem) + ".csv" : "");
  }
  return files;
}

std::string events_csv(const Case& the_case, const std::vector<StudyResult>& results) {
  const auto names = all_quantities(results);
  const auto parameters = varied_parameters(the_case);
  std::string csv = "study,run,label,branch,event,code,detail,row";
  for (const auto& name : parameters) csv += "," + csv_text(parameter_prefix + name);
  for (const auto& name : names) csv += "," + csv_text(name);
  const auto counts = counts_among(names);
  for (const auto& name : counts) csv += "," + name + "_before," + name + "_after";
  csv += "\n";
  for (const auto& result : results) {
    std::string values;
    for (const auto& name : parameters)
      values += "," + csv_number(varied_value(plan_of(the_case, result), name));
    for (std::size_t b = 0; b < result.branches.size(); ++b) {
      const Branch& branch = result.branches[b];
      for (const auto& event : branch.events) {
        csv += row_start(result, b) + csv_text(event.label) + "," + analysis::code_of(event.kind) +
               "," + csv_text(event.detail) + "," + std::to_string(event.row) + values;
        for (const auto& name : names)
          csv += "," + csv_number(value_at(result, branch, event.row, name));
        for (const auto& name : counts) {
          const CountsBeside beside = counts_beside(result, branch, event, name);
          csv += "," + csv_number(beside.before) + "," + csv_number(beside.after);
        }
        csv += "\n";
      }
    }
  }
  return csv;
}

std::string steps_csv(const std::vector<StudyResult>& results) {
  std::string csv = "study,run,label,branch,s,step,reason\n";
  for (const auto& result : results)
    for (std::size_t b = 0; b < result.branches.size(); ++b)
      for (const auto& note : result.branches[b].log)
        csv += row_start(result, b) + csv_number(note.s) + "," + csv_number(note.step) + "," +
               csv_text(note.reason) + "\n";
  return csv;
}

std::vector<std::vector<std::string>> branch_files(const std::vector<StudyResult>& results) {
  std::vector<std::vector<std::string>> files;
  UniqueNames names;
  for (const auto& result : results) {
    auto& own = files.emplace_back();
    const std::string stem = safe_file_name(result.study) + "-" + std::to_string(result.run);
    for (std::size_t b = 0; b < result.branches.size(); ++b) {
      const std::string suffix = b == 0 ? "" : "-" + std::to_string(b + 1);
      own.push_back("branches/" + names.make(stem + suffix) + ".csv");
    }
  }
  return files;
}

}  // namespace springfold::io
