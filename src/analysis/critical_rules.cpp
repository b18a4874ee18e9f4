// What studies of special points in a second parameter must obey.
#include <algorithm>
#include <cmath>

#include "case_curves.hpp"
#include "outside_range.hpp"
#include "run_kinds.hpp"

namespace springfold::analysis {
namespace {

using Problems = std::vector<std::string>;

void check_parameter(const CriticalPointSettings& s, const std::string& key,
                     const std::string& name, Problems& problems) {
  const auto& names = s.cases->names;
  if (std::find(names.begin(), names.end(), name) == names.end())
    problems.push_back(key + ": the case has no parameter \"" + name + "\"");
}

void check_range(const Study& study, const std::string& key, Problems& problems) {
  const CriticalPointSettings& s = study.critical;
  if (!(s.low < s.high)) problems.push_back(key + ".range: need low < high");
  const bool finite = std::isfinite(s.low) && std::isfinite(s.high);
  const bool whole_range =
      study.kind == StudyKind::threshold || study.kind == StudyKind::critical_load;
  if (whole_range && !finite) problems.push_back(key + ".range: need two finite numbers");
  const auto number = std::find(s.cases->names.begin(), s.cases->names.end(), s.parameter);
  if (study.kind != StudyKind::critical_curve || number == s.cases->names.end()) return;
  if (s.point.find('/') != std::string::npos) return;  // the row of the earlier curve decides
  const double value = s.cases->values[static_cast<std::size_t>(number - s.cases->names.begin())];
  if (!(s.low <= value && value <= s.high))
    problems.push_back(key + ".range: the value of \"" + s.parameter + "\"" +
                       outside_range(value, "the range", s.low, s.high) +
                       ": the curve begins there");
}

}  // namespace

std::vector<std::string> problems_of_critical(const Study& study,
                                              const model::Mechanism& mechanism) {
  const CriticalPointSettings& s = study.critical;
  const std::string key{to_string(study.kind)};
  if (!s.cases) return {key + ": needs a case with parameters"};
  Problems problems = problems_in(as_curve(study), mechanism);
  if (study.branches.depth > 0 || !study.branches.search_at.empty())
    problems.push_back("branches: only kind = \"force_deflection\" has branches");
  if (study.path == Path::davidenko)
    problems.push_back(
        "path: this kind needs path = \"arc_length\", which finds all special points");
  if (study.kind == StudyKind::design) {
    if (problems.empty()) problems = problems_of_design(study, mechanism);
    return problems;
  }
  if (study.kind == StudyKind::sensitivity) {
    for (const std::string& name : s.parameters)
      check_parameter(s, key + ".parameters", name, problems);
    return problems;
  }
  check_parameter(s, key + ".parameter", s.parameter, problems);
  if (study.control == ControlMode::parameter && study.parameter == s.parameter)
    problems.push_back(key + ".parameter: \"" + s.parameter + "\" is lambda already");
  check_range(study, key, problems);
  for (const auto& [quantity, low, high] : study.until)
    if (quantity == s.parameter)
      problems.push_back("until." + quantity + ": goes into " + key + ".range");
  if (study.kind == StudyKind::critical_load && s.values < 2)
    problems.push_back(key + ".values: need at least 2");
  if (study.kind == StudyKind::critical_curve && s.point.empty())
    problems.push_back(key + ".of: need the label of a special point such as \"LP1\"");
  return problems;
}

}  // namespace springfold::analysis
