// The answer of a design study by names.
#include <algorithm>

#include "springfold/analysis/design.hpp"

namespace springfold::analysis {
namespace {

const std::string design_prefix = "design.";
const std::string limits_prefix = "limits.";

std::vector<std::string> requirement_names(const DesignSettings& settings) {
  std::vector<std::string> names;
  for (const CriticalRequirement& one : settings.critical) names.push_back(one.name);
  if (settings.curve)
    for (std::size_t i = 0; i < settings.curve->points.size(); ++i)
      names.push_back("curve." + std::to_string(i + 1));
  if (settings.constant) names.insert(names.end(), {"constant.mean", "constant.deviation"});
  for (std::size_t i = 0; i < settings.stiffness.size(); ++i)
    names.push_back("stiffness." + std::to_string(i + 1));
  return names;
}

double bound_value(BoundState state) {
  return state == BoundState::at_low ? -1 : state == BoundState::at_high ? 1 : 0;
}

}  // namespace

std::vector<std::string> design_quantities(const DesignSettings& settings) {
  std::vector<std::string> own, names;
  for (const DesignParameter& parameter : settings.parameters) own.push_back(parameter.name);
  for (std::string& name : requirement_names(settings)) own.push_back(std::move(name));
  for (const char* name : {"change", "met", "verified"}) names.push_back(design_prefix + name);
  for (const std::string& name : own) {
    names.push_back(design_prefix + name);
    names.push_back(design_prefix + limits_prefix + name);
  }
  return names;
}

std::optional<double> design_value(const DesignReport& report, std::string_view name) {
  if (!name.starts_with(design_prefix)) return std::nullopt;
  name.remove_prefix(design_prefix.size());
  if (name == "change") return report.change;
  if (name == "met")
    return report.status == DesignStatus::met || report.status == DesignStatus::met_at_start;
  if (name == "verified") return report.verified;
  const bool whether = name.starts_with(limits_prefix);
  if (whether) name.remove_prefix(limits_prefix.size());
  for (const FoundParameter& one : report.parameters)
    if (one.name == name) return whether ? bound_value(one.bound) : one.after;
  for (const FoundRequirement& one : report.requirements)
    if (one.name == name) return whether ? static_cast<double>(one.limits) : one.after;
  return std::nullopt;
}

}  // namespace springfold::analysis
