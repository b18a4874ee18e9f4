#include "commanded.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "analysis/undefined.hpp"
#include "point_quantities.hpp"
#include "shape_units.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/inertia.hpp"
#include "springfold/core/number_text.hpp"
#include "springfold/model/rotation_vector.hpp"

namespace springfold::analysis {
namespace {

const std::vector<const char*>& wrench_names(model::TaskSpace space) {
  static const std::vector<const char*> xy{"Fx", "Fy"}, planar{"Fx", "Fy", "Mz"},
      xyz{"Fx", "Fy", "Fz"}, spatial{"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
  switch (space) {
    case model::TaskSpace::xy:
      return xy;
    case model::TaskSpace::planar:
      return planar;
    case model::TaskSpace::xyz:
      return xyz;
    case model::TaskSpace::spatial:
      return spatial;
  }
  return xy;
}

const model::Body& body_of(const CommandSetup& setup) {
  return setup.system.mechanism.bodies[static_cast<std::size_t>(setup.task.body - 1)];
}

Index lengths_of(const CommandSetup& setup) { return translations(body_of(setup).task_space); }

std::vector<QuantityDefinition> at_points(const CommandSetup& setup) {
  std::vector<QuantityDefinition> list;
  add_point_quantities(setup.system, setup.scales, list);
  return list;
}

/// Smallest and largest eigenvalue of a symmetric block.
void add_extremes(const Matrix& M, Index first, Index count, double scale,
                  std::vector<double>& values) {
  if (M.size() == 0) {
    values.insert(values.end(), 2, undefined);
    return;
  }
  const Matrix block = M.block(first, first, count, count);
  const Vector extremes = symmetric_eigenvalues(0.5 * (block + block.transpose()));
  values.push_back(scale * extremes[0]);
  values.push_back(scale * extremes[count - 1]);
}

/// Factors in the units of the case; condition: largest over smallest.
void add_factors(const CommandSetup& setup, const CommandedState& state,
                 std::vector<double>& values) {
  const Index lengths = lengths_of(setup);
  Matrix velocity, force;
  if (state.plain.closed) {
    const statics::Transmission at =
        transmission(setup.system, setup.task, state.plain.z, state.plain.rho);
    Vector command(static_cast<Index>(setup.task.commands.size()));
    for (Index k = 0; k < command.size(); ++k)
      command[k] = setup.command_scale[setup.task.commands[static_cast<std::size_t>(k)]];
    if (at.velocity.size() > 0)
      velocity = setup.pose_scale.asDiagonal() * at.velocity * command.cwiseInverse().asDiagonal();
    if (at.force.size() > 0)
      force = setup.pose_scale.cwiseInverse().asDiagonal() * at.force * command.asDiagonal();
  }
  const auto add = [&](Index first, Index count, bool with_condition) {
    for (const Matrix* M : {&velocity, &force}) {
      const auto [smallest, largest] =
          statics::factors_of(M->size() > 0 ? Matrix(M->middleRows(first, count)) : Matrix());
      values.push_back(smallest);
      values.push_back(largest);
      if (with_condition && M == &force) {
        const std::size_t n = values.size();
        values.push_back(values[n - 3] / values[n - 4]);
      }
    }
  };
  add(0, lengths, true);
  if (setup.d > lengths) add(lengths, setup.d - lengths, true);
}

double quadratic(const Matrix& M, const Vector& direction) {
  return M.size() == 0 ? undefined : direction.dot(M * direction);
}

void add_stiffness(const CommandSetup& setup, const std::vector<Vector>& directions,
                   const BodyStiffness& at, std::vector<double>& values) {
  const Index lengths = lengths_of(setup), angles = setup.d - lengths;
  const double k = setup.scales.force / setup.scales.length, m = setup.scales.moment();
  add_extremes(at.K, 0, lengths, k, values);
  add_extremes(at.C, 0, lengths, 1 / k, values);
  if (angles > 0) {
    add_extremes(at.K, lengths, angles, m, values);
    add_extremes(at.C, lengths, angles, 1 / m, values);
  }
  for (const Vector& direction : directions) {
    // A direction is measured along its translation, or along its rotation if it has none.
    Vector along = direction;
    const bool moves = !direction.head(lengths).isZero(0);
    (moves ? along.tail(angles) : along.head(lengths)).setZero();
    values.push_back((moves ? k : m) * quadratic(at.K, along));
    values.push_back((moves ? 1 / k : 1 / m) * quadratic(at.C, along));
  }
}

void add_state_columns(const CommandSetup& setup, std::vector<Quantity>& columns) {
  const statics::System& system = setup.system;
  const auto add_unknown = [&](Index i) {
    columns.push_back(
        {system.coordinate_names[static_cast<std::size_t>(i)], unit_of_unknown(system, i)});
  };
  for (Index i = system.first_pose; i < system.size; ++i) add_unknown(i);
  for (Index i = 0; i < system.first_pose; ++i)
    if (!system.is_wrench[static_cast<std::size_t>(i)]) add_unknown(i);
  for (const char* ending : {".rho", ".plain", ".compensation"})
    for (std::size_t i = 0; i < system.command_names.size(); ++i)
      columns.push_back({system.command_names[i] + ending,
                         system.command_is_length[i] ? Unit::length : Unit::angle});
  for (Index i = 0; i < system.first_pose; ++i)
    if (system.is_wrench[static_cast<std::size_t>(i)]) add_unknown(i);
  for (const QuantityDefinition& q : at_points(setup)) columns.push_back({q.name, q.unit});
  Index i = 0;
  for (const char* name : wrench_names(body_of(setup).task_space))
    columns.push_back(
        {std::string("residual.") + name, i++ < lengths_of(setup) ? Unit::force : Unit::moment});
}

void add_state_values(const CommandSetup& setup, const CommandedState& state, const Vector& r,
                      std::vector<double>& values) {
  const statics::System& system = setup.system;
  const Vector scale = unknown_scales(system, setup.scales);
  const auto add_unknown = [&](Index i) { values.push_back(scale[i] * state.z[i]); };
  for (Index i = system.first_pose; i < system.size; ++i) add_unknown(i);
  for (Index i = 0; i < system.first_pose; ++i)
    if (!system.is_wrench[static_cast<std::size_t>(i)]) add_unknown(i);
  const Vector& rho = state.inputs.rho;
  const bool comparable = state.plain.closed && state.plain.unique;
  for (Index i = 0; i < rho.size(); ++i) values.push_back(setup.command_scale[i] * rho[i]);
  for (Index i = 0; i < rho.size(); ++i)
    values.push_back(comparable ? setup.command_scale[i] * state.plain.rho[i] : undefined);
  for (Index i = 0; i < rho.size(); ++i)
    values.push_back(comparable ? setup.command_scale[i] * (rho[i] - state.plain.rho[i])
                                : undefined);
  for (Index i = 0; i < system.first_pose; ++i)
    if (system.is_wrench[static_cast<std::size_t>(i)]) add_unknown(i);
  for (const QuantityDefinition& q : at_points(setup))
    values.push_back(point_quantity(system, q, state.z, state.inputs).value_or(undefined));
  for (Index i = 0; i < setup.d; ++i)
    values.push_back(setup.wrench_scale[i] * (r.size() > 0 ? r[setup.t + i] : undefined));
}

/// Twists of all bodies in world axes from the rates of their pose coordinates.
Matrix twists_of_rates(const statics::System& system, const Vector& z) {
  Matrix J = Matrix::Identity(system.load_size, system.load_size);
  for (std::size_t b = 0; b < system.body_slices.size(); ++b) {
    if (system.mechanism.bodies[b].task_space != model::TaskSpace::spatial) continue;
    const statics::BodySlice& body = system.body_slices[b];
    const model::Vec3<double> phi = z.segment(body.t + 3, 3);
    J.block(body.W + 3, body.W + 3, 3, 3) = model::left_jacobian(phi);
  }
  return J;
}

double count(const std::optional<Index>& n) { return n ? static_cast<double>(*n) : undefined; }

}  // namespace

Vector CommandSetup::target_of(const Vector& physical) const {
  Vector target(physical.size());
  for (Index k = 0; k < target.size(); ++k)
    target[k] = physical[k] / pose_scale[task.prescribed[static_cast<std::size_t>(k)]];
  return target;
}

Vector CommandSetup::load_of(const Vector& physical) const {
  Vector load = W;
  if (physical.size() > 0)
    load.segment(system.body_slices[static_cast<std::size_t>(task.body - 1)].W, d) +=
        physical.cwiseQuotient(wrench_scale);
  return load;
}

CommandSetup command_setup(const model::Mechanism& mechanism, const Study& study,
                           const Vector& constant_load) {
  CommandSetup setup;
  setup.scales = scales_for(mechanism, constant_load);
  setup.system = statics::prepare(dimensionless(mechanism, setup.scales));
  const auto b = static_cast<std::size_t>(study.body - 1);
  const statics::BodySlice& body = setup.system.body_slices[b];
  setup.t = body.t;
  setup.d = body.count;
  const model::TaskSpace space = setup.system.mechanism.bodies[b].task_space;
  setup.pose_scale = pose_scales(space, setup.scales);
  setup.wrench_scale = wrench_scales(space, setup.scales);
  setup.pose = setup.system.mechanism.bodies[b].pose;
  setup.task.body = study.body;
  setup.task.prescribed = study.command.prescribed;
  const auto& names = setup.system.command_names;
  for (const std::string& name : study.command.commands) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) setup.task.commands.push_back(found - names.begin());
  }
  setup.task = completed(setup.task, setup.system);
  setup.command_scale.resize(std::ssize(names));
  for (std::size_t i = 0; i < names.size(); ++i)
    setup.command_scale[static_cast<Index>(i)] =
        setup.system.command_is_length[i] ? setup.scales.length : 1;
  setup.W = Vector::Zero(setup.system.load_size);
  if (constant_load.size() > 0)
    setup.W.segment(body.W, body.count) = constant_load.cwiseQuotient(setup.wrench_scale);
  return setup;
}

std::vector<Quantity> command_columns(const CommandSetup& setup,
                                      const std::vector<Vector>& directions) {
  std::vector<Quantity> columns;
  add_state_columns(setup, columns);
  const bool turns = setup.d > lengths_of(setup);
  for (const char* part : {"trans", "rot"}) {
    const bool rotation = part[0] == 'r';
    if (rotation && !turns) continue;
    for (const char* matrix : {"K_", "C_"})
      for (const char* end : {"_min", "_max"})
        columns.push_back({std::string(matrix) + part + end,
                           matrix[0] == 'C'
                               ? (rotation ? Unit::rotational_compliance : Unit::compliance)
                               : (rotation ? Unit::rotational_stiffness : Unit::stiffness)});
  }
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const std::string number = i == 0 ? "" : "_" + std::to_string(i + 1);
    const bool moves = !directions[i].head(lengths_of(setup)).isZero(0);
    columns.push_back({"stiffness" + number, moves ? Unit::stiffness : Unit::rotational_stiffness});
    columns.push_back(
        {"compliance" + number, moves ? Unit::compliance : Unit::rotational_compliance});
  }
  for (const char* part : {"", "_rot"}) {
    if (*part != 0 && !turns) continue;
    for (const char* name : {"velocity", "force"})
      for (const char* end : {"_min", "_max"})
        columns.push_back({std::string(name) + part + end, Unit::none});
    columns.push_back({std::string("condition") + part, Unit::none});
  }
  for (const char* name : {"index_pose", "index_force", "index", "iterations"})
    columns.push_back({name, Unit::none});
  columns.push_back({"energy", Unit::energy});
  return columns;
}

BodyStiffness body_stiffness(const CommandSetup& setup, const Vector& z, const Matrix& A_full) {
  const statics::System& system = setup.system;
  BodyStiffness at;
  const statics::PlatformStiffness platform = platform_stiffness(system, A_full);
  const Index first = setup.t - system.first_pose;
  Matrix all;  // compliance of all bodies in world axes
  if (platform.K.size() > 0) {
    const Matrix K = in_world_axes(system, z, platform.K);
    if (system.load_size == setup.d) at.K = K;
    const FullPivotLu lu(K);
    if (lu.is_invertible()) all = lu.inverse();
  } else {  // rigid chains
    Matrix unit = Matrix::Zero(system.size, system.load_size);
    unit.middleRows(system.first_pose, system.load_size).setIdentity();
    if (const auto X = solve_symmetric(A_full, unit)) {
      const Matrix J = twists_of_rates(system, z);
      all = J * X->middleRows(system.first_pose, system.load_size) * J.transpose();
    }
  }
  if (all.size() == 0) return at;
  at.C = all.block(first, first, setup.d, setup.d);
  if (at.K.size() == 0 && platform.K.size() > 0) {
    const FullPivotLu lu(at.C);
    if (lu.is_invertible()) at.K = lu.inverse();
  }
  return at;
}

CommandedValues command_values(const CommandSetup& setup, const std::vector<Vector>& directions,
                               const CommandedState& state) {
  CommandedValues result;
  std::vector<double>& values = result.values;
  statics::Workspace work;
  Vector r;
  Matrix A;
  BodyStiffness stiffness;
  statics::Stability stability;
  if (equilibrium_matrix(setup.system, state.piece, state.z, state.inputs, work, r, A)) {
    stiffness = body_stiffness(setup, state.z, A);
    if (has_potential(setup.system, state.inputs))
      stability = statics::stability(setup.system, A, work);
  }
  add_state_values(setup, state, r, values);
  add_stiffness(setup, directions, stiffness, values);
  add_factors(setup, state, values);
  values.push_back(count(stability.pose_controlled));
  values.push_back(count(stability.force_controlled));
  values.push_back(count(stability.force_controlled));
  values.push_back(state.iterations);
  values.push_back(setup.scales.moment() * spring_energy(setup.system, state.z, state.inputs.rho));
  result.index_force = stability.force_controlled;
  result.countable = has_potential(setup.system, state.inputs);
  assert(values.size() == command_columns(setup, directions).size());
  return result;
}

statics::KinematicInverse approach(const CommandSetup& setup, const Vector& target,
                                   const statics::KinematicInverse& from) {
  // In the mechanism's own lengths and radians; poses that are very far away are out of reach, in whatever strides.
  constexpr double stride = 0.25, most = 1000;
  Vector here(target.size());
  for (Index k = 0; k < here.size(); ++k)
    here[k] = from.z[setup.t + setup.task.prescribed[static_cast<std::size_t>(k)]];
  const Vector way = target - here;
  const int steps = static_cast<int>(std::clamp(std::ceil(way.norm() / stride), 1.0, most));
  statics::KinematicInverse at = from;
  for (int i = 1; i <= steps; ++i) {
    const Vector next = i == steps ? target : Vector(here + way * (static_cast<double>(i) / steps));
    statics::KinematicInverse reached =
        kinematic_inverse(setup.system, setup.task, next, at.z, at.rho);
    if (i == steps || reached.closed) at = std::move(reached);
  }
  return at;
}

statics::KinematicInverse at_own_pose(const CommandSetup& setup) {
  Vector target(std::ssize(setup.task.prescribed));
  for (Index k = 0; k < target.size(); ++k)
    target[k] = setup.pose[setup.task.prescribed[static_cast<std::size_t>(k)]];
  return kinematic_inverse(setup.system, setup.task, target, statics::guess(setup.system),
                           setup.system.commands);
}

NodeState state_of(const CommandedValues& at) {
  if (!at.countable) return NodeState::stable;
  if (!at.index_force) return NodeState::critical;
  return *at.index_force > 0 ? NodeState::unstable : NodeState::stable;
}

std::string status_of(const CommandedValues& at) {
  const NodeState state = state_of(at);
  return state == NodeState::stable ? "ok" : state == NodeState::unstable ? "unstable" : "critical";
}

}  // namespace springfold::analysis
