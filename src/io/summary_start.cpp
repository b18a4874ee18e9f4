#include "summary_start.hpp"

#include <algorithm>
#include <cmath>

#include "quantity_sizes.hpp"
#include "result_access.hpp"
#include "springfold/core/rounding.hpp"
#include "springfold/io/start_text.hpp"
#include "summary_line.hpp"
#include "text.hpp"

namespace springfold::io {

namespace {

using analysis::StudyResult;

}  // namespace
std::string start_lines(const analysis::StartReport& start, const PlannedRun* planned) {
  if (!start.found) {
    const std::string tried =
        start.attempts > 0 ? " after " + counted(start.attempts, "attempt") : "";
    return summary_line("start", "NOT FOUND" + tried + ": " + start_problem(start, planned));
  }
  std::string how = start.method.empty() ? "found" : start.method;
  how += ", " + counted(start.attempts, "attempt") + ", " + counted(start.iterations, "iteration");
  if (!start.chain_iterations.empty()) {
    how += " (per chain:";
    for (const int count : start.chain_iterations) how += " " + std::to_string(count);
    how += ")";
  }
  std::string text = summary_line("start", how + ", residual " + rounded(start.residual, 2));
  if (start.moved > 1e-9)
    text += summary_line("", "moved by " + rounded(start.moved, 3) + " (" + start.moved_most +
                                 ") from the guess, whose residual is " +
                                 rounded(start.guess_residual, 2));
  return text;
}

std::string loads_without_potential(const StudyResult& result) {
  std::string loads;
  for (const auto& load : result.non_conservative) loads += (loads.empty() ? "" : ", ") + load;
  return loads.empty() ? "" : summary_line("load", "NON-CONSERVATIVE: " + loads);
}

std::string caution_lines(const StudyResult& result) {
  std::string text = loads_without_potential(result);
  if (!result.non_conservative.empty()) {
    text += summary_line(
        "",
        "no potential: unstable modes are not counted; static bifurcations are zeros of "
        "det T");
    text +=
        summary_line("",
                     "(T: tangent stiffness, not symmetric); flutter is a matter of masses and not "
                     "examined");
    std::string values;
    for (const auto& [real, imaginary] : result.start.tangent)
      values += (values.empty() ? "" : ", ") + rounded(real, summary_digits) +
                (imaginary == 0 ? ""
                                : (imaginary < 0 ? " - " : " + ") +
                                      rounded(std::abs(imaginary), summary_digits) + "i");
    if (!values.empty()) text += summary_line("", "eigenvalues of T: " + values);
  }
  const int zeros = result.start.zero_modes;
  if (zeros > 0)
    text += summary_line("singular",
                         "the stiffness is singular: " + counted(zeros, "motion") +
                             " without stiffness (neutral equilibrium)" +
                             (result.start.free_motions.empty()
                                  ? ""
                                  : ": nothing resists a motion of " + result.start.free_motions));
  const analysis::RedundantClosures& redundant = result.start.redundant;
  if (redundant.count == 0) return text;
  std::string chains;
  for (const auto& chain : redundant.chains) chains += (chains.empty() ? "" : ", ") + chain;
  text += summary_line("redundant", std::to_string(redundant.count) + " of " +
                                        counted(redundant.of, "closure equation") +
                                        ", among chains " + chains);
  return text +
         summary_line("",
                      "statics does not determine their wrenches: those of smallest norm are "
                      "shown; singular values " +
                          rounded(redundant.largest_dropped, 2) + " dropped, " +
                          rounded(redundant.smallest_kept, 2) + " kept");
}

namespace {

/// A matrix under its name.
std::string matrix_lines(const std::string& name, const Matrix& matrix) {
  const int shown = matrix.rows() <= 3 ? summary_digits : 6;
  const Matrix entries = shown_matrix(matrix);
  std::vector<std::vector<std::string>> rows;
  for (Index r = 0; r < matrix.rows(); ++r) {
    auto& row = rows.emplace_back();
    for (Index c = 0; c < matrix.cols(); ++c) row.push_back(rounded(entries(r, c), shown));
  }
  const std::vector<Align> right(static_cast<std::size_t>(matrix.cols()), Align::right);
  const std::string table = aligned(rows, right, summary_indent + summary_label_width);
  return std::string(summary_indent, ' ') + name + table.substr(summary_indent + name.size());
}

/// The columns K_eig1, ... of the start: the same eigenvalues as in the tables.
std::string eigenvalue_line(const StudyResult& result) {
  if (result.branches.empty() || result.branches.front().samples.empty()) return {};
  const analysis::Branch& first = result.branches.front();
  const std::vector<double>& row = first.samples[first.start_row].values;
  const std::vector<double> along = quantity_sizes(result);
  std::vector<double> eigenvalues;
  double largest = 0, size = 0;
  for (int i = 1; const auto column = column_of(result, "K_eig" + std::to_string(i)); ++i) {
    const double value = row[*column];
    eigenvalues.push_back(value);
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
    if (*column < along.size()) size = std::max(size, along[*column]);
  }
  // Against each other: along the curve they may grow by orders of magnitude. All of them may be rounding of what they
  // are there.
  const std::vector<double> sizes(eigenvalues.size(),
                                  largest > 4 * few_roundings * size ? largest : size);
  std::string values;
  for (std::size_t i = 0; i < eigenvalues.size(); ++i) {
    const double value = shown_in(sizes, i, eigenvalues[i]);
    values += (values.empty() ? "" : ", ") +
              (std::isnan(value) ? std::string("infinite") : rounded(value, summary_digits));
  }
  const bool known = values.find_first_of("0123456789") != std::string::npos;
  return known ? summary_line("K_eig", values) : "";
}

}  // namespace

std::string stiffness_lines(const StudyResult& result) {
  const analysis::StartReport& start = result.start;
  if (!start.sides.empty()) {  // one matrix would be that of one side
    std::string text;
    for (const analysis::StartSide& side : start.sides) {
      text +=
          summary_line("segments", side.piece + ", springs on their thresholds taken on this side");
      if (side.stiffness.size() > 0)
        text += matrix_lines("stiffness", side.stiffness);
      else if (side.compliance.size() > 0)
        text += matrix_lines("compliance", side.compliance);
      else
        text += summary_line("stiffness", "not defined on this side");
    }
    return text;
  }
  if (start.stiffness.size() > 0)
    return matrix_lines("stiffness", start.stiffness) + eigenvalue_line(result);
  if (start.compliance.size() == 0)
    return summary_line(
        "stiffness", "not defined here: rigid in some direction, or a chain is critical by itself");
  return summary_line("stiffness",
                      "infinite in some direction: the body is rigid there; its compliance:") +
         matrix_lines("compliance", start.compliance) + eigenvalue_line(result);
}

}  // namespace springfold::io
