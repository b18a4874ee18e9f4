#include "history_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "setup.hpp"
#include "springfold/analysis/snap.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::analysis {
namespace {

/// A point of a result.
struct ResultPoint {
  const std::vector<double>* values = nullptr;  ///< nullptr: there is none
  std::string piece{};
  const Branch* branch = nullptr;  ///< nullptr: it lies on none
  std::size_t row = 0;
};

ResultPoint point_on(const Branch& branch, std::size_t row) {
  return {&branch.samples[row].values, branch.samples[row].piece, &branch, row};
}

/// The point with this label.
ResultPoint point_at(const StudyResult& result, const std::string& at) {
  if (result.equilibria) {
    for (const Equilibrium& found : result.equilibria->list)
      if (found.label == at || (at == "start" && found.is_start))
        return {&found.sample.values, found.sample.piece};
    return {};
  }
  if (result.branches.empty()) return {};
  const Branch& first = result.branches.front();
  if (at == "start") return point_on(first, first.start_row);
  if (at == "end") return point_on(first, first.samples.size() - 1);
  for (const Branch& branch : result.branches)
    for (const Event& event : branch.events)
      if (event.label == at) return point_on(branch, event.row);
  if (result.snap)
    for (const Jump& jump : result.snap->jumps)
      if (jump.label == at && !jump.landing.values.empty())
        return {&jump.landing.values, jump.landing.piece};
  return {};
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

void set_if_known(const NamedValues& state, const std::string& name, double& value) {
  if (const auto found = state.find(name); found != state.end()) value = found->second;
}

/// Bodies, joints and commands as they are in the state; chains that hold a body begin there.
void put_poses(const NamedValues& state, const std::vector<std::string>& held,
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
Vector holding_wrench(const model::Mechanism& mechanism, const Study& study,
                      const NamedValues& state, double lambda) {
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
Vector wrench_of(const model::Mechanism& mechanism, const Study& study, const NamedValues& state,
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

}  // namespace

std::string trouble_at(const StudyResult& result, const std::string& at) {
  const std::string study = "study \"" + result.study + "\", from which it starts, ";
  if (!result.start.found && !result.equilibria)
    return study + "has no start point: " + result.start.message;
  if (at == "end" && !result.branches.empty() && !result.branches.front().forward.complete)
    return study + "stopped early: " + result.branches.front().forward.reason;
  if (point_at(result, at).values == nullptr)
    return study + "has no point \"" + at + "\"; " + points_of(result);
  return "";
}

std::string loss_before(const StudyResult& result, const std::string& at) {
  const ResultPoint point = point_at(result, at);
  if (point.branch == nullptr || point.branch != &result.branches.front()) return "";
  const auto index = std::ranges::find(result.quantities, "index", &Quantity::name);
  if (index == result.quantities.end()) return "";
  const auto column = static_cast<std::size_t>(index - result.quantities.begin());
  const auto is_unstable = [&](std::size_t row) {
    return point.branch->samples[row].values[column] > 0;
  };
  const std::size_t start = point.branch->start_row;
  if (is_unstable(start)) return "";
  const bool forward = point.row > start;
  std::string last;  // special point so far
  for (std::size_t row = start; row != point.row;) {
    forward ? ++row : --row;
    if (is_unstable(row)) return last;
    if (!point.branch->samples[row].event.empty()) last = point.branch->samples[row].event;
  }
  return "";
}

NamedValues state_at(const StudyResult& result, const std::string& at) {
  const std::vector<double>& values = *point_at(result, at).values;
  NamedValues state;
  for (std::size_t i = 0; i < std::min(values.size(), result.quantities.size()); ++i)
    state[result.quantities[i].name] = values[i];
  return state;
}

std::string label_near(const StudyResult& result, const NamedValues& state) {
  constexpr double much_nearer = 0.25;
  constexpr double none = std::numeric_limits<double>::infinity();
  double least = none, next = none;
  std::string nearest;
  for (const Equilibrium& found : result.equilibria->list) {
    if (found.label.empty()) continue;
    double square = 0;
    for (std::size_t i = 0; i < result.quantities.size(); ++i) {
      const auto known = state.find(result.quantities[i].name);
      if (known == state.end()) continue;
      const double part = (found.sample.values[i] - known->second) / (1 + std::abs(known->second));
      if (std::isfinite(part)) square += part * part;
    }
    if (square < least) {
      next = std::exchange(least, square);
      nearest = found.label;
    } else {
      next = std::min(next, square);
    }
  }
  return std::sqrt(least) < much_nearer * std::sqrt(next) ? nearest : std::string{};
}

std::string way_to(const StudyResult& result, const std::string& at) {
  const ResultPoint point = point_at(result, at);
  std::string way = point.piece;
  if (point.branch == nullptr) return way;
  const auto [first, last] = std::minmax(point.branch->start_row, point.row);
  way += " branch " + std::to_string(point.branch - result.branches.data());
  for (const Event& event : point.branch->events)
    if (first <= event.row && event.row <= last) way += " " + code_of(event.kind);
  return way;
}

std::vector<model::Load> kept_loads(const Earlier& earlier, const model::Mechanism& mechanism,
                                    const Study& study, const NamedValues& state) {
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

std::vector<model::Load> holding_forces(const std::vector<Released>& released,
                                        const NamedValues& state) {
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

void put_in_state(const NamedValues& state, const std::vector<std::string>& held,
                  model::Mechanism& mechanism) {
  const bool counts =
      std::any_of(mechanism.shape_springs.begin(), mechanism.shape_springs.end(),
                  [](const auto& s) { return s.shape.kind == model::ShapeKind::angle; });
  if (!counts) return put_poses(state, held, mechanism);
  const statics::System before = statics::prepare(mechanism);
  put_poses(state, held, mechanism);
  const statics::System after = statics::prepare(mechanism);
  for (std::size_t i = 0; i < mechanism.shape_springs.size(); ++i)
    mechanism.shape_springs[i].shape.near += after.shapes[i].turned - before.shapes[i].turned;
}

}  // namespace springfold::analysis
