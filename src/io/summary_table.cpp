// What was found, for people: one block of text per run.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "result_access.hpp"
#include "springfold/io/results.hpp"
#include "text.hpp"

namespace springfold::io {

namespace {

using analysis::Branch;
using analysis::StudyResult;

constexpr int digits = 10;
constexpr std::size_t indent = 4;
const std::string_view blank_label = "              ";  // width of the label column

/// "    pose          text".
std::string line(std::string_view label, const std::string& text) {
  std::string padded{label};
  padded.resize(std::max(padded.size(), blank_label.size()), ' ');
  std::string whole = std::string(indent, ' ') + padded + text;
  whole.erase(whole.find_last_not_of(' ') + 1);
  return whole + "\n";
}

std::string counted(int count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string start_lines(const analysis::StartReport& start) {
  if (!start.found) {
    const std::string tried =
        start.attempts > 0 ? " after " + counted(start.attempts, "attempt") : "";
    return line("start", "NOT FOUND" + tried + ": " + start.message);
  }
  std::string how = start.method.empty() ? "found" : start.method;
  how += ", " + counted(start.attempts, "attempt") + ", " + counted(start.iterations, "iteration");
  if (!start.chain_iterations.empty()) {
    how += " (per chain:";
    for (const int count : start.chain_iterations) how += " " + std::to_string(count);
    how += ")";
  }
  return line("start", how + ", residual " + rounded(start.residual, 2));
}

/// Columns of the mechanism's bodies ("tool.x") or actuator commands ("leg.drive.rho").
std::vector<std::string> pose_names(const model::Mechanism& mechanism, const StudyResult& result) {
  std::vector<std::string> names;
  for (const auto& body : mechanism.bodies)
    for (const char* coordinate : {".x", ".y", ".z", ".phi", ".rx", ".ry", ".rz"})
      if (column_of(result, body.name + coordinate)) names.push_back(body.name + coordinate);
  return names;
}

std::vector<std::string> command_names(const StudyResult& result) {
  std::vector<std::string> names;
  for (const auto& quantity : result.quantities)
    if (quantity.name.ends_with(".rho")) names.push_back(quantity.name);
  return names;
}

std::string named_values(std::string_view label, const std::vector<std::string>& names,
                         const StudyResult& result, const UnitLabels& units) {
  std::string text;
  const Branch& first = result.branches.front();
  for (const auto& name : names) {
    const auto& quantity = result.quantities[*column_of(result, name)];
    const auto unit = unit_label(quantity.unit, result.lambda_unit, units);
    const double value = value_at(result, first, first.start_row, name);
    text += (text.empty() ? "" : ", ") + name + " = " + rounded(value, digits);
    if (!unit.empty()) text += " " + unit;
  }
  return text.empty() ? text : line(label, text);
}

std::string stiffness_lines(const Matrix& stiffness) {
  if (stiffness.size() == 0) return line("stiffness", "not defined at this point");
  const int shown = stiffness.rows() <= 3 ? digits : 6;
  // Eigenvalues of the symmetric part are real whatever rounding has left of asymmetry.
  const Matrix symmetric = (stiffness + stiffness.transpose()) / 2;
  std::vector<std::vector<std::string>> rows;
  for (Index r = 0; r < stiffness.rows(); ++r) {
    auto& row = rows.emplace_back();
    for (Index c = 0; c < stiffness.cols(); ++c) row.push_back(rounded(stiffness(r, c), shown));
  }
  const std::vector<Align> right(static_cast<std::size_t>(stiffness.cols()), Align::right);
  const std::string table = aligned(rows, right, indent + blank_label.size());
  std::string text = "    stiffness" + table.substr(indent + 9);
  std::string values;
  const Eigen::SelfAdjointEigenSolver<Matrix> solver{symmetric, Eigen::EigenvaluesOnly};
  for (const double value : solver.eigenvalues())
    values += (values.empty() ? "" : ", ") + rounded(value, shown);
  return text + line("eigenvalues", values);
}

/// At a limit or branch point an eigenvalue is zero: the neighbours say what changes there.
std::string index_text(const StudyResult& result, const Branch& branch,
                       const analysis::Event& event, std::string_view name) {
  using analysis::EventKind;
  const bool is_ordinary =
      event.kind == EventKind::user_value || event.kind == EventKind::end_of_range;
  const bool has_neighbours = event.row > 0 && event.row + 1 < branch.samples.size();
  std::size_t first = event.row, second = event.row;
  if (has_two_sides(event))
    second = event.row + 1;
  else if (!is_ordinary && has_neighbours)
    first = event.row - 1, second = event.row + 1;
  const double before = value_at(result, branch, first, name);
  const double after = value_at(result, branch, second, name);
  if (before == after || std::isnan(after)) return rounded(before, digits);
  return rounded(before, digits) + " > " + rounded(after, digits);
}

/// The special points as a table; only the columns that the run has.
std::string point_lines(const StudyResult& result, const Branch& branch) {
  if (branch.events.empty()) return line("points", "none");
  std::vector<std::string> columns;
  for (const char* name : {"lambda", "deflection", "force"})
    if (column_of(result, name)) columns.emplace_back(name);
  std::vector<std::vector<std::string>> rows = {{"points"}};
  rows.front().insert(rows.front().end(), columns.begin(), columns.end());
  std::vector<std::string> indices = {"index"};
  if (column_of(result, "index_force")) indices.emplace_back("index_force");
  rows.front().insert(rows.front().end(), indices.begin(), indices.end());
  for (const auto& event : branch.events) {
    auto& row = rows.emplace_back();
    row.push_back(event.label);
    for (const auto& name : columns)
      row.push_back(rounded(value_at(result, branch, event.row, name), digits));
    const bool is_unresolved = event.kind == analysis::EventKind::unresolved;
    for (const auto& name : indices) row.push_back(index_text(result, branch, event, name));
    row.push_back((is_unresolved ? "UNRESOLVED: " : "") + event.detail);
  }
  std::vector<Align> align(1 + columns.size() + indices.size(), Align::right);
  align.front() = Align::left;
  align.push_back(Align::left);
  rows.front().front().resize(blank_label.size() - 2, ' ');
  return aligned(rows, align, indent);
}

std::string stop_line(std::string_view label, const analysis::Stop& stop) {
  return line(label, (stop.complete ? "" : "STOPPED EARLY: ") + stop.reason);
}

std::string branch_lines(const StudyResult& result, std::size_t b) {
  const Branch& branch = result.branches[b];
  std::string text;
  if (result.branches.size() > 1) text += line("branch " + std::to_string(b + 1), "");
  const std::size_t refused = branch.log.size();
  if (branch.samples.size() < 2 && branch.events.empty() && branch.backward.complete &&
      branch.forward.complete)
    return text;  // an equilibrium study: all is said by the start
  text += line("curve", counted(static_cast<int>(branch.samples.size()), "point") + ", " +
                            counted(static_cast<int>(refused), "refused or cut step"));
  text += point_lines(result, branch);
  return text + stop_line("first row", branch.backward) + stop_line("last row", branch.forward);
}

std::string run_block(const Case& the_case, const StudyResult& result) {
  std::string text = heading_of(result) + "\n" + start_lines(result.start);
  if (!result.start.found || result.branches.empty()) return text;
  if (const PlannedRun* planned = plan_of(the_case, result))
    text += named_values("pose", pose_names(planned->mechanism, result), result, the_case.units);
  text += named_values("commands", command_names(result), result, the_case.units);
  const Branch& first = result.branches.front();
  text += line("index", rounded(value_at(result, first, first.start_row, "index"), digits));
  text += stiffness_lines(result.start.stiffness);
  for (std::size_t b = 0; b < result.branches.size(); ++b) text += branch_lines(result, b);
  return text;
}

}  // namespace

std::string summary_table(const Case& the_case, const std::vector<StudyResult>& results) {
  std::string text;
  if (!the_case.title.empty()) text += the_case.title + "\n";
  for (const auto& result : results)
    text += (text.empty() ? "" : "\n") + run_block(the_case, result);
  for (const auto& planned : the_case.runs)
    if (result_of(results, planned.study, planned.run) == nullptr)
      text += "\n" + planned.study + ", run " + std::to_string(planned.run) + "\n" +
              line("NOT RUN", "interrupted before");
  return text;
}

}  // namespace springfold::io
