#include "history_rules.hpp"

#include <algorithm>

#include "hold_draft.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

using analysis::StudyKind;

/// Parameters whose values the study changes.
std::vector<std::string> changed_parameters(const analysis::Study& study,
                                            const std::vector<std::string>& all) {
  std::vector<std::string> names;
  if (study.kind == StudyKind::design)
    for (const auto& parameter : study.design.parameters) names.push_back(parameter.name);
  else if (study.kind == StudyKind::sensitivity)
    names = study.critical.parameters.empty() ? all : study.critical.parameters;
  else if (is_of_critical_points(study.kind))
    names.push_back(study.critical.parameter);
  else if (study.kind == StudyKind::map)
    for (const auto& axis : study.map.axes)
      if (!axis.pose) names.push_back(axis.name);
  // The one that is lambda moves along the path alone.
  if (study.control == analysis::ControlMode::parameter && !is_of_commands(study.kind))
    std::erase(names, study.parameter);
  return names;
}

/// A critical curve that begins at another one has the load steps of that.
const analysis::Earlier* load_steps_before(const analysis::History& history) {
  const analysis::Earlier* earlier = history.earlier.get();
  while (earlier != nullptr && earlier->study.kind == StudyKind::critical_curve)
    earlier = earlier->history.earlier.get();
  return earlier;
}

/// A parameter that is changed has one value, which is that of the whole history.
std::string changed_twice(const PlannedRun& planned) {
  const analysis::Earlier* earlier = load_steps_before(planned.history);
  if (earlier == nullptr) return {};
  const std::vector<std::string>& all = earlier->cases->names;
  const std::vector<double>& values = earlier->cases->values;
  const auto changed = changed_parameters(planned.plan, all);
  for (; earlier != nullptr; earlier = earlier->history.earlier.get())
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (std::find(changed.begin(), changed.end(), all[i]) == changed.end()) continue;
      const std::string study = "start.from: study \"" + earlier->study.name + "\" ";
      if (earlier->study.control == analysis::ControlMode::parameter &&
          earlier->study.parameter == all[i])
        return study + "moves the parameter \"" + all[i] +
               "\", which this study changes, need another";
      if (earlier->own_cases->values[i] != values[i])
        return study + "has " + all[i] + " = " + rounded(earlier->own_cases->values[i], 12) +
               " and this one, which changes it, " + rounded(values[i], 12) +
               ", need one value: with vary in both, or in neither";
    }
  return {};
}

/// Are coordinates of a body that is held prescribed for all points?
std::string held_target(const HistoryDraft& history, const MechanismDraft& mechanism,
                        const analysis::Study& study) {
  if (study.kind != StudyKind::control && study.kind != StudyKind::map) return {};
  const auto hold = std::find_if(history.holds.begin(), history.holds.end(),
                                 [&study](const HoldDraft& h) { return h.body == study.body; });
  if (hold == history.holds.end()) return {};
  const std::vector<Index>& wanted = study.command.prescribed;
  for (std::size_t i = 0; i < hold->held.size(); ++i) {
    const bool is_wanted = wanted.empty() || std::find(wanted.begin(), wanted.end(),
                                                       static_cast<Index>(i)) != wanted.end();
    if (!hold->held[i] || !is_wanted) continue;
    const std::string& body = mechanism.bodies[static_cast<std::size_t>(hold->body - 1)].name;
    return "prescribe: " + body + "." + "xyz"[i] + " is held since study \"" + hold->since[i] +
           "\", need others";
  }
  return {};
}

}  // namespace

std::string history_problem(const HistoryDraft& history, const MechanismDraft& mechanism,
                            const PlannedRun& planned) {
  std::string problem = held_drive(history, mechanism, planned);
  if (problem.empty()) problem = held_target(history, mechanism, planned.plan);
  if (problem.empty() && planned.history.earlier) problem = changed_twice(planned);
  return problem;
}

}  // namespace springfold::io
