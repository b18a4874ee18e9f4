// The planar Orthoglide of Pashkevich, Klimchik, Chablat, "Stiffness analysis of parallel
// manipulators with preloaded passive joints", Section 6, built by hand.
#pragma once

#include <numbers>

#include "analysis/column.hpp"
#include "springfold/analysis/run.hpp"

namespace springfold {

struct OrthoglideUnits {
  double length = 1;  ///< numbers of length are multiplied by this
  double force = 1;   ///< numbers of force are multiplied by this
};

/// Leg length 1, drive stiffness 1, both times the units.
inline model::Mechanism planar_orthoglide(const model::SpringLaw& knee, OrthoglideUnits u = {}) {
  using namespace model;
  const auto leg = [&](const std::string& name, const Vec3<double>& axis, double turn) {
    Chain chain;
    chain.name = name;
    chain.elements.push_back(Joint{.name = "drive",
                                   .kind = JointKind::prismatic,
                                   .axis = axis,
                                   .role = JointRole::actuated,
                                   .spring = LinearSpring{u.force / u.length, 0},
                                   .command = 1.0 * u.length});
    chain.elements.push_back(Joint{.name = "knee",
                                   .kind = JointKind::revolute,
                                   .axis = turn * Vec3<double>::UnitZ(),
                                   .role = JointRole::preloaded,
                                   .spring = knee});
    chain.elements.push_back(RigidLink{{Mat3<double>::Identity(), -u.length * axis}});
    return chain;
  };
  Mechanism m;
  m.bodies.push_back({"tool", TaskSpace::xy, Vector::Zero(2)});
  m.chains.push_back(leg("leg_x", Vec3<double>::UnitX(), -1));
  m.chains.push_back(leg("leg_y", Vec3<double>::UnitY(), 1));
  return m;
}

inline model::SpringLaw linear_knee(double stiffness, OrthoglideUnits u = {}) {
  return model::LinearSpring{stiffness * u.force * u.length, 0};
}

inline model::SpringLaw one_sided_knee(OrthoglideUnits u = {}) {
  return model::OneSidedSpring{0.5 * u.force * u.length, std::numbers::pi / 12,
                               model::OneSidedSpring::Side::above};
}

/// Displacement along the diagonal through (s, s), both ways until the knees reach 80 degrees,
/// with actuator commands that balance the start point.
inline analysis::Study diagonal_study(double s, OrthoglideUnits u = {}) {
  analysis::Study study;
  study.name = "diagonal";
  study.control = analysis::ControlMode::mixed;
  study.direction = Vector::Constant(2, std::numbers::sqrt2 / 2);
  study.start.pose = Vector::Constant(2, s * u.length);
  study.start.solve = analysis::StartSolve::actuators;
  const double end = 80 * std::numbers::pi / 180;
  for (const char* knee : {"leg_x.knee", "leg_y.knee"}) study.until.push_back({knee, -end, end});
  return study;
}

inline double at_start(const analysis::StudyResult& result, const std::string& name) {
  const auto& branch = result.branches.front();
  return branch.samples[branch.start_row].values[column(result, name)];
}

inline double at_event(const analysis::StudyResult& result, const analysis::Event& event,
                       const std::string& name) {
  return result.branches.front().samples[event.row].values[column(result, name)];
}

inline std::vector<analysis::Event> events_of_kind(const analysis::StudyResult& result,
                                                   analysis::EventKind kind) {
  std::vector<analysis::Event> found;
  for (const auto& branch : result.branches)
    for (const auto& event : branch.events)
      if (event.kind == kind) found.push_back(event);
  return found;
}

}  // namespace springfold
