#include "springfold/analysis/history.hpp"

#include <algorithm>

#include "arrivals.hpp"
#include "cpu_time.hpp"
#include "critical_runs.hpp"
#include "quantities.hpp"
#include "run_kinds.hpp"
#include "run_traced.hpp"
#include "setup.hpp"

namespace springfold::analysis {
namespace {

void report_no_state(const std::string& problem, StartReport& report) {
  report.message = problem;
  report.where = "start.from";
  report.advice = "run the earlier study alone and look where it ends";
}

/// Every node of a map over parameters has a history of its own.
bool has_parameter_axes(const Study& study) {
  return study.kind == StudyKind::map &&
         std::any_of(study.map.axes.begin(), study.map.axes.end(),
                     [](const MapAxis& axis) { return !axis.pose; });
}

std::function<Situation(const std::vector<double>&)> situations_after(
    const std::shared_ptr<const Arrivals>& arrivals, const Study& study) {
  const auto cases = after(arrivals, arrivals->history().earlier->cases, study);
  std::vector<std::size_t> numbers;
  for (const MapAxis& axis : study.map.axes)
    if (!axis.pose)
      numbers.push_back(static_cast<std::size_t>(
          std::find(cases->names.begin(), cases->names.end(), axis.name) - cases->names.begin()));
  return [cases, numbers](const std::vector<double>& values) {
    ParameterChanges changes;
    for (std::size_t k = 0; k < numbers.size(); ++k) changes.emplace_back(numbers[k], values[k]);
    Variant now = cases->at(changes);
    return Situation{std::move(now.mechanism), std::move(now.study.constant_load),
                     std::move(now.study.map.pose), std::move(now.problem)};
  };
}

/// The study in the state of the one before, and all members of its family with theirs.
Continued with_members(const std::shared_ptr<const Arrivals>& arrivals,
                       const model::Mechanism& mechanism, const Study& study,
                       const ParameterFamily* family) {
  if (has_parameter_axes(study)) {
    Continued later{.mechanism = mechanism, .study = study};
    later.study.map.situation = situations_after(arrivals, study);
    return later;
  }
  Continued later = continued(*arrivals, mechanism, study, family);
  later.study.critical.cases = study.critical.cases;
  if (later.problem.empty() && study.critical.cases)
    later.study.critical.cases = after(arrivals, study.critical.cases, study);
  return later;
}

std::vector<Quantity> columns_without_start(const model::Mechanism& mechanism, const Study& study,
                                            const ParameterFamily* family, Unit& lambda_unit) {
  if (is_of_commands(study.kind)) return columns_of(study, mechanism);
  if (is_of_critical_points(study.kind)) return {};
  const Setup setup = set_up(mechanism, study, family);
  lambda_unit = lambda_unit_of(study, setup.system);
  std::vector<Quantity> columns;
  for (const QuantityDefinition& q :
       quantities_of(study, setup.system, setup.scales, setup.lambda_scale, lambda_unit))
    columns.push_back({q.name, q.unit});
  return columns;
}

/// A critical curve from a row of the earlier one.
StudyResult run_curve_after(const History& history, const model::Mechanism& mechanism,
                            const Study& study, const Observer& observer) {
  require_usable(mechanism, study);
  const double began = thread_seconds();
  CurveRun run = begin_on_curve(history, study, observer);
  if (run.result.start.found) follow_within_rules(run, observer);
  run.result.seconds = thread_seconds() - began;
  return std::move(run.result);
}

}  // namespace

StudyResult run_study_after(const History& history, const model::Mechanism& mechanism,
                            const Study& study, const ParameterFamily* family,
                            const Observer& observer, const RunOptions& options) {
  if (begins_on_curve(history)) return run_curve_after(history, mechanism, study, observer);
  if (!history.earlier) return run_study(mechanism, study, family, observer, options);
  // A map asks its own observer from one thread alone, and what is stopped half-way is no node.
  const auto arrivals = std::make_shared<const Arrivals>(
      history, study.kind == StudyKind::map ? Observer{} : observer);
  const Continued later = with_members(arrivals, mechanism, study, family);
  if (later.problem.empty()) {
    StudyResult result =
        run_study(later.mechanism, later.study, later.family_or_none(), observer, options);
    result.seconds += later.seconds;
    result.start.method +=
        ", from study \"" + history.earlier->study.name + "\" at " + history.earlier->at;
    if (const std::string& loss = arrivals->at({})->loss; !loss.empty())
      result.start.method +=
          ", behind " + loss + ", where stability was lost: loaded slowly it does not get there";
    return result;
  }
  StudyResult result{.study = study.name};
  result.quantities = columns_without_start(mechanism, study, family, result.lambda_unit);
  report_no_state(later.problem, result.start);
  return result;
}

std::optional<StartReport> solve_start_after(const History& history,
                                             const model::Mechanism& mechanism, const Study& study,
                                             const ParameterFamily* family) {
  if (begins_on_curve(history)) {
    require_usable(mechanism, study);
    return begin_on_curve(history, study, {}).result.start;
  }
  if (!history.earlier) return solve_start(mechanism, study, family);
  if (has_parameter_axes(study)) return std::nullopt;
  const auto arrivals = std::make_shared<const Arrivals>(history, Observer{});
  const Continued later = with_members(arrivals, mechanism, study, family);
  if (later.problem.empty())
    return solve_start(later.mechanism, later.study, later.family_or_none());
  StartReport report;
  report_no_state(later.problem, report);
  return report;
}

void hold(Index body, const std::vector<bool>& held, const std::string& name,
          model::Mechanism& mechanism) {
  const model::Body& node = mechanism.bodies[static_cast<std::size_t>(body - 1)];
  model::Chain chain{.name = node.name + "." + name, .to = body};
  chain.from_attachment.p.head(node.pose.size()) = node.pose;
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (held[i]) continue;
    chain.elements.push_back(
        model::Joint{.name = std::string(1, "xyz"[i]),
                     .kind = model::JointKind::prismatic,
                     .axis = model::Vec3<double>::Unit(static_cast<Index>(i))});
  }
  if (chain.elements.empty()) chain.elements.push_back(model::RigidLink{});
  mechanism.chains.push_back(std::move(chain));
}

}  // namespace springfold::analysis
