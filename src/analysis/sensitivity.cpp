// The study kind `sensitivity`: how special points move with the parameters of the case.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "analysis/undefined.hpp"
#include "critical_runs.hpp"
#include "imperfection.hpp"
#include "run_kinds.hpp"
#include "special_rates.hpp"

namespace springfold::analysis {
namespace {

/// Columns whose rates are given: loads, positions, energy.
bool is_rated(const QuantityDefinition& q, const statics::System& system) {
  using QuantityKind = QuantityDefinition::Kind;
  if (q.kind == QuantityKind::unknown) return !system.is_wrench[static_cast<std::size_t>(q.entry)];
  return q.kind == QuantityKind::lambda || q.kind == QuantityKind::force ||
         q.kind == QuantityKind::deflection || q.kind == QuantityKind::energy;
}

std::string name_of(const std::string& column, const std::string& parameter) {
  return "d(" + column + ")/d(" + parameter + ")";
}

std::vector<std::string> parameters_of(const Study& study) {
  return study.critical.parameters.empty() ? study.critical.cases->names
                                           : study.critical.parameters;
}

/// A worst combination is one of named parameters: all of the case have no common unit.
bool has_worst(const Study& study) { return !study.critical.parameters.empty(); }

/// A parameter whose value is 0 says nothing of its size, and the steps of differences are parts of that. Of several
/// sizes the one is taken about which the rates of the load change least: larger ones bend, smaller ones are lost in
/// rounding.
std::unique_ptr<CaseCurves> curves_about_zero(const Study& study, std::size_t number,
                                              const CurvesWithPath& begun, std::size_t lambda) {
  constexpr double factor = 0x1p-3, smallest = 0x1p-18;
  std::unique_ptr<CaseCurves> best;
  double least = std::numeric_limits<double>::infinity();
  std::vector<double> rates_before;
  for (double size = 1; size >= smallest; size *= factor) {
    Study sized = study;
    sized.critical.low = -0.5 * size;
    sized.critical.high = 0.5 * size;
    auto curves = std::make_unique<CaseCurves>(sized, number, begun.lambda_unit);
    std::vector<double> rates;
    for (const SpecialPoint& point : begun.path.points) {
      const auto found =
          rates_at_special(*curves, begun.curves->base(), point, column_values({lambda}));
      rates.push_back(found ? (*found)[0] : undefined);
    }
    std::optional<double> change;  // nothing where the parameter keeps no point
    for (std::size_t k = 0; k < rates_before.size(); ++k)
      if (std::isfinite(rates[k]) && std::isfinite(rates_before[k]))
        change = std::max(change.value_or(0), std::abs(rates[k] - rates_before[k]));
    if (!best || (change && *change < least)) best = std::move(curves);
    least = std::min(least, change.value_or(least));
    if (!rates_before.empty() && (!change || least == 0)) break;
    rates_before = std::move(rates);
  }
  return best;
}

/// A point without rates by some parameters for one reason, where that is known.
struct LostRates {
  std::string label{}, why{}, parameters{};
};

void add_lost(const std::string& label, const std::string& why, const std::string& parameter,
              std::vector<LostRates>& lost) {
  for (LostRates& one : lost)
    if (one.label == label && one.why == why) {
      one.parameters += ", " + parameter;
      return;
    }
  lost.push_back({label, why, parameter});
}

void say_lost(const std::vector<LostRates>& lost, BasePath& path) {
  for (const LostRates& one : lost)
    for (Event& event : path.branch.events)
      if (event.label == one.label)
        event.detail += "; no rate by " + one.parameters + (one.why.empty() ? "" : ": " + one.why);
}

/// Columns of the laws of imperfections; what other rows do not have is undefined.
void add_laws(const Study& study, const std::vector<PointLaws>& laws, BasePath& path,
              StudyResult& result) {
  for (const std::string& name : law_columns(parameters_of(study), has_worst(study)))
    result.quantities.push_back({name, Unit::none});
  for (std::size_t k = 0; k < laws.size(); ++k) {
    const auto more = laws[k].values(has_worst(study));
    const bool lawless = laws[k].lacks_law();
    for (Event& event : path.branch.events)
      if (lawless && event.label == path.points[k].label)
        event.detail += "; its form to third order does not give the law of every imperfection";
    auto& values = path.branch.samples[path.points[k].row].values;
    values.insert(values.end(), more.begin(), more.end());
  }
  for (Sample& sample : path.branch.samples)
    sample.values.resize(result.quantities.size(), undefined);
  for (Event& event : path.branch.events) {
    event.rates_before.resize(result.quantities.size(), undefined);
    event.rates_after.resize(result.quantities.size(), undefined);
  }
}

}  // namespace

std::vector<std::string> sensitivity_columns(const std::vector<std::string>& rated,
                                             const std::vector<std::string>& parameters) {
  std::vector<std::string> names;
  for (const std::string& parameter : parameters)
    for (const std::string& column : rated) names.push_back(name_of(column, parameter));
  return names;
}

std::vector<std::string> critical_columns(const Study& study, const model::Mechanism& mechanism) {
  const statics::System system = statics::prepare(mechanism);
  std::vector<std::string> names, rated;
  for (const auto& q : quantities_of(as_curve(study), system, {}, 1, Unit::none)) {
    names.push_back(q.name);
    if (is_rated(q, system)) rated.push_back(q.name);
  }
  if (study.kind == StudyKind::design) {
    for (const DesignParameter& parameter : study.design.parameters)
      names.push_back(parameter.name);
    for (std::string& name : design_quantities(study.design)) names.push_back(std::move(name));
    return names;
  }
  if (study.kind != StudyKind::sensitivity) {
    names.insert(names.end(), study.critical.parameters.begin(), study.critical.parameters.end());
    names.push_back(study.critical.parameter);
    if (study.kind == StudyKind::threshold)
      for (const ThresholdQuantity& one : threshold_quantities) names.emplace_back(one.name);
    return names;
  }
  if (!study.critical.cases) return names;
  for (std::string& name : sensitivity_columns(rated, parameters_of(study)))
    names.push_back(std::move(name));
  for (std::string& name : law_columns(parameters_of(study), has_worst(study)))
    names.push_back(std::move(name));
  return names;
}

void run_sensitivity(const Study& study, const Observer& observer, StudyResult& result) {
  const auto& names = study.critical.cases->names;
  CurvesWithPath begun;
  BasePath& path = begun.path;
  std::vector<std::size_t> columns;
  std::vector<PointLaws> laws;
  std::size_t lambda = 0;  // which of the rated columns
  std::vector<LostRates> lost;
  for (const std::string& parameter : parameters_of(study)) {
    const auto number =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), parameter) - names.begin());
    const bool is_first = result.quantities.empty();
    if (is_first) begun = curves_with_path(study, number, false, observer);
    std::unique_ptr<CaseCurves> own;
    if (!is_first) own = std::make_unique<CaseCurves>(study, number, begun.lambda_unit);
    if (is_first) {
      const Member& base = begun.curves->base();
      result.start = base.report;
      if (!base.report.found) return;
      result.lambda_unit = lambda_unit_of(base.study, base.setup.system);
      for (std::size_t i = 0; i < base.quantities().size(); ++i) {
        const auto& q = base.quantities()[i];
        result.quantities.push_back({q.name, q.unit});
        if (q.kind == QuantityDefinition::Kind::lambda) lambda = columns.size();
        if (is_rated(q, base.setup.system)) columns.push_back(i);
      }
      if (!path.problem.empty()) return refuse_start(path, result.start);
      for (const SpecialPoint& point : path.points) laws.emplace_back(point);
    }
    const double value = is_first ? begun.curves->value() : own->value();
    if (value == 0) own = curves_about_zero(study, number, begun, columns[lambda]);
    const CaseCurves& curves = own ? *own : *begun.curves;
    const Member& base = curves.base();
    for (const std::size_t i : columns)
      result.quantities.push_back({name_of(base.quantities()[i].name, parameter), Unit::none});
    for (std::size_t k = 0; k < path.points.size(); ++k) {
      const SpecialPoint& point = path.points[k];
      std::string why;
      auto rates = rates_at_special(curves, base, point, column_values(columns), &why);
      const bool has_rates =
          laws[k].enter(curves, rates ? (*rates)[static_cast<Index>(lambda)] : undefined);
      if (!has_rates) rates.reset();
      if (!rates || std::isnan((*rates)[0])) add_lost(point.label, why, parameter, lost);
      auto& values = path.branch.samples[point.row].values;
      for (std::size_t i = 0; i < columns.size(); ++i)
        values.push_back(rates ? (*rates)[static_cast<Index>(i)] : undefined);
    }
  }
  say_lost(lost, path);
  add_laws(study, laws, path, result);
  result.branches.push_back(std::move(path.branch));
}

}  // namespace springfold::analysis
