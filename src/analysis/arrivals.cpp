#include "arrivals.hpp"

#include <algorithm>

#include "parameter_rules.hpp"

namespace springfold::analysis {
namespace {

/// Those of parameter studies share a few hundred values at most, as neighbouring points of a curve do.
constexpr std::size_t most_arrivals = 256;

bool moves_parameter(const Study& study) {
  return study.kind == StudyKind::force_deflection && study.control == ControlMode::parameter;
}

/// Its place among the changes; end: it is not among them.
ParameterChanges::const_iterator change_of(const ParameterChanges& changes, std::size_t number) {
  return std::find_if(changes.begin(), changes.end(),
                      [number](const auto& one) { return one.first == number; });
}

/// The changes with others; of a parameter that is in both the first ones hold.
ParameterChanges with_others(ParameterChanges changes, const ParameterChanges& others) {
  for (const auto& other : others)
    if (change_of(changes, other.first) == changes.end()) changes.push_back(other);
  return changes;
}

ParameterChanges without(ParameterChanges changes, std::optional<std::size_t> number) {
  std::erase_if(changes, [number](const auto& one) { return one.first == number; });
  return changes;
}

/// The path of a study of control mode parameter, other parameters having other values.
ParameterFamily path_of(std::shared_ptr<const CaseFamily> cases, const ParameterChanges& changes,
                        std::size_t lambda, double value) {
  return {[cases = std::move(cases), others = without(changes, lambda), lambda](double v) {
            Variant now = cases->at(with_others({{lambda, v}}, others));
            return Situation{std::move(now.mechanism), std::move(now.study.constant_load), {}};
          },
          value};
}

/// Bodies, joints and loads as the studies before leave them.
void begin_in(const Arrival& arrival, const std::vector<std::string>& held,
              model::Mechanism& mechanism) {
  put_in_state(arrival.state, held, mechanism);
  mechanism.loads.insert(mechanism.loads.end(), arrival.kept.begin(), arrival.kept.end());
}

/// The same for all mechanisms of a path: they begin there.
ParameterFamily path_in(const ParameterFamily& family, std::shared_ptr<const Arrival> arrival,
                        const std::vector<std::string>& held) {
  return {[at = family.at, arrival = std::move(arrival), held](double value) {
            Situation now = at(value);
            begin_in(*arrival, held, now.mechanism);
            return now;
          },
          family.value};
}

/// Why the study cannot start there with these values, in words; empty: it can.
std::string trouble_with(const Arrival& arrival, const ParameterChanges& changes,
                         const CaseFamily& cases) {
  if (!arrival.problem.empty()) return arrival.problem;
  for (const auto& [number, value] : arrival.moved)
    if (change_of(changes, number) != changes.end())
      return "an earlier study moved the parameter " + cases.names[number] +
             ", and this one is to change it again";
  return "";
}

/// Studies of commands have nothing but energies.
std::string trouble_with_loads(const Study& study, const model::Mechanism& mechanism) {
  if (!is_of_commands(study.kind)) return "";
  const bool fit =
      std::all_of(mechanism.loads.begin(), mechanism.loads.end(),
                  [&](const model::Load& load) { return model::is_conservative(mechanism, load); });
  return fit ? "" : "a load that is kept has no potential, which a study of this kind needs";
}

/// A study with what is known of its case.
struct CaseStudy {
  const model::Mechanism& mechanism;
  const Study& study;
  const ParameterFamily* family = nullptr;
  const std::shared_ptr<const CaseFamily>& cases;
  std::size_t lambda = 0;  ///< number of the parameter that it moves, if it does
};

/// The study for other values of the parameters, which starts on its own.
Continued changed(const CaseStudy& of, const ParameterChanges& changes) {
  Continued now;
  if (changes.empty()) {
    now.mechanism = of.mechanism;
    now.study = of.study;
    if (of.family != nullptr) now.family = *of.family;
    return now;
  }
  Variant variant = of.cases->at(changes);
  now.mechanism = std::move(variant.mechanism);
  now.study = std::move(variant.study);
  if (moves_parameter(of.study))
    now.family = path_of(of.cases, changes, of.lambda, variant.parameters[of.lambda]);
  return now;
}

Continued continued_with(const Arrivals& arrivals, const CaseStudy& of,
                         const ParameterChanges& changes) {
  const auto arrival =
      arrivals.at(moves_parameter(of.study) ? without(changes, of.lambda) : changes);
  std::string problem = trouble_with(*arrival, changes, *of.cases);
  if (problem.empty() && !arrival->moved.empty() && of.family != nullptr)
    problem = "an earlier study moved a parameter, and this one is to move one again";
  Continued later = changed(of, problem.empty() ? with_others(changes, arrival->moved) : changes);
  later.problem = std::move(problem);
  later.seconds = arrival->seconds;
  later.moved = arrival->moved;
  later.way = arrival->way;
  if (!later.problem.empty()) return later;
  later.study.start.attempts = 1;  // nothing but that state is meant
  later.study.start.is_state = true;
  const std::vector<std::string>& held = arrivals.history().held;
  begin_in(*arrival, held, later.mechanism);
  later.problem = trouble_with_loads(later.study, later.mechanism);
  if (later.family) later.family = path_in(*later.family, arrival, held);
  return later;
}

}  // namespace

Arrivals::Arrivals(History history, Observer observer)
    : history_{std::move(history)}, observer_{std::move(observer)} {
  const History& of_earlier = history_.earlier->history;
  if (of_earlier.earlier) before_ = std::make_unique<const Arrivals>(of_earlier, observer_);
}

std::shared_ptr<const Arrival> Arrivals::at(ParameterChanges changes) const {
  const auto& own = history_.earlier->own_cases;
  const auto is_own = [&own](const auto& one) {
    return own && own->values[one.first] == one.second;
  };
  if (std::all_of(changes.begin(), changes.end(), is_own)) changes.clear();
  std::sort(changes.begin(), changes.end());
  {
    const std::scoped_lock lock{busy_};
    if (const auto known = known_.find(changes); known != known_.end()) return known->second;
  }
  const auto found = std::make_shared<const Arrival>(run(changes));
  const std::scoped_lock lock{busy_};
  if (known_.size() >= most_arrivals)
    std::erase_if(known_, [](const auto& one) { return !one.first.empty(); });
  return known_.emplace(std::move(changes), found).first->second;
}

Continued Arrivals::earlier_study(const ParameterChanges& changes) const {
  const Earlier& earlier = *history_.earlier;
  const CaseStudy of{earlier.mechanism, earlier.study, earlier.family ? &*earlier.family : nullptr,
                     earlier.own_cases, earlier.parameter};
  return before_ ? continued_with(*before_, of, changes) : changed(of, changes);
}

Arrival Arrivals::run(const ParameterChanges& changes) const {
  const Earlier& earlier = *history_.earlier;
  Continued first = earlier_study(changes);
  Arrival arrival{.moved = first.moved, .problem = first.problem, .seconds = first.seconds};
  if (!arrival.problem.empty()) return arrival;
  if (const std::string rule = broken_rule(first.mechanism, first.study); !rule.empty()) {
    arrival.problem =
        "study \"" + earlier.study.name + "\", from which it starts, cannot be run: " + rule;
    return arrival;
  }
  const StudyResult result =
      run_study(first.mechanism, first.study, first.family_or_none(), observer_);
  arrival.seconds += result.seconds;
  std::string at = earlier.at;
  if (result.equilibria && at != "start" && !changes.empty()) {
    const auto own = this->at({});
    if (own->problem.empty()) at = label_near(result, own->state);
    if (at.empty())
      arrival.problem = "study \"" + earlier.study.name +
                        "\", from which it starts, has several equilibria that may be " +
                        earlier.at;
  }
  if (arrival.problem.empty()) arrival.problem = trouble_at(result, at);
  if (!arrival.problem.empty()) return arrival;
  arrival.state = state_at(result, at);
  arrival.loss = loss_before(result, at);
  arrival.way = first.way + (first.way.empty() ? "" : "; ") + way_to(result, at);
  if (moves_parameter(first.study) && first.family) {
    const double value = arrival.state.at("lambda");
    Situation there = first.family->at(value);
    first.mechanism = std::move(there.mechanism);
    first.study.constant_load = std::move(there.constant_load);
    arrival.moved.emplace_back(earlier.parameter, value);
  }
  arrival.kept = kept_loads(earlier, first.mechanism, first.study, arrival.state);
  if (!earlier.keeps_loads) return arrival;
  for (model::Load& force : holding_forces(history_.released, arrival.state)) {
    if (!force.vector.allFinite())
      arrival.problem = "the force that held what is released is not known there";
    arrival.kept.push_back(std::move(force));
  }
  return arrival;
}

Continued continued(const Arrivals& arrivals, const model::Mechanism& mechanism, const Study& study,
                    const ParameterFamily* family) {
  return continued_with(arrivals, {mechanism, study, family, arrivals.history().earlier->cases},
                        {});
}

std::shared_ptr<const CaseFamily> after(std::shared_ptr<const Arrivals> arrivals,
                                        std::shared_ptr<const CaseFamily> cases,
                                        const Study& study) {
  auto family = std::make_shared<CaseFamily>(*cases);
  family->moving = {};  // the state that it begins in moves too
  for (const auto& [number, value] : arrivals->at({})->moved) family->values[number] = value;
  std::optional<std::size_t> lambda;
  if (study.control == ControlMode::parameter && !is_of_commands(study.kind))
    lambda = static_cast<std::size_t>(
        std::find(cases->names.begin(), cases->names.end(), study.parameter) -
        cases->names.begin());
  family->at = [arrivals = std::move(arrivals), cases = std::move(cases),
                lambda](const ParameterChanges& changes) {
    const auto arrival = arrivals->at(without(changes, lambda));
    Variant now = cases->at(with_others(changes, arrival->moved));
    now.way = arrival->way;
    now.problem = trouble_with(*arrival, changes, *cases);
    if (!now.problem.empty()) return now;
    now.is_in_state = true;
    now.study.start.attempts = 1;
    now.study.start.is_state = true;
    begin_in(*arrival, arrivals->history().held, now.mechanism);
    now.problem = trouble_with_loads(now.study, now.mechanism);
    return now;
  };
  return family;
}

}  // namespace springfold::analysis
