#include "scales.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "dimensionless_parts.hpp"
#include "shape_units.hpp"
#include "springfold/core/scaling.hpp"
#include "units.hpp"

namespace springfold::analysis {
namespace {

using model::Joint;
using model::JointKind;

template <class Visit>
void for_each_joint(const model::Mechanism& mechanism, const Visit& visit) {
  for (const model::Chain& chain : mechanism.chains)
    for (const model::Element& element : chain.elements)
      if (const auto* joint = std::get_if<Joint>(&element)) visit(*joint);
}

/// Positions at which a law bends, to be counted among the lengths of prismatic joints.
std::vector<double> positions_of(const model::SpringLaw& law) {
  const model::CompiledSpring spring = model::compile(law);
  std::vector<double> positions = spring.breakpoints;
  for (const auto& segment : spring.segments) positions.push_back(segment.anchor);
  return positions;
}

/// Is coordinate i of the spring a length?
bool slides(const model::Chain& chain, const model::CoupledSpring& spring, std::size_t i) {
  return std::get<Joint>(chain.elements[spring.elements[i]]).kind == JointKind::prismatic;
}

/// Every shape of a spring or a pressure.
template <class Mechanism, class Visit>
void for_each_shape(Mechanism& mechanism, const Visit& visit) {
  for (auto& spring : mechanism.shape_springs) visit(spring.shape);
  for (auto& load : mechanism.loads)
    if (load.kind == model::LoadKind::pressure) visit(load.shape);
}

/// Lengths of points, loads and line springs.
template <class Visit>
void for_each_point_length(const model::Mechanism& mechanism, const Visit& visit) {
  for (const model::Body& body : mechanism.bodies)
    if (body.mass != 0) visit(body.centre.norm());
  for (const model::Chain& chain : mechanism.chains)
    for (const model::ChainPoint& point : chain.points) visit(point.at.norm());
  for (const model::Load& load : mechanism.loads) visit(load.on.at.norm());
  for (const model::LineSpring& spring : mechanism.line_springs)
    for (const double length : {spring.from.at.norm(), spring.to.at.norm(), spring.free})
      visit(length);
  for_each_shape(mechanism, [&](const model::Shape& shape) {
    for (const model::Anchor& point : shape.points) visit(point.at.norm());
  });
  for (const model::ShapeSpring& spring : mechanism.shape_springs) {
    if (spring.gas || length_power(spring.shape.kind) != 1) continue;
    visit(spring.offset);
    for (const double position : positions_of(spring.law)) visit(position);
    for (const model::SeriesSpring& inner : spring.before)
      for (const double position : positions_of(inner.law)) visit(position);
  }
}

double largest_length(const model::Mechanism& mechanism) {
  double largest = 0;
  const auto add = [&largest](double length) { largest = std::max(largest, std::abs(length)); };
  for_each_point_length(mechanism, add);
  for (const model::Body& body : mechanism.bodies)
    for (Index i = 0; i < model::translations(body.task_space); ++i) add(body.pose[i]);
  for (const model::Chain& chain : mechanism.chains) {
    add(chain.from_attachment.p.norm());
    add(chain.to_attachment.p.norm());
    for (const model::Element& element : chain.elements)
      if (const auto* link = std::get_if<model::RigidLink>(&element)) add(link->transform.p.norm());
  }
  for_each_joint(mechanism, [&](const Joint& joint) {
    if (joint.kind != JointKind::prismatic) return;
    add(joint.initial);
    add(joint.command);
    if (!joint.spring) return;
    for (const double position : positions_of(*joint.spring)) add(position);
  });
  for (const model::Chain& chain : mechanism.chains)
    for (const model::CoupledSpring& spring : chain.coupled_springs)
      for (std::size_t i = 0; i < spring.elements.size(); ++i)
        if (slides(chain, spring, i)) add(spring.free[static_cast<Index>(i)]);
  return largest;
}

/// Powers of two times the entries: nothing is rounded, symmetry stays.
void make_dimensionless(const model::Chain& chain, const Scales& scales,
                        model::CoupledSpring& spring) {
  Vector coordinate = Vector::Ones(spring.free.size());
  for (std::size_t i = 0; i < spring.elements.size(); ++i)
    if (slides(chain, spring, i)) coordinate[static_cast<Index>(i)] = scales.length;
  // A torque is energy over coordinate: K_ij c_i c_j / energy.
  spring.stiffness = (coordinate.asDiagonal() * spring.stiffness * coordinate.asDiagonal()).eval();
  spring.stiffness /= scales.moment();
  spring.free = spring.free.cwiseQuotient(coordinate).eval();
}

model::SpringLaw dimensionless_law(const Joint& joint, const Scales& scales) {
  const bool slides = joint.kind == JointKind::prismatic;
  return model::scaled(*joint.spring, slides ? scales.length : 1,
                       slides ? scales.force : scales.moment());
}

double dimensionless_command(const Joint& joint, const Scales& scales) {
  return joint.kind == JointKind::prismatic ? joint.command / scales.length : joint.command;
}

model::SpringLaw dimensionless_law(const model::ShapeSpring& spring, const model::SpringLaw& law,
                                   const Scales& scales) {
  const double value = unit_of_value(spring.shape.kind, scales);
  return scaled(law, value, scales.moment() / value);
}

/// Stiffness and free length.
std::pair<double, double> dimensionless_line(const model::LineSpring& spring,
                                             const Scales& scales) {
  return {spring.stiffness * (scales.length / scales.force), spring.free / scales.length};
}

/// Of the vector of a load, in terms of the unit of length and with a force of one scale.
double unit_of_load(const model::Load& load, const Scales& scales) {
  switch (load.kind) {
    case model::LoadKind::force:
      return scales.force;
    case model::LoadKind::moment:
      return scales.moment();
    case model::LoadKind::pressure:
      return unit_of_force(load.shape.kind, scales);
  }
  return 1;
}

/// Sizes of loads and weights as forces: they set the scale where there is no spring.
std::vector<double> load_forces(const model::Mechanism& mechanism, double length) {
  std::vector<double> forces;
  for (const model::Load& load : mechanism.loads)
    forces.push_back(load.vector.norm() / unit_of_load(load, {.length = length}));
  const double gravity = mechanism.gravity.norm();
  for (const model::Body& body : mechanism.bodies) forces.push_back(std::abs(body.mass) * gravity);
  for (const model::Chain& chain : mechanism.chains)
    for (const model::ChainPoint& point : chain.points)
      forces.push_back(std::abs(point.mass) * gravity);
  std::erase(forces, 0.0);
  return forces;
}

/// Of a shape's spring that is stretched by the unit of alpha: energy over length.
void add_forces(const model::ShapeSpring& spring, double length, std::vector<double>& forces) {
  const double unit = unit_of_value(spring.shape.kind, {.length = length});
  if (spring.gas) {
    if (spring.gas->nRT > 0) forces.push_back(spring.gas->nRT / length);
    return;
  }
  const auto add = [&](const model::SpringLaw& law) {
    for (const double k : model::typical_stiffnesses(model::compile(law), unit))
      forces.push_back(k * unit * unit / length);
  };
  for (const model::SeriesSpring& inner : spring.before) add(inner.law);
  add(spring.law);
}

}  // namespace

std::vector<double> spring_forces(const model::Mechanism& mechanism, double length) {
  std::vector<double> forces;
  for_each_joint(mechanism, [&](const Joint& joint) {
    if (!joint.spring) return;
    const bool slides = joint.kind == JointKind::prismatic;
    const double width = slides ? length : 1;
    for (const double k : model::typical_stiffnesses(model::compile(*joint.spring), width))
      forces.push_back(slides ? k * length : k / length);
  });
  for (const model::Chain& chain : mechanism.chains)
    for (const model::CoupledSpring& spring : chain.coupled_springs)
      for (std::size_t i = 0; i < spring.elements.size(); ++i) {
        const double k = spring.stiffness.diagonal()[static_cast<Index>(i)];
        if (k > 0) forces.push_back(slides(chain, spring, i) ? k * length : k / length);
      }
  for (const model::LineSpring& spring : mechanism.line_springs)
    if (spring.stiffness > 0) forces.push_back(spring.stiffness * length);
  for (const model::ShapeSpring& spring : mechanism.shape_springs)
    add_forces(spring, length, forces);
  return forces;
}

SpringRange range_of_springs(const model::Mechanism& mechanism, double length) {
  auto springs = spring_forces(mechanism, length);
  std::erase_if(springs, [](double force) { return !(force > 0) || !std::isfinite(force); });
  if (springs.empty()) return {};
  const auto [least, most] = std::minmax_element(springs.begin(), springs.end());
  return {*least, *most};
}

void change_force_unit(const statics::System& system, double factor,
                       statics::FirstEquilibrium& first) {
  for (Index i = 0; i < system.size; ++i)
    if (system.is_wrench[static_cast<std::size_t>(i)]) first.z[i] /= factor;
  first.inputs.W /= factor;
}

Scales scales_for(const model::Mechanism& mechanism, const Vector& constant_load) {
  const double length = largest_length(mechanism);
  Scales scales{power_of_two_near(length), 1};
  std::vector<double> forces = spring_forces(mechanism, scales.length);
  if (forces.empty()) forces = load_forces(mechanism, scales.length);
  if (forces.empty() && constant_load.size() > 0) forces.push_back(constant_load.norm());
  if (forces.empty()) return scales;
  const auto middle = forces.begin() + static_cast<std::ptrdiff_t>((forces.size() - 1) / 2);
  std::nth_element(forces.begin(), middle, forces.end());
  scales.force = power_of_two_near(*middle);
  return scales;
}

model::Mechanism dimensionless(const model::Mechanism& mechanism, const Scales& scales) {
  model::Mechanism m = mechanism;
  for (model::Body& body : m.bodies)
    body.pose = body.pose.cwiseQuotient(pose_scales(body.task_space, scales)).eval();
  for (model::Chain& chain : m.chains) {
    chain.from_attachment.p /= scales.length;
    chain.to_attachment.p /= scales.length;
    for (model::Element& element : chain.elements) {
      if (auto* link = std::get_if<model::RigidLink>(&element)) {
        link->transform.p /= scales.length;
        continue;
      }
      auto& joint = std::get<Joint>(element);
      if (joint.kind == JointKind::prismatic) joint.initial /= scales.length;
      joint.command = dimensionless_command(joint, scales);
      if (joint.spring) joint.spring = dimensionless_law(joint, scales);
    }
    for (model::CoupledSpring& spring : chain.coupled_springs)
      make_dimensionless(chain, scales, spring);
    for (model::ChainPoint& point : chain.points) {
      point.at /= scales.length;
      point.inertia /= scales.length * scales.length;
    }
  }
  m.gravity /= scales.force;
  for (model::Body& body : m.bodies) {
    body.centre /= scales.length;
    body.inertia /= scales.length * scales.length;
  }
  for (model::Load& load : m.loads) {
    load.on.at /= scales.length;
    load.vector /= unit_of_load(load, scales);
  }
  for_each_shape(m, [&](model::Shape& shape) {
    for (model::Anchor& point : shape.points) point.at /= scales.length;
  });
  for (model::ShapeSpring& spring : m.shape_springs) {
    const double value = unit_of_value(spring.shape.kind, scales);
    spring.law = dimensionless_law(spring, spring.law, scales);
    spring.offset /= value;
    for (model::SeriesSpring& inner : spring.before) {
      inner.law = dimensionless_law(spring, inner.law, scales);
      if (inner.initial) *inner.initial /= value;
    }
    if (!spring.gas) continue;
    spring.gas->nRT /= scales.moment();
    spring.gas->initial /= value;
  }
  for (model::LineSpring& spring : m.line_springs) {
    for (model::Anchor* end : {&spring.from, &spring.to}) end->at /= scales.length;
    std::tie(spring.stiffness, spring.free) = dimensionless_line(spring, scales);
  }
  return m;
}

void put_dimensionless(const model::Mechanism& mechanism, const model::MovedParts& parts,
                       const Scales& scales, model::Mechanism& result) {
  const auto from = [&](const model::MovedParts::OfChain& at) -> const Joint& {
    return std::get<Joint>(mechanism.chains[at.chain].elements[at.part]);
  };
  const auto to = [&](const model::MovedParts::OfChain& at) -> Joint& {
    return std::get<Joint>(result.chains[at.chain].elements[at.part]);
  };
  for (const auto& at : parts.laws) to(at).spring = dimensionless_law(from(at), scales);
  for (const auto& at : parts.commands) to(at).command = dimensionless_command(from(at), scales);
  for (const auto& [chain, number] : parts.coupled) {
    model::CoupledSpring& spring = result.chains[chain].coupled_springs[number];
    spring = mechanism.chains[chain].coupled_springs[number];
    make_dimensionless(result.chains[chain], scales, spring);
  }
  for (const std::size_t i : parts.lines)
    std::tie(result.line_springs[i].stiffness, result.line_springs[i].free) =
        dimensionless_line(mechanism.line_springs[i], scales);
  for (const std::size_t i : parts.shape_laws)
    result.shape_springs[i].law =
        dimensionless_law(mechanism.shape_springs[i], mechanism.shape_springs[i].law, scales);
  for (const std::size_t i : parts.loads)
    result.loads[i].vector = mechanism.loads[i].vector / unit_of_load(mechanism.loads[i], scales);
}

Vector pose_scales(model::TaskSpace space, const Scales& scales) {
  Vector factors = Vector::Ones(dimension(space));
  factors.head(translations(space)).setConstant(scales.length);
  return factors;
}

Vector wrench_scales(model::TaskSpace space, const Scales& scales) {
  Vector factors = Vector::Constant(dimension(space), scales.moment());
  factors.head(translations(space)).setConstant(scales.force);
  return factors;
}

Vector unknown_scales(const statics::System& system, const Scales& scales) {
  Vector factors(system.size);
  for (Index i = 0; i < system.size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (system.is_wrench[k])
      factors[i] = system.is_length[k] ? scales.force : scales.moment();
    else
      factors[i] = system.is_length[k] ? scales.length : 1;
  }
  for (const statics::PointShape& shape : system.shapes)
    factors.segment(shape.inner, shape.inner_count)
        .setConstant(unit_of_value(shape.shape.kind, scales));
  return factors;
}

}  // namespace springfold::analysis
