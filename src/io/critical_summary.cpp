#include "critical_summary.hpp"

#include <algorithm>
#include <cmath>

#include "design_summary.hpp"
#include "fitted_table.hpp"
#include "quantity_sizes.hpp"
#include "result_access.hpp"
#include "summary_line.hpp"
#include "summary_start.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

using analysis::Branch;
using analysis::StudyResult;

std::string number_cell(double value) {
  return std::isnan(value) ? "" : rounded(value, summary_digits);
}

/// The special points of a critical curve, with the parameter.
std::string point_table(const StudyResult& result, const Branch& branch,
                        const std::string& parameter) {
  std::vector<std::string> columns{parameter};
  for (const char* name : {"lambda", "deflection", "force"})
    if (column_of(result, name)) columns.emplace_back(name);
  const std::vector<double> sizes = quantity_sizes(result);
  std::vector<std::vector<std::string>> rows{{"points"}};
  for (const std::string& name : columns) rows[0].push_back(shown_name(result, name));
  for (const auto& event : branch.events) {
    auto& row = rows.emplace_back(std::vector<std::string>{event.label});
    for (const std::string& name : columns)
      row.push_back(number_cell(shown_in(sizes, column_of(result, name).value_or(sizes.size()),
                                         value_at(result, branch, event.row, name))));
    const bool unresolved = event.kind == analysis::EventKind::unresolved;
    row.push_back(unresolved ? unresolved_text(event.detail) : event.detail);
  }
  std::vector<Align> align(1 + columns.size(), Align::right);
  align.front() = Align::left;
  align.push_back(Align::left);
  return fitted(rows, align, summary_indent);
}

/// d(lambda)/d(parameter) of every special point, one row per parameter.
std::string rate_table(const StudyResult& result, const Branch& branch) {
  std::vector<std::vector<std::string>> rows{{"d(lambda)/d(parameter)"}};
  std::vector<const analysis::Event*> points;
  for (const auto& event : branch.events) {
    if (event.kind == analysis::EventKind::end_of_range) continue;
    points.push_back(&event);
    rows[0].push_back(event.label);
  }
  const std::string prefix = "d(lambda)/d(";
  for (const auto& quantity : result.quantities) {
    if (!quantity.name.starts_with(prefix)) continue;
    auto& row = rows.emplace_back(std::vector<std::string>{
        quantity.name.substr(prefix.size(), quantity.name.size() - prefix.size() - 1)});
    for (const auto* event : points) {
      const double rate = value_at(result, branch, event->row, quantity.name);
      row.push_back(std::isnan(rate) ? "-" : rounded(rate, summary_digits));
    }
  }
  std::vector<Align> align(rows[0].size(), Align::right);
  align.front() = Align::left;
  std::string text = fitted(rows, align, summary_indent);
  for (const auto* event : points) text += summary_line(event->label, event->detail);
  return text;
}

/// How imperfections change the critical loads: lambda moves by coefficient |e|^exponent; one row per point and
/// parameter, and one for the worst combination. Nothing where the study has no such columns.
std::string law_table(const StudyResult& result, const Branch& branch) {
  std::vector<std::vector<std::string>> rows{{"imperfections", "of", "exponent", "coefficient"}};
  const std::string prefix = "exponent(";
  for (const auto& event : branch.events) {
    if (event.kind == analysis::EventKind::end_of_range) continue;
    const auto add = [&](const std::string& parameter, const std::string& exponent,
                         const std::string& coefficient) {
      if (!column_of(result, exponent)) return;
      const double power = value_at(result, branch, event.row, exponent);
      const double factor = value_at(result, branch, event.row, coefficient);
      rows.push_back({event.label, parameter, std::isnan(power) ? "-" : rounded(power, 4),
                      std::isnan(factor) ? "-" : rounded(factor, summary_digits)});
    };
    for (const auto& quantity : result.quantities) {
      if (!quantity.name.starts_with(prefix)) continue;
      const std::string of = quantity.name.substr(prefix.size());  // "e)"
      add(of.substr(0, of.size() - 1), quantity.name, "coefficient(" + of);
    }
    add("worst", "worst.exponent", "worst.coefficient");
  }
  if (rows.size() == 1) return {};
  return fitted(rows, {Align::left, Align::left, Align::right, Align::right}, summary_indent);
}

std::string doubts_of(const StudyResult& result) {
  std::string text;
  for (const auto& doubt : result.doubts) text += summary_line("UNRESOLVED", doubt);
  return text;
}

/// "at UZ1 of study "folds": kv = 0.25"; nothing of curves that begin on the path from the start.
std::string beginning_of(const PlannedRun& planned, const StudyResult& result) {
  if (result.branches.empty() || planned.plan.critical.parameters.empty()) return {};
  std::string held;
  for (const std::string& name : planned.plan.critical.parameters)
    held += (held.empty() ? ": " : ", ") + name + " = " +
            number_cell(value_at(result, result.branches.front(), 0, name));
  return summary_line("begins", result.start.method + held);
}

}  // namespace

std::string critical_lines(const PlannedRun& planned, const StudyResult& result) {
  if (!result.start.found) return summary_line("start", "NOT FOUND: " + result.start.message);
  std::string text = loads_without_potential(result);
  if (!text.empty())
    text += summary_line("",
                         "stability is lost statically where det T vanishes (T: tangent stiffness, "
                         "not symmetric); flutter is not examined: paths without such a loss may "
                         "be unstable");
  if (result.threshold)
    text += summary_line(
        "threshold",
        result.threshold->message + (result.threshold->verified ? "; traced again beside it" : ""));
  if (result.design) return design_lines(*result.design) + doubts_of(result);
  if (planned.plan.kind == analysis::StudyKind::critical_curve && planned.history.earlier)
    text += beginning_of(planned, result);
  const std::string& parameter = planned.plan.critical.parameter;
  const bool is_curve = planned.plan.kind != analysis::StudyKind::sensitivity;
  for (const Branch& branch : result.branches) {
    if (!is_curve) {
      text += rate_table(result, branch) + law_table(result, branch);
      continue;
    }
    text += summary_line("curve", std::to_string(branch.samples.size()) +
                                      (branch.samples.size() == 1 ? " point" : " points"));
    text += point_table(result, branch, parameter);
    for (const auto* stop : {&branch.backward, &branch.forward})
      if (!stop->complete) text += summary_line("STOPPED", stop->reason);
  }
  return text + doubts_of(result);
}

}  // namespace springfold::io
