#include "result_access.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "nothing.hpp"
#include "springfold/continuation/options.hpp"
#include "springfold/io/shown_text.hpp"

namespace springfold::io {

namespace {

using analysis::EventKind;
using analysis::Unit;

std::string unit_text(Unit unit, const UnitLabels& labels) {
  switch (unit) {
    case Unit::length:
      return labels.length;
    case Unit::angle:
      return "rad";
    case Unit::force:
      return labels.force;
    case Unit::moment:
    case Unit::energy:
      return labels.force + "·" + labels.length;
    case Unit::stiffness:
      return labels.force + "/" + labels.length;
    case Unit::rotational_stiffness:
      return labels.force + "·" + labels.length + "/rad";
    case Unit::compliance:
      return labels.length + "/" + labels.force;
    case Unit::rotational_compliance:
      return "rad/(" + labels.force + "·" + labels.length + ")";
    case Unit::area:
      return labels.length + "²";
    case Unit::volume:
      return labels.length + "³";
    case Unit::pressure:
      return labels.force + "/" + labels.length + "²";
    case Unit::none:
    case Unit::lambda:
      return "";
  }
  return "";
}

}  // namespace

std::optional<std::size_t> column_of(const analysis::StudyResult& result, std::string_view name) {
  const auto& all = result.quantities;
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& q) { return q.name == name; });
  if (found == all.end()) return std::nullopt;
  return static_cast<std::size_t>(found - all.begin());
}

double value_at(const analysis::StudyResult& result, const analysis::Branch& branch,
                std::size_t row, std::string_view quantity) {
  const auto column = column_of(result, quantity);
  const bool exists =
      column && row < branch.samples.size() && *column < branch.samples[row].values.size();
  return exists ? branch.samples[row].values[*column] : std::numeric_limits<double>::quiet_NaN();
}

std::string shown_name(const analysis::StudyResult& result, const std::string& quantity) {
  const auto column = column_of(result, quantity);
  if (!column) return quantity;
  const analysis::Unit unit = result.quantities[*column].unit == analysis::Unit::lambda
                                  ? result.lambda_unit
                                  : result.quantities[*column].unit;
  if (quantity == "force" && unit == analysis::Unit::moment) return "moment";
  if (quantity == "deflection" && unit == analysis::Unit::angle) return "rotation";
  return quantity;
}

const analysis::StudyResult* result_of(const std::vector<analysis::StudyResult>& results,
                                       std::string_view study, int run) {
  const auto found = std::find_if(results.begin(), results.end(), [&](const auto& result) {
    return result.run == run && result.study == study;
  });
  return found == results.end() ? nullptr : &*found;
}

const PlannedRun* plan_of(const Case& the_case, const analysis::StudyResult& result) {
  const auto found =
      std::find_if(the_case.runs.begin(), the_case.runs.end(), [&](const PlannedRun& planned) {
        return planned.study == result.study && planned.run == result.run;
      });
  return found == the_case.runs.end() ? nullptr : &*found;
}

std::vector<std::string> varied_parameters(const Case& the_case) {
  std::vector<std::string> names;
  for (const PlannedRun& planned : the_case.runs)
    for (const std::string& name : planned.varied)
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

double varied_value(const PlannedRun* planned, const std::string& name) {
  const bool is_varied =
      planned != nullptr &&
      std::find(planned->varied.begin(), planned->varied.end(), name) != planned->varied.end();
  return is_varied ? planned->parameters.at(name) : std::numeric_limits<double>::quiet_NaN();
}

std::map<std::string, int> event_counts(const analysis::StudyResult& result) {
  std::map<std::string, int> counts;
  std::set<std::string> seen;  // a point where branches meet stands on all of them
  for (const auto& branch : result.branches)
    for (const auto& event : branch.events)
      if (event.label.empty() || seen.insert(event.label).second)
        ++counts[analysis::code_of(event.kind)];
  return counts;
}

bool all_complete(const Case& the_case, const std::vector<analysis::StudyResult>& results) {
  return std::all_of(the_case.runs.begin(), the_case.runs.end(), [&](const PlannedRun& planned) {
    const auto* result = result_of(results, planned.study, planned.run);
    return result != nullptr && analysis::complete(*result);
  });
}

std::string unit_label(Unit unit, Unit lambda_unit, const UnitLabels& labels) {
  return unit_text(unit == Unit::lambda ? lambda_unit : unit, labels);
}

std::string parameter_in(const PlannedRun* planned, const std::string& quantity) {
  if (planned == nullptr) return {};
  const analysis::Study& plan = planned->plan;
  if (quantity == "lambda") return planned->driven_parameter;
  if (analysis::is_of_critical_points(plan.kind) && quantity == plan.critical.parameter)
    return quantity;
  const auto& held = plan.critical.parameters;
  if (plan.kind == analysis::StudyKind::critical_curve &&
      std::find(held.begin(), held.end(), quantity) != held.end())
    return quantity;
  const auto& axes = plan.map.axes;
  const bool is_axis = plan.kind == analysis::StudyKind::map &&
                       std::any_of(axes.begin(), axes.end(), [&](const analysis::MapAxis& axis) {
                         return !axis.pose && axis.name == quantity;
                       });
  return is_axis ? quantity : std::string{};
}

std::string column_unit(const analysis::StudyResult& result, std::size_t column,
                        const PlannedRun* planned, const UnitLabels& labels) {
  const analysis::Quantity& quantity = result.quantities[column];
  const std::string parameter = parameter_in(planned, quantity.name);
  if (parameter.empty()) return unit_label(quantity.unit, result.lambda_unit, labels);
  const auto unit = labels.parameters.find(parameter);
  return unit == labels.parameters.end() ? std::string{} : unit->second;
}

std::string column_title(const analysis::StudyResult& result, const std::string& quantity,
                         const PlannedRun* planned) {
  const std::string parameter = parameter_in(planned, quantity);
  return shown_name(result, quantity) +
         (parameter.empty() || parameter == quantity ? "" : " (" + parameter + ")");
}

std::string parameter_title(const std::string& name, const UnitLabels& labels) {
  const auto unit = labels.parameters.find(name);
  return unit == labels.parameters.end() ? name : name + " [" + unit->second + "]";
}

std::string heading_of(const analysis::StudyResult& result) {
  std::string heading = shown(result.study) + ", run " + std::to_string(result.run);
  if (!result.label.empty()) heading += " (" + shown(result.label) + ")";
  return heading;
}

std::vector<std::string> columns_where(const std::vector<analysis::StudyResult>& results,
                                       bool (*holds)(const analysis::StudyResult&)) {
  std::vector<std::string> names;
  for (const analysis::StudyResult& result : results) {
    if (!holds(result)) continue;
    for (const auto& quantity : result.quantities)
      if (std::find(names.begin(), names.end(), quantity.name) == names.end())
        names.push_back(quantity.name);
  }
  return names;
}

double column_value(const analysis::StudyResult& result, const analysis::SnapState& state,
                    std::string_view name) {
  const auto column = column_of(result, name);
  return column && *column < state.values.size() ? state.values[*column] : nothing;
}

double shown_below(double scale) {
  return continuation::NewtonOptions{}.residual_tolerance * scale;
}

double shown_against(double value, double scale) {
  return std::abs(value) <= shown_below(scale) ? 0 : value;
}

Matrix shown_matrix(Matrix matrix) {
  // Rounding of the largest entry; no more of it, as rows may have other units.
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  constexpr double of_coupled = 64 * std::numeric_limits<double>::epsilon();
  const Matrix whole = matrix;
  double largest = 0;
  for (const double entry : whole.reshaped())
    if (std::isfinite(entry)) largest = std::max(largest, std::abs(entry));
  for (Eigen::Index r = 0; r < whole.rows(); ++r)
    for (Eigen::Index c = 0; c < whole.cols(); ++c) {
      const double coupled = r == c ? 0 : std::sqrt(std::abs(whole(r, r) * whole(c, c)));
      if (std::abs(whole(r, c)) <= std::max(of_coupled * coupled, rounding * largest))
        matrix(r, c) = 0;
    }
  return matrix;
}

}  // namespace springfold::io
