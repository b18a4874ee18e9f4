#include "springfold/io/verification.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "comparison_text.hpp"
#include "json_text.hpp"
#include "result_access.hpp"
#include "springfold/io/shown_text.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string quantity_text(const ExpectedValue& expected) {
  return expected.group.empty() ? expected.name : expected.group + ": " + expected.name;
}

/// Why a run is not complete: the first reason that there is.
std::string fault_of(const analysis::StudyResult& result) {
  if (result.row) return result.row->complete ? "" : result.row->status;
  if (!result.start.found) return "no trustworthy start point: " + result.start.message;
  for (const auto& branch : result.branches)
    for (const auto* stop : {&branch.backward, &branch.forward})
      if (!stop->complete) return "stopped early: " + stop->reason;
  if (!result.doubts.empty()) return "unresolved: " + result.doubts.front();
  return analysis::complete(result) ? "" : "has points that could not be resolved";
}

std::size_t holding(const VerifiedCase& verified) {
  return static_cast<std::size_t>(
      std::count_if(verified.comparisons.begin(), verified.comparisons.end(),
                    [](const Comparison& comparison) { return comparison.holds; }));
}

}  // namespace

std::vector<std::string> faults_of(const VerifiedCase& verified) {
  std::vector<std::string> faults;
  for (const PlannedRun& planned : verified.the_case.runs) {
    const auto* result = result_of(verified.results, planned.study, planned.run);
    if (result == nullptr) {
      faults.push_back(planned.study + ", run " + std::to_string(planned.run) + ": was not run");
    } else if (const std::string fault = fault_of(*result); !fault.empty()) {
      faults.push_back(heading_of(*result) + ": " + fault);
    }
  }
  if (verified.comparisons.empty()) faults.emplace_back("has no expected values");
  return faults;
}

bool holds(const VerifiedCase& verified) {
  return holding(verified) == verified.comparisons.size() && faults_of(verified).empty();
}

std::string verification_table(const std::vector<VerifiedCase>& cases) {
  constexpr Align l = Align::left, r = Align::right;
  std::vector<std::vector<std::string>> rows = {
      {"case", "quantity", "ours", "reference", "difference", "tolerance", "", "source"}};
  std::string faults;
  std::size_t values = 0, held = 0, whole = 0;
  for (const VerifiedCase& verified : cases) {
    for (const Comparison& comparison : verified.comparisons) {
      auto row = comparison_cells(comparison);
      row.front() = quantity_text(comparison.expected);
      row.insert(row.begin(), verified.name);
      rows.push_back(std::move(row));
    }
    for (const std::string& fault : faults_of(verified))
      faults += "NOT OK  " + shown(verified.name + ": " + fault) + "\n";
    values += verified.comparisons.size();
    held += holding(verified);
    whole += holds(verified) ? 1 : 0;
  }
  return aligned(rows, {l, l, r, r, r, r, l, l}, 0) + (faults.empty() ? "" : "\n" + faults) + "\n" +
         std::to_string(whole) + " of " + counted(cases.size(), "case") + " hold" + ", " +
         std::to_string(held) + " of " + counted(values, "value") + "\n";
}

std::string verification_csv(const std::vector<VerifiedCase>& cases) {
  std::string csv =
      "case,group,name,study,run,at,quantity,ours,reference,difference,tolerance,compare,holds,"
      "source\n";
  for (const VerifiedCase& verified : cases)
    for (const auto& [expected, ours, is_held, is_interrupted] : verified.comparisons)
      csv += csv_text(verified.name) + "," + csv_text(expected.group) + "," +
             csv_text(expected.name) + "," + csv_text(expected.study) + "," +
             std::to_string(expected.run) + "," + csv_text(expected.at) + "," +
             csv_text(expected.quantity) + "," + csv_number(ours) + "," +
             csv_number(expected.expected) + "," + csv_number(ours - expected.expected) + "," +
             csv_number(expected.tolerance) + "," + word_of(expected.agreement) + "," +
             (is_held ? "true" : "false") + "," + csv_text(expected.source) + "\n";
  return csv;
}

std::string verification_json(const std::vector<VerifiedCase>& cases) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const VerifiedCase& verified : cases) {
    nlohmann::ordered_json comparisons = nlohmann::ordered_json::array();
    for (const Comparison& comparison : verified.comparisons)
      comparisons.push_back(comparison_json(comparison));
    list.push_back({{"case", verified.name},
                    {"title", verified.the_case.title},
                    {"hash", verified.the_case.hash},
                    {"holds", holds(verified)},
                    {"faults", faults_of(verified)},
                    {"comparisons", std::move(comparisons)}});
  }
  return json_text(
      {{"schema_version", 1},
       {"holds", std::all_of(cases.begin(), cases.end(), [](const auto& c) { return holds(c); })},
       {"cases", std::move(list)}});
}

}  // namespace springfold::io
