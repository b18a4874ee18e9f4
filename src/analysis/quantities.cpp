#include "quantities.hpp"

#include <algorithm>
#include <cmath>

#include "point_quantities.hpp"
#include "setup.hpp"
#include "shape_units.hpp"

namespace springfold::analysis {
namespace {

using Kind = QuantityDefinition::Kind;

bool along_translation(const Vector& direction, Index lengths) {
  return direction.size() > 0 && !direction.head(lengths).isZero(0);
}

bool has_force(ControlMode control) {
  return control == ControlMode::load || control == ControlMode::pose ||
         control == ControlMode::mixed;
}

/// Loads without potential: eigenvalues and determinant of the tangent stiffness in place of counts.
void add_tangents(const statics::System& system, const Scales& scales,
                  std::vector<QuantityDefinition>& list) {
  const double stiffness = scales.force / scales.length;
  for (Index i = 0; i < 3; ++i)
    list.push_back(
        {Kind::tangent_eigenvalue, i, "T_eig" + std::to_string(i + 1), Unit::stiffness, stiffness});
  for (Index i = 0; i < 3; ++i)
    list.push_back(
        {Kind::tangent_imaginary, i, "T_imag" + std::to_string(i + 1), Unit::stiffness, stiffness});
  // Row i of the matrix is an energy per unknown i, column j again per unknown j.
  double scale = 1;
  for (const double unit : unknown_scales(system, scales)) scale *= scales.moment() / (unit * unit);
  list.push_back({Kind::tangent_determinant, 0, "T_det", Unit::none, scale});
}

}  // namespace

bool is_continuous(const QuantityDefinition& q) {
  switch (q.kind) {
    case Kind::lambda:
    case Kind::deflection:
    case Kind::force:
    case Kind::unknown:
    case Kind::command:
    case Kind::energy:
    case Kind::point:
    case Kind::spring_length:
    case Kind::spring_force:
    case Kind::shape_value:
    case Kind::shape_own:
    case Kind::shape_force:
      return true;
    case Kind::tangent_eigenvalue:
    case Kind::tangent_imaginary:
    case Kind::tangent_determinant:
    case Kind::arc_length:
    case Kind::stiffness:
    case Kind::eigenvalue:
    case Kind::index_pose:
    case Kind::index_force:
    case Kind::index:
    case Kind::index_driven:
      return false;
  }
  return false;
}

Vector measured_direction(const Study& study, model::TaskSpace space) {
  Vector direction = study.direction;
  if (direction.size() == 0) return direction;
  const Index lengths = translations(space);
  if (along_translation(direction, lengths)) direction.tail(direction.size() - lengths).setZero();
  return direction / direction.norm();
}

std::vector<Index> prescribed_coordinates(const Study& study, model::TaskSpace space) {
  const std::vector<std::string> names = statics::pose_names(space);
  std::vector<Index> list;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::find(study.prescribed.begin(), study.prescribed.end(), names[i]) !=
        study.prescribed.end())
      list.push_back(static_cast<Index>(i));
  return list;
}

Unit lambda_unit_of(const Study& study, const statics::System& system) {
  const auto body = static_cast<std::size_t>(study.body - 1);
  const Index lengths = translations(system.mechanism.bodies[body].task_space);
  const bool moves = along_translation(study.direction, lengths);
  switch (study.control) {
    case ControlMode::load:
      if (study.direction.size() == 0) return Unit::none;  // a factor of the loads
      return moves ? Unit::force : Unit::moment;
    case ControlMode::pose:
    case ControlMode::mixed:
      return moves ? Unit::length : Unit::angle;
    case ControlMode::actuator: {
      bool slides = false, turns = false;
      for (std::size_t i = 0; i < system.command_names.size(); ++i)
        for (const ActuatorRate& rate : study.actuators)
          if (rate.actuator == system.command_names[i])
            (system.command_is_length[i] ? slides : turns) = true;
      return slides == turns ? Unit::none : slides ? Unit::length : Unit::angle;
    }
    case ControlMode::parameter:
      return Unit::none;
  }
  return Unit::none;
}

const QuantityDefinition* find_quantity(const std::vector<QuantityDefinition>& quantities,
                                        const std::string& name) {
  const auto q = std::find_if(quantities.begin(), quantities.end(),
                              [&](const QuantityDefinition& d) { return d.name == name; });
  return q == quantities.end() ? nullptr : &*q;
}

std::vector<QuantityDefinition> quantities_of(const Study& study, const statics::System& system,
                                              const Scales& scales, double lambda_scale,
                                              Unit lambda_unit) {
  std::vector<QuantityDefinition> list;
  const auto body = static_cast<std::size_t>(study.body - 1);
  const Index lengths = translations(system.mechanism.bodies[body].task_space);
  const bool moves = along_translation(study.direction, lengths);
  list.push_back({Kind::arc_length, 0, "s", Unit::none, 1});
  list.push_back({Kind::lambda, 0, "lambda", lambda_unit, lambda_scale});
  if (study.direction.size() > 0)
    list.push_back({Kind::deflection, 0, "deflection", moves ? Unit::length : Unit::angle,
                    moves ? scales.length : 1});
  if (study.direction.size() > 0 && has_force(study.control))
    list.push_back({Kind::force, 0, "force", moves ? Unit::force : Unit::moment,
                    moves ? scales.force : scales.moment()});
  if (study.direction.size() > 0)
    list.push_back({Kind::stiffness, 0, "stiffness",
                    moves ? Unit::stiffness : Unit::rotational_stiffness,
                    moves ? scales.force / scales.length : scales.moment()});

  const Vector factors = unknown_scales(system, scales);
  const auto add_unknown = [&](Index i) {
    const auto k = static_cast<std::size_t>(i);
    list.push_back(
        {Kind::unknown, i, system.coordinate_names[k], unit_of_unknown(system, i), factors[i]});
  };
  for (Index i = system.first_pose; i < system.size; ++i) add_unknown(i);
  for (Index i = 0; i < system.first_pose; ++i)
    if (!system.is_wrench[static_cast<std::size_t>(i)]) add_unknown(i);
  for (std::size_t i = 0; i < system.command_names.size(); ++i) {
    const bool length = system.command_is_length[i];
    list.push_back({Kind::command, static_cast<Index>(i), system.command_names[i] + ".rho",
                    length ? Unit::length : Unit::angle, length ? scales.length : 1});
  }
  for (Index i = 0; i < system.first_pose; ++i)
    if (system.is_wrench[static_cast<std::size_t>(i)]) add_unknown(i);
  add_point_quantities(system, scales, list);
  for (Index i = 0; i < std::min<Index>(3, system.load_size); ++i)
    list.push_back({Kind::eigenvalue, i, "K_eig" + std::to_string(i + 1), Unit::stiffness,
                    scales.force / scales.length});
  list.push_back({Kind::index_pose, 0, "index_pose", Unit::none, 1});
  list.push_back({Kind::index_force, 0, "index_force", Unit::none, 1});
  list.push_back({Kind::index, 0, "index", Unit::none, 1});
  if (study.control == ControlMode::load && study.kind == StudyKind::force_deflection)
    list.push_back({Kind::index_driven, 0, "index_driven", Unit::none, 1});
  if (!non_conservative_loads(system.mechanism, study).empty()) add_tangents(system, scales, list);
  list.push_back({Kind::energy, 0, "energy", Unit::energy, scales.moment()});
  return list;
}

}  // namespace springfold::analysis
