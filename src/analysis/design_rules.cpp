// What studies of designs must obey.
#include <algorithm>
#include <cmath>

#include "outside_range.hpp"
#include "quantities.hpp"
#include "run_kinds.hpp"

namespace springfold::analysis {
namespace {

using Problems = std::vector<std::string>;

class Checker {
 public:
  Checker(const Study& study, const model::Mechanism& mechanism)
      : study_{study},
        settings_{study.design},
        columns_{quantities_of(study, statics::prepare(mechanism), {}, 1, Unit::none)},
        dimension_{
            dimension(mechanism.bodies[static_cast<std::size_t>(study.body - 1)].task_space)} {}

  Problems problems() {
    for (const DesignParameter& parameter : settings_.parameters) check(parameter);
    if (settings_.parameters.empty()) add("design.parameters", "need at least one parameter");
    const bool any = !settings_.critical.empty() || settings_.curve || settings_.constant ||
                     !settings_.stiffness.empty();
    if (!any)
      add("design",
          "need a requirement: critical_load, no_limit_point, curve, constant or "
          "stiffness");
    for (const CriticalRequirement& one : settings_.critical) {
      check_column("design." + one.name + ".quantity", one.quantity, true);
      if (std::isnan(one.at_least)) add("design." + one.name, "need a number");
    }
    if (settings_.curve) check(*settings_.curve);
    if (settings_.constant) check(*settings_.constant);
    for (const StiffnessRequirement& one : settings_.stiffness) check(one);
    if (settings_.starts < 1) add("design.starts", "need at least 1");
    return std::move(problems_);
  }

 private:
  void add(const std::string& key, const std::string& what) {
    problems_.push_back(key + ": " + what);
  }

  void check_column(const std::string& key, const std::string& name, bool continuous) {
    const QuantityDefinition* at = find_quantity(columns_, name);
    if (at == nullptr)
      add(key, "\"" + name + "\" is no quantity of this study");
    else if (continuous && !is_continuous(*at))
      add(key,
          "\"" + name +
              "\" cannot be used here, only quantities that vary continuously along the branch");
  }

  void check(const DesignParameter& parameter) {
    const std::string key = "design.parameters." + parameter.name;
    const CaseFamily& cases = *study_.critical.cases;
    const auto known = std::find(cases.names.begin(), cases.names.end(), parameter.name);
    if (known == cases.names.end())
      return add(key, "the case has no parameter \"" + parameter.name + "\"");
    if (study_.control == ControlMode::parameter && study_.parameter == parameter.name)
      add(key, "is lambda already");
    const auto answers = design_quantities(settings_);
    if (std::count(answers.begin(), answers.end(), "design." + parameter.name) > 1)
      add(key, "the answer has a value design." + parameter.name +
                   " already, need another name of the parameter");
    if (!std::isfinite(parameter.low) || !std::isfinite(parameter.high) ||
        !(parameter.low < parameter.high))
      return add(key, "need two finite numbers low < high");
    const double value = cases.values[static_cast<std::size_t>(known - cases.names.begin())];
    if (!(parameter.low <= value && value <= parameter.high))
      add(key, "the value of \"" + parameter.name + "\"" +
                   outside_range(value, "the range", parameter.low, parameter.high) +
                   ": changes are counted from it");
    if (!(parameter.unit >= 0) || !std::isfinite(parameter.unit))
      add("design.scale." + parameter.name, "need a number > 0");
  }

  void check(const CurveRequirement& curve) {
    check_column("design.curve.x", curve.x, true);
    check_column("design.curve.y", curve.y, false);
    if (curve.points.empty()) add("design.curve.points", "need at least one point");
    for (const auto& [x, y] : curve.points)
      if (!std::isfinite(x) || !std::isfinite(y)) add("design.curve.points", "need finite numbers");
    if (!(curve.tolerance > 0)) add("design.curve.tolerance", "need a number > 0");
  }

  void check(const ConstantRequirement& constant) {
    check_column("design.constant.along", constant.along, true);
    check_column("design.constant.quantity", constant.quantity, false);
    if (!(constant.from < constant.to)) add("design.constant.to", "need from < to");
    if (!(constant.within > 0)) add("design.constant.within", "need a number > 0");
  }

  void check(const StiffnessRequirement& one) {
    check_column("design.stiffness.quantity", one.quantity, false);
    if (one.at) check_column("design.stiffness.at", one.at->first, true);
    if (one.pose.size() != 0 && one.pose.size() != dimension_)
      add("design.stiffness.pose", "need " + std::to_string(dimension_) + " numbers");
    if (one.at && one.pose.size() > 0)
      add("design.stiffness", "got \"at\" and \"pose\", need one of them");
  }

  const Study& study_;
  const DesignSettings& settings_;
  std::vector<QuantityDefinition> columns_;
  Index dimension_;
  Problems problems_{};
};

}  // namespace

std::vector<std::string> problems_of_design(const Study& study, const model::Mechanism& mechanism) {
  return Checker(study, mechanism).problems();
}

}  // namespace springfold::analysis
