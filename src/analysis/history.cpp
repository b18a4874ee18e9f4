#include "springfold/analysis/history.hpp"

#include <algorithm>
#include <map>

#include "quantities.hpp"
#include "setup.hpp"
#include "springfold/analysis/snap.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::analysis {
namespace {

using State = std::map<std::string, double, std::less<>>;

/// The point of a result with this label; nullptr if there is none.
const std::vector<double>* values_at(const StudyResult& result, const std::string& at) {
  if (result.equilibria) {
    for (const Equilibrium& found : result.equilibria->list)
      if (found.label == at || (at == "start" && found.is_start)) return &found.sample.values;
    return nullptr;
  }
  if (result.branches.empty()) return nullptr;
  const Branch& first = result.branches.front();
  if (at == "start") return &first.samples[first.start_row].values;
  if (at == "end") return &first.samples.back().values;
  for (const Branch& branch : result.branches)
    for (const Event& event : branch.events)
      if (event.label == at) return &branch.samples[event.row].values;
  if (result.snap)
    for (const Jump& jump : result.snap->jumps)
      if (jump.label == at && !jump.landing.values.empty()) return &jump.landing.values;
  return nullptr;
}

/// The points that a study may start at, in words.
std::string points_of(const StudyResult& result) {
  constexpr std::size_t most = 30;
  std::vector<std::string> labels;
  const auto add = [&](const std::string& label) {
    if (!label.empty() && std::find(labels.begin(), labels.end(), label) == labels.end())
      labels.push_back(label);
  };
  if (result.equilibria)
    for (const Equilibrium& found : result.equilibria->list) {
      if (found.is_start) add("start");
      add(found.label);
    }
  if (!result.branches.empty()) add("start"), add("end");
  for (const Branch& branch : result.branches)
    for (const Event& event : branch.events) add(event.label);
  if (result.snap)
    for (const Jump& jump : result.snap->jumps)
      if (!jump.landing.values.empty()) add(jump.label);
  if (labels.empty()) return "it has none at all";
  std::string text = "it has ";
  for (std::size_t i = 0; i < std::min(most, labels.size()); ++i)
    text += (i > 0 ? ", " : "") + labels[i];
  return text + (labels.size() > most ? " and " + std::to_string(labels.size() - most) + " more"
                                      : std::string{});
}

/// Why the result has no such point, in words; empty: it has.
std::string trouble(const StudyResult& result, const std::string& at) {
  const std::string study = "study \"" + result.study + "\", from which it starts, ";
  if (!result.start.found && !result.equilibria)
    return study + "has no start point: " + result.start.message;
  if (at == "end" && !result.branches.empty() && !result.branches.front().forward.complete)
    return study + "stopped early: " + result.branches.front().forward.reason;
  if (values_at(result, at) == nullptr)
    return study + "has no point \"" + at + "\"; " + points_of(result);
  return "";
}

State state_of(const StudyResult& result, const std::vector<double>& values) {
  State state;
  for (std::size_t i = 0; i < std::min(values.size(), result.quantities.size()); ++i)
    state[result.quantities[i].name] = values[i];
  return state;
}

void set_if_known(const State& state, const std::string& name, double& value) {
  if (const auto found = state.find(name); found != state.end()) value = found->second;
}

/// Bodies, joints and commands as they are in the state; chains that hold a body begin there.
void put_state(const State& state, const std::vector<std::string>& held,
               model::Mechanism& mechanism) {
  for (model::Body& body : mechanism.bodies) {
    const std::vector<std::string> names = statics::pose_names(body.task_space);
    for (std::size_t i = 0; i < names.size(); ++i)
      set_if_known(state, body.name + "." + names[i], body.pose[static_cast<Index>(i)]);
  }
  for (model::Chain& chain : mechanism.chains) {
    if (std::find(held.begin(), held.end(), chain.name) != held.end()) {
      const Vector& pose = mechanism.bodies[static_cast<std::size_t>(chain.to - 1)].pose;
      chain.from_attachment.p.setZero();
      chain.from_attachment.p.head(pose.size()) = pose;
      continue;
    }
    for (model::Element& element : chain.elements)
      if (auto* joint = std::get_if<model::Joint>(&element)) {
        set_if_known(state, chain.name + "." + coordinate_name(*joint), joint->initial);
        set_if_known(state, chain.name + "." + joint->name + ".rho", joint->command);
      }
  }
  for (model::ShapeSpring& spring : mechanism.shape_springs)
    for (std::size_t i = 0; i < spring.before.size(); ++i)
      if (const auto found = state.find(series_name(spring, i)); found != state.end())
        spring.before[i].initial = found->second;
}

/// The wrench on the study's body that holds it in the state, beside the mechanism's loads.
Vector holding_wrench(const model::Mechanism& mechanism, const Study& study, const State& state,
                      double lambda) {
  const statics::System system = statics::prepare(mechanism);
  Vector z = Vector::Zero(system.size);
  for (Index i = 0; i < system.size; ++i)
    set_if_known(state, system.coordinate_names[static_cast<std::size_t>(i)], z[i]);
  statics::Inputs inputs{system.commands, Vector::Zero(system.load_size),
                         Vector::Ones(static_cast<Index>(mechanism.loads.size()))};
  for (Index i = 0; i < inputs.rho.size(); ++i)
    set_if_known(state, system.command_names[static_cast<std::size_t>(i)] + ".rho", inputs.rho[i]);
  for (std::size_t i = 0; i < mechanism.loads.size(); ++i)
    if (mechanism.loads[i].with_lambda) inputs.loads[static_cast<Index>(i)] = lambda;
  statics::Workspace work;
  Vector r;
  statics::equilibrium_residual(system, piece_at(system, z), z, inputs, work, r);
  const statics::BodySlice& body = system.body_slices[static_cast<std::size_t>(study.body - 1)];
  return Lu(load_columns(system, z).block(body.t, body.W, body.count, body.count))
      .solve(Vector(-r.segment(body.t, body.count)));
}

/// The wrench on the study's body in the state, beside the mechanism's loads.
Vector wrench_of(const model::Mechanism& mechanism, const Study& study, const State& state,
                 double lambda) {
  const bool traces = study.kind == StudyKind::force_deflection;
  const bool drives =
      traces && (study.control == ControlMode::pose || study.control == ControlMode::mixed);
  if (drives || study.start.solve == StartSolve::wrench)
    return holding_wrench(mechanism, study, state, lambda);
  const Index d = dimension(mechanism.bodies[static_cast<std::size_t>(study.body - 1)].task_space);
  Vector W = study.constant_load.size() > 0 ? study.constant_load : Vector(Vector::Zero(d));
  if (traces && study.control == ControlMode::load && study.direction.size() > 0)
    W += lambda * study.direction;
  return W;
}

void add_wrench(const Vector& W, Index body, model::TaskSpace space,
                std::vector<model::Load>& loads) {
  const Index lengths = translations(space);
  model::Load force{.on = {.body = body}, .kind = model::LoadKind::force};
  force.vector.head(lengths) = W.head(lengths);
  if (!force.vector.isZero(0)) loads.push_back(force);
  model::Load moment{.on = {.body = body}, .kind = model::LoadKind::moment};
  moment.vector.tail(W.size() - lengths) = W.tail(W.size() - lengths);
  if (!moment.vector.isZero(0)) loads.push_back(moment);
}

/// What acts in the state of the earlier study and not by itself in the later one, as constant loads.
std::vector<model::Load> kept_loads(const Earlier& earlier, const model::Mechanism& mechanism,
                                    const Study& study, const State& state) {
  std::vector<model::Load> kept;
  if (!earlier.keeps_loads) return kept;
  const auto at = state.find("lambda");
  const double lambda = at != state.end() ? at->second : 0;
  for (std::size_t i = 0; i < mechanism.loads.size(); ++i) {
    model::Load load = mechanism.loads[i];
    if (i < earlier.common_loads && !load.with_lambda) continue;
    if (load.with_lambda) load.vector *= lambda;
    load.with_lambda = false;
    load.name.clear();
    if (!load.vector.isZero(0)) kept.push_back(std::move(load));
  }
  add_wrench(wrench_of(mechanism, study, state, lambda), study.body,
             mechanism.bodies[static_cast<std::size_t>(study.body - 1)].task_space, kept);
  return kept;
}

/// The forces by which the earlier study held what is released, as constant loads on the bodies.
std::vector<model::Load> holding_forces(const std::vector<Released>& released, const State& state) {
  std::vector<model::Load> forces;
  for (const Released& one : released) {
    const auto on_chain = state.find(one.chain + ".F" + "xyz"[one.coordinate]);
    if (on_chain == state.end() || on_chain->second == 0) continue;
    model::Load force{.on = {.body = one.body}, .kind = model::LoadKind::force};
    force.vector[one.coordinate] = -on_chain->second;
    forces.push_back(force);
  }
  return forces;
}

/// Angles of shapes count the turns of their bodies from where the case draws these: drawn elsewhere,
/// they are near another angle.
void put_turned_state(const State& state, const std::vector<std::string>& held,
                      model::Mechanism& mechanism) {
  const bool counts =
      std::any_of(mechanism.shape_springs.begin(), mechanism.shape_springs.end(),
                  [](const auto& s) { return s.shape.kind == model::ShapeKind::angle; });
  if (!counts) return put_state(state, held, mechanism);
  const statics::System before = statics::prepare(mechanism);
  put_state(state, held, mechanism);
  const statics::System after = statics::prepare(mechanism);
  for (std::size_t i = 0; i < mechanism.shape_springs.size(); ++i)
    mechanism.shape_springs[i].shape.near += after.shapes[i].turned - before.shapes[i].turned;
}

void apply(const State& state, const std::vector<std::string>& held,
           const std::vector<model::Load>& kept, model::Mechanism& mechanism) {
  put_turned_state(state, held, mechanism);
  mechanism.loads.insert(mechanism.loads.end(), kept.begin(), kept.end());
}

/// What a study becomes that starts in a state of an earlier one.
struct Continued {
  model::Mechanism mechanism{};  ///< drawn in that state, with the loads that are kept
  Study study{};
  std::optional<ParameterFamily> family{};  ///< in the same state, with the same loads
  /// Values of parameters that earlier studies moved, by their number.
  std::vector<std::pair<std::size_t, double>> parameters{};
  std::string problem{};  ///< why there is no such state, in words; empty: there is one
  double seconds = 0;     ///< CPU time of the studies before

  const ParameterFamily* family_or_none() const { return family ? &*family : nullptr; }
};

/// The families of studies in a state: all mechanisms begin there.
ParameterFamily in_state(const ParameterFamily& family, const State& state,
                         const std::vector<std::string>& held,
                         const std::vector<model::Load>& kept) {
  return {[at = family.at, state, held, kept](double value) {
            Situation now = at(value);
            apply(state, held, kept, now.mechanism);
            return now;
          },
          family.value};
}

Continued continued(const model::Mechanism& mechanism, const Study& study,
                    const ParameterFamily* family, const History& history,
                    const Observer& observer) {
  Continued later{.mechanism = mechanism, .study = study};
  if (family != nullptr) later.family = *family;
  if (!history.earlier) return later;
  const Earlier& earlier = *history.earlier;
  Continued first =
      continued(earlier.mechanism, earlier.study, earlier.family ? &*earlier.family : nullptr,
                earlier.history, observer);
  later.problem = first.problem;
  later.parameters = first.parameters;
  if (!later.problem.empty()) return later;
  const StudyResult result =
      run_study(first.mechanism, first.study, first.family_or_none(), observer);
  later.seconds = first.seconds + result.seconds;
  later.problem = trouble(result, earlier.at);
  if (!later.problem.empty()) return later;
  const State state = state_of(result, *values_at(result, earlier.at));
  if (first.study.control == ControlMode::parameter && first.family &&
      first.study.kind == StudyKind::force_deflection) {
    const double value = state.at("lambda");
    Situation there = first.family->at(value);
    first.mechanism = std::move(there.mechanism);
    first.study.constant_load = std::move(there.constant_load);
    later.parameters.emplace_back(earlier.parameter, value);
  }
  if (!later.parameters.empty()) {
    if (later.family) {
      later.problem = "an earlier study moved a parameter, and this one is to move one again";
      return later;
    }
    Variant variant = earlier.cases->at(later.parameters);
    later.mechanism = std::move(variant.mechanism);
    later.study = std::move(variant.study);
  }
  later.study.start.attempts = 1;  // nothing but that state is meant
  auto kept = kept_loads(earlier, first.mechanism, first.study, state);
  if (earlier.keeps_loads)
    for (model::Load& force : holding_forces(history.released, state)) {
      if (!force.vector.allFinite())
        later.problem = "the force that held what is released is not known there";
      kept.push_back(std::move(force));
    }
  apply(state, history.held, kept, later.mechanism);
  if (later.family) later.family = in_state(*later.family, state, history.held, kept);
  return later;
}

void report_no_state(const std::string& problem, StartReport& report) {
  report.message = problem;
  report.where = "start.from";
  report.advice = "run the earlier study alone and look where it ends";
}

}  // namespace

StudyResult run_study_after(const History& history, const model::Mechanism& mechanism,
                            const Study& study, const ParameterFamily* family,
                            const Observer& observer, const RunOptions& options) {
  if (!history.earlier) return run_study(mechanism, study, family, observer, options);
  const Continued later = continued(mechanism, study, family, history, observer);
  if (later.problem.empty()) {
    StudyResult result =
        run_study(later.mechanism, later.study, later.family_or_none(), observer, options);
    result.seconds += later.seconds;
    result.start.method +=
        ", from study \"" + history.earlier->study.name + "\" at " + history.earlier->at;
    return result;
  }
  StudyResult result{.study = study.name};
  const Setup setup = set_up(mechanism, study, family);
  result.lambda_unit = lambda_unit_of(study, setup.system);
  for (const QuantityDefinition& q :
       quantities_of(study, setup.system, setup.scales, setup.lambda_scale, result.lambda_unit))
    result.quantities.push_back({q.name, q.unit});
  report_no_state(later.problem, result.start);
  return result;
}

std::optional<StartReport> solve_start_after(const History& history,
                                             const model::Mechanism& mechanism, const Study& study,
                                             const ParameterFamily* family) {
  if (!history.earlier) return solve_start(mechanism, study, family);
  const Continued later = continued(mechanism, study, family, history, {});
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
