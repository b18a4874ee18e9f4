#include "springfold/statics/system.hpp"

#include <algorithm>
#include <cassert>

#include "form.hpp"
#include "shape_terms.hpp"
#include "springfold/model/axis_of_turn.hpp"
#include "springfold/statics/prepare_again.hpp"
#include "turn_moment.hpp"

namespace springfold::statics {
namespace {

using model::TaskSpace;

std::vector<std::string> wrench_names(TaskSpace space) {
  switch (space) {
    case TaskSpace::xy:
      return {"Fx", "Fy"};
    case TaskSpace::planar:
      return {"Fx", "Fy", "Mz"};
    case TaskSpace::xyz:
      return {"Fx", "Fy", "Fz"};
    case TaskSpace::spatial:
      return {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
  }
  return {};
}

void add_unknown(System& system, std::string name, bool length, bool wrench) {
  system.coordinate_names.push_back(std::move(name));
  system.is_length.push_back(length);
  system.is_wrench.push_back(wrench);
  ++system.size;
}

void add_spring(System& system, const model::SpringLaw& law, Index coordinate,
                const std::string& name) {
  CoordinateSpring spring{coordinate, name, model::compile(law),
                          static_cast<Index>(system.switches.size())};
  for (const double b : spring.law.breakpoints)
    system.switches.push_back({coordinate, b, system.springs.size()});
  system.springs.push_back(std::move(spring));
}

/// @param coordinates  per element of the chain: its unknown in z, or -1
void add_coupled(System& system, const model::Chain& chain, const std::vector<Index>& coordinates) {
  for (const model::CoupledSpring& spring : chain.coupled_springs) {
    CoordinateGroup group{.stiffness = spring.stiffness, .free = spring.free};
    for (const std::size_t element : spring.elements)
      group.coordinates.push_back(coordinates[element]);
    system.coupled.push_back(std::move(group));
  }
}

void add_chain(System& system, const model::Chain& chain) {
  ChainSlice slice;
  slice.x = system.size;
  std::vector<double> commands(system.commands.begin(), system.commands.end());
  std::vector<Index> coordinates;
  for (const model::Element& element : chain.elements) {
    coordinates.push_back(-1);
    const auto* joint = std::get_if<model::Joint>(&element);
    if (joint == nullptr) continue;
    const bool length = joint->kind == model::JointKind::prismatic;
    slice.joint_coordinate.push_back(has_coordinate(*joint) ? system.size : -1);
    slice.joint_command.push_back(
        joint->role == model::JointRole::actuated ? static_cast<Index>(commands.size()) : -1);
    if (joint->role == model::JointRole::actuated) {
      commands.push_back(joint->command);
      system.command_names.push_back(chain.name + "." + joint->name);
      system.command_is_length.push_back(length);
    }
    if (!has_coordinate(*joint)) continue;
    coordinates.back() = system.size;
    const std::string name = chain.name + "." + coordinate_name(*joint);
    if (joint->spring) add_spring(system, *joint->spring, system.size, name);
    add_unknown(system, name, length, false);
  }
  slice.x_count = system.size - slice.x;
  add_coupled(system, chain, coordinates);
  system.commands = Eigen::Map<const Vector>(commands.data(), static_cast<Index>(commands.size()));

  slice.F = system.size;
  const TaskSpace space = task_space_of(system.mechanism, chain);
  slice.F_count = dimension(space);
  Index i = 0;
  for (const std::string& name : wrench_names(space))
    add_unknown(system, chain.name + "." + name, i++ < translations(space), true);
  system.chain_slices.push_back(std::move(slice));
  system.chains.push_back(compile(system.mechanism, chain));
}

/// Springs in series of shapes: an unknown and a spring for each but the last one.
void add_inner(System& system) {
  system.first_inner = system.size;
  for (const model::ShapeSpring& spring : system.mechanism.shape_springs)
    for (std::size_t i = 0; i < spring.before.size(); ++i) {
      const std::string name = series_name(spring, i);
      const bool angle = spring.shape.kind == model::ShapeKind::angle ||
                         spring.shape.kind == model::ShapeKind::dihedral;
      add_spring(system, spring.before[i].law, system.size, name);
      add_unknown(system, name, !angle, false);
    }
}

void place_variables(const model::CompiledChain& chain, ChainSlice& slice) {
  for (Index i = 0; i < chain.first_joint(); ++i) slice.z_of.push_back(slice.from + i);
  slice.z_of.insert(slice.z_of.end(), slice.joint_coordinate.begin(), slice.joint_coordinate.end());
  for (Index i = 0; i < chain.to_count(); ++i) slice.z_of.push_back(slice.to + i);
  slice.rho_of.assign(slice.z_of.size(), -1);
  std::copy(slice.joint_command.begin(), slice.joint_command.end(),
            slice.rho_of.begin() + chain.first_joint());
}

/// The variables of a point: those of the body where its way begins, then joints of its chain.
void place_point(const System& system, const model::Anchor& anchor, PointSlice& slice) {
  const Index body = anchor.chain >= 0
                         ? system.mechanism.chains[static_cast<std::size_t>(anchor.chain)].from
                         : anchor.body;
  const model::CompiledPoint& point = slice.point;
  slice.body = body;
  if (body > 0) {
    const BodySlice& b = system.body_slices[static_cast<std::size_t>(body - 1)];
    for (Index i = 0; i < b.count; ++i) slice.z.push_back(b.t + i);
    slice.rho.assign(slice.z.size(), -1);
  }
  for (std::size_t j = 0; j < point.joints.size(); ++j) {
    const ChainSlice& chain = system.chain_slices[static_cast<std::size_t>(anchor.chain)];
    slice.z.push_back(chain.joint_coordinate[j]);
    slice.rho.push_back(chain.joint_command[j]);
  }
}

std::size_t add_point(System& system, const model::Anchor& anchor, std::string name) {
  PointSlice slice{.name = std::move(name), .point = compile(system.mechanism, anchor)};
  place_point(system, anchor, slice);
  system.points.push_back(std::move(slice));
  return system.points.size() - 1;
}

void add_weight(System& system, std::size_t point, double mass) {
  system.loads.push_back({.point = point, .vector = mass * system.mechanism.gravity});
}

/// A load on what can turn about one direction only: what nothing turns is a fixed load, other moments have a potential
/// where the model says so.
void keep_potential(const System& system, const model::AxesOfTurn& turns, const model::Load& load,
                    PointLoad& own) {
  const PointSlice& slice = system.points[own.point];
  if (slice.body == 0) return;
  const auto& turn = turns[static_cast<std::size_t>(slice.body - 1)];
  if (!turn) return;
  if (const auto fixed = load.follows ? unturned(*turn, slice.point, load.vector) : std::nullopt) {
    own.follows = false;
    own.vector = *fixed;
  }
  own.about_one_axis =
      own.kind == model::LoadKind::moment && is_conservative(system.mechanism, turns, load);
}

/// All chain points, so that named ones can be watched, then what acts on them and elsewhere.
void add_points(System& system) {
  const model::Mechanism& mechanism = system.mechanism;
  const bool weighs = !mechanism.gravity.isZero(0);
  for (std::size_t i = 0; i < mechanism.chains.size(); ++i) {
    const auto& points = mechanism.chains[i].points;
    for (std::size_t p = 0; p < points.size(); ++p) {
      const std::string& own = points[p].name;
      const std::size_t point = add_point(system, {.chain = static_cast<Index>(i), .point = p},
                                          own.empty() ? own : mechanism.chains[i].name + "." + own);
      if (weighs && points[p].mass != 0) add_weight(system, point, points[p].mass);
    }
  }
  for (std::size_t b = 0; b < mechanism.bodies.size(); ++b) {
    const model::Body& body = mechanism.bodies[b];
    if (!weighs || body.mass == 0) continue;
    const model::Anchor at{.body = static_cast<Index>(b + 1), .at = body.centre};
    add_weight(system, add_point(system, at, ""), body.mass);
  }
  const auto turns = set_body_turns(system);
  for (std::size_t i = 0; i < mechanism.loads.size(); ++i) {
    const model::Load& load = mechanism.loads[i];
    if (load.kind == model::LoadKind::pressure) continue;  // add_shapes
    const std::size_t point = add_point(system, load.on, "");
    system.loads.push_back({point, load.kind, load.follows, static_cast<Index>(i), load.vector});
    keep_potential(system, turns, load, system.loads.back());
  }
  for (const model::LineSpring& spring : mechanism.line_springs) {
    const std::size_t from = add_point(system, spring.from, "");
    const std::size_t to = add_point(system, spring.to, "");
    system.line_springs.push_back({from, to, spring.stiffness, spring.free});
    system.chains_coupled |=
        spring.from.chain >= 0 && spring.to.chain >= 0 && spring.from.chain != spring.to.chain;
  }
}

std::vector<std::size_t> add_shape_points(System& system, const model::Shape& shape) {
  std::vector<std::size_t> points;
  Index chain = -1;
  for (const model::Anchor& anchor : shape.points) {
    points.push_back(add_point(system, anchor, ""));
    system.chains_coupled |= anchor.chain >= 0 && chain >= 0 && anchor.chain != chain;
    if (anchor.chain >= 0) chain = anchor.chain;
  }
  return points;
}

/// Behind everything else: the switches of joints stand first.
void add_shapes(System& system) {
  const model::Mechanism& mechanism = system.mechanism;
  Index inner = system.first_inner;
  for (const model::ShapeSpring& spring : mechanism.shape_springs) {
    PointShape shape{.name = spring.name, .shape = compile(mechanism, spring.shape)};
    shape.points = add_shape_points(system, spring.shape);
    system.chains_coupled |=
        !spring.before.empty() &&
        std::any_of(spring.shape.points.begin(), spring.shape.points.end(),
                    [](const model::Anchor& anchor) { return anchor.chain >= 0; });
    shape.gas = spring.gas;
    shape.inner = inner;
    shape.inner_count = std::ssize(spring.before);
    shape.offset = spring.offset;
    inner += shape.inner_count;
    if (!spring.gas) shape.law = model::compile(spring.law);
    shape.first_switch = static_cast<Index>(system.switches.size());
    for (const double b : shape.law.breakpoints)
      system.switches.push_back({-1, b, system.shapes.size()});
    system.shapes.push_back(std::move(shape));
  }
  for (std::size_t i = 0; i < mechanism.loads.size(); ++i) {
    const model::Load& load = mechanism.loads[i];
    if (load.kind != model::LoadKind::pressure) continue;
    PointShape shape{.name = load.name, .shape = compile(mechanism, load.shape)};
    shape.points = add_shape_points(system, load.shape);
    shape.load = static_cast<Index>(i);
    shape.pressure = load.vector[0];
    system.shapes.push_back(std::move(shape));
  }
}

std::size_t segment_in(const model::CompiledSpring& law, Index first_switch, const Piece& piece) {
  std::size_t segment = 0;
  for (std::size_t i = 0; i < law.breakpoints.size(); ++i)
    if (piece[static_cast<std::size_t>(first_switch) + i] > 0) ++segment;
  return segment;
}

/// Springs on coordinates, coupled springs, commands and chains anew in their places.
void renew_chains(System& system) {
  const model::Mechanism& mechanism = system.mechanism;
  std::size_t spring = 0, group = 0;
  Index command = 0;
  system.switches.clear();
  const auto renew = [&](const model::SpringLaw& law) {
    CoordinateSpring& own = system.springs[spring];
    own.law = model::compile(law);
    own.first_switch = static_cast<Index>(system.switches.size());
    for (const double b : own.law.breakpoints)
      system.switches.push_back({own.coordinate, b, spring});
    ++spring;
  };
  for (std::size_t i = 0; i < mechanism.chains.size(); ++i) {
    const model::Chain& chain = mechanism.chains[i];
    for (const model::Element& element : chain.elements) {
      const auto* joint = std::get_if<model::Joint>(&element);
      if (joint == nullptr) continue;
      if (joint->role == model::JointRole::actuated) system.commands[command++] = joint->command;
      if (joint->spring && has_coordinate(*joint)) renew(*joint->spring);
    }
    for (const model::CoupledSpring& coupled : chain.coupled_springs) {
      system.coupled[group].stiffness = coupled.stiffness;
      system.coupled[group++].free = coupled.free;
    }
    system.chains[i] = compile(mechanism, chain);
  }
  for (const model::ShapeSpring& shape : mechanism.shape_springs)
    for (const model::SeriesSpring& inner : shape.before) renew(inner.law);
}

void add_what_acts(System& system) {
  add_points(system);
  add_shapes(system);
  count_turns_from(guess(system), system);
}

}  // namespace

std::vector<std::string> pose_names(TaskSpace space) {
  switch (space) {
    case TaskSpace::xy:
      return {"x", "y"};
    case TaskSpace::planar:
      return {"x", "y", "phi"};
    case TaskSpace::xyz:
      return {"x", "y", "z"};
    case TaskSpace::spatial:
      return {"x", "y", "z", "rx", "ry", "rz"};
  }
  return {};
}

Index System::closure_count() const {
  Index count = 0;
  for (const ChainSlice& slice : chain_slices) count += slice.F_count;
  return count;
}

System prepare(const model::Mechanism& mechanism) {
  System system;
  system.mechanism = mechanism;
  for (const model::Chain& chain : mechanism.chains) add_chain(system, chain);
  add_inner(system);
  system.first_pose = system.size;
  for (const model::Body& body : mechanism.bodies) {
    system.body_slices.push_back({system.size, dimension(body.task_space), system.load_size});
    Index i = 0;
    for (const std::string& name : pose_names(body.task_space))
      add_unknown(system, body.name + "." + name, i++ < translations(body.task_space), false);
    system.load_size += dimension(body.task_space);
  }
  for (std::size_t i = 0; i < mechanism.chains.size(); ++i) {
    const auto pose_of = [&](Index body) {
      return body > 0 ? system.body_slices[static_cast<std::size_t>(body - 1)].t : Index{-1};
    };
    system.chain_slices[i].from = pose_of(mechanism.chains[i].from);
    system.chain_slices[i].to = pose_of(mechanism.chains[i].to);
    place_variables(system.chains[i], system.chain_slices[i]);
  }
  add_what_acts(system);
  return system;
}

System prepare(model::Mechanism mechanism, System old) {
  if (!has_form_of(old.mechanism, mechanism)) return prepare(mechanism);
  old.mechanism = std::move(mechanism);
  renew_chains(old);
  old.points.clear();
  old.loads.clear();
  old.line_springs.clear();
  old.shapes.clear();
  old.chains_coupled = false;
  old.redundant = 0;
  add_what_acts(old);
  return old;
}

Vector guess(const System& system) {
  Vector z = Vector::Zero(system.size);
  for (std::size_t i = 0; i < system.chain_slices.size(); ++i) {
    const ChainSlice& slice = system.chain_slices[i];
    std::size_t j = 0;
    for (const model::Element& element : system.mechanism.chains[i].elements) {
      const auto* joint = std::get_if<model::Joint>(&element);
      if (joint == nullptr) continue;
      if (slice.joint_coordinate[j] >= 0) z[slice.joint_coordinate[j]] = joint->initial;
      ++j;
    }
  }
  Index inner = system.first_inner;
  for (const model::ShapeSpring& spring : system.mechanism.shape_springs)
    for (const model::SeriesSpring& own : spring.before)
      z[inner++] = own.initial ? *own.initial : relaxed_coordinate(model::compile(own.law), 0);
  for (std::size_t b = 0; b < system.body_slices.size(); ++b)
    z.segment(system.body_slices[b].t, system.body_slices[b].count) =
        system.mechanism.bodies[b].pose;
  return z;
}

Piece piece_at(const System& system, const Vector& z, const Vector& rho) {
  Vector values(std::ssize(system.switches));
  put_switch_values(system, 0, z, rho, values);
  Piece piece;
  for (const double value : values) piece.push_back(value >= 0 ? std::int8_t{1} : std::int8_t{-1});
  return piece;
}

Piece piece_at(const System& system, const Vector& z) {
  return piece_at(system, z, system.commands);
}

std::size_t segment_of(const CoordinateSpring& spring, const Piece& piece) {
  return segment_in(spring.law, spring.first_switch, piece);
}

std::size_t segment_of(const PointShape& shape, const Piece& piece) {
  return segment_in(shape.law, shape.first_switch, piece);
}

}  // namespace springfold::statics
