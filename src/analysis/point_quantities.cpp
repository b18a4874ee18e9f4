#include "point_quantities.hpp"

#include <algorithm>

#include "shape_units.hpp"
#include "springfold/statics/shapes.hpp"

namespace springfold::analysis {
namespace {

using Kind = QuantityDefinition::Kind;

}  // namespace

void add_point_quantities(const statics::System& system, const Scales& scales,
                          std::vector<QuantityDefinition>& list) {
  const auto& bodies = system.mechanism.bodies;
  const bool is_planar = std::all_of(bodies.begin(), bodies.end(), [](const model::Body& body) {
    return translations(body.task_space) == 2;
  });
  for (std::size_t i = 0; i < system.points.size(); ++i) {
    if (system.points[i].name.empty()) continue;
    for (Index axis = 0; axis < (is_planar ? 2 : 3); ++axis)
      list.push_back({Kind::point, 3 * static_cast<Index>(i) + axis,
                      system.points[i].name + "." + "xyz"[axis], Unit::length, scales.length});
  }
  for (std::size_t i = 0; i < system.line_springs.size(); ++i) {
    const std::string& name = system.mechanism.line_springs[i].name;
    const auto entry = static_cast<Index>(i);
    list.push_back({Kind::spring_length, entry, name + ".length", Unit::length, scales.length});
    list.push_back({Kind::spring_force, entry, name + ".force", Unit::force, scales.force});
  }
  for (std::size_t i = 0; i < system.mechanism.shape_springs.size(); ++i) {
    const model::ShapeSpring& spring = system.mechanism.shape_springs[i];
    const model::ShapeKind kind = spring.shape.kind;
    const auto entry = static_cast<Index>(i);
    const ShapeColumn value = value_column(kind), force = force_column(kind);
    if (!spring.before.empty())
      list.push_back({Kind::shape_own, entry, series_name(spring, spring.before.size()), value.unit,
                      unit_of_value(kind, scales)});
    list.push_back({Kind::shape_value, entry, spring.name + "." + value.name, value.unit,
                    unit_of_value(kind, scales)});
    list.push_back({Kind::shape_force, entry, spring.name + "." + force.name, force.unit,
                    force.sign * unit_of_force(kind, scales)});
  }
}

std::optional<double> point_quantity(const statics::System& system, const QuantityDefinition& q,
                                     const Vector& z, const statics::Inputs& inputs,
                                     const Piece* piece) {
  const auto entry = static_cast<std::size_t>(q.entry);
  const auto shape_state = [&] {
    return piece == nullptr ? statics::shape_state(system, entry, z, inputs)
                            : statics::shape_state(system, *piece, entry, z, inputs);
  };
  switch (q.kind) {
    case Kind::point:
      return q.scale * statics::position_of(system, entry / 3, z, inputs.rho)[q.entry % 3];
    case Kind::spring_length:
      return q.scale * statics::line_spring_state(system, entry, z, inputs.rho).length;
    case Kind::spring_force:
      return q.scale * statics::line_spring_state(system, entry, z, inputs.rho).force;
    case Kind::shape_value:
      return q.scale * shape_state().value;
    case Kind::shape_own:
      return q.scale * shape_state().own;
    case Kind::shape_force:
      return q.scale * shape_state().slope;
    default:
      return std::nullopt;
  }
}

}  // namespace springfold::analysis
