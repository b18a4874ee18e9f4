// The planar Orthoglide for tests of commands, maps and workspaces.
#pragma once

#include <cmath>
#include <limits>
#include <stdexcept>

#include "analysis/column.hpp"
#include "springfold/analysis/run.hpp"

namespace springfold::analysis {

/// Leg length and drive stiffness 1; the slider of leg_x at (rho, 0), the link back to the point.
inline model::Mechanism orthoglide(const model::SpringLaw& knee, double unit = 1) {
  using namespace model;
  Mechanism m;
  m.bodies.push_back({"tool", TaskSpace::xy, Vector::Zero(2)});
  for (const bool along_x : {true, false}) {
    const Vec3<double> axis = along_x ? Vec3<double>::UnitX() : Vec3<double>::UnitY();
    Chain chain;
    chain.name = along_x ? "leg_x" : "leg_y";
    chain.elements.push_back(Joint{.name = "drive",
                                   .kind = JointKind::prismatic,
                                   .axis = axis,
                                   .role = JointRole::actuated,
                                   .spring = LinearSpring{1 / unit, 0},
                                   .command = unit});
    chain.elements.push_back(Joint{.name = "knee",
                                   .axis = (along_x ? -1 : 1) * Vec3<double>::UnitZ(),
                                   .role = JointRole::preloaded,
                                   .spring = knee});
    chain.elements.push_back(RigidLink{{Mat3<double>::Identity(), -unit * axis}});
    m.chains.push_back(chain);
  }
  return m;
}

inline model::SpringLaw linear(double stiffness) { return model::LinearSpring{stiffness, 0}; }

inline model::SpringLaw one_sided(double stiffness, double from) {
  return model::OneSidedSpring{stiffness, from, model::OneSidedSpring::Side::above};
}

/// A point on two slides: that along x has a drive of stiffness 2 with a backlash of 0.1 to each side, that along y one
/// of stiffness 5. A spring of stiffness 1 draws the point to x = 0.
/// @param rest  where the spring of the first drive stands at first
inline model::Mechanism with_backlash(double rest) {
  using namespace model;
  Mechanism m;
  m.bodies.push_back({"tool", TaskSpace::xy, Vector{{-0.5, 0}}});
  Chain drive, spring;
  drive.name = "drive";
  drive.elements.push_back(Joint{.name = "slide",
                                 .kind = JointKind::prismatic,
                                 .axis = Vec3<double>::UnitX(),
                                 .role = JointRole::actuated,
                                 .spring = PiecewiseLinearSpring{{-0.1, 0.1}, {2, 0, 2}, 0, 0},
                                 .initial = rest});
  drive.elements.push_back(Joint{.name = "lift",
                                 .kind = JointKind::prismatic,
                                 .axis = Vec3<double>::UnitY(),
                                 .role = JointRole::actuated,
                                 .spring = LinearSpring{5, 0}});
  spring.name = "spring";
  spring.elements.push_back(Joint{.name = "slide",
                                  .kind = JointKind::prismatic,
                                  .axis = Vec3<double>::UnitX(),
                                  .role = JointRole::preloaded,
                                  .spring = linear(1)});
  spring.elements.push_back(
      Joint{.name = "lift", .kind = JointKind::prismatic, .axis = Vec3<double>::UnitY()});
  m.chains = {drive, spring};
  return m;
}

inline Study command_study(StudyKind kind) {
  Study study;
  study.name = "commands";
  study.kind = kind;
  return study;
}

/// Row of the event with this label.
inline std::size_t row_of(const StudyResult& result, const std::string& label) {
  for (const Event& event : result.branches.front().events)
    if (event.label == label) return event.row;
  throw std::out_of_range("no event " + label);
}

}  // namespace springfold::analysis
