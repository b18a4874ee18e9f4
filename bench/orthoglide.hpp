// The planar Orthoglide of the paper's Section 6, for all benchmarks.
#pragma once

#include "springfold/model/mechanism.hpp"

namespace springfold::bench {

/// Slider of stiffness 1 along `axis`, knee with preload stiffness 0.01, link of length 1.
inline model::Chain leg(const char* name, const model::Vec3<double>& axis) {
  const model::Joint drive{.name = "drive",
                           .kind = model::JointKind::prismatic,
                           .axis = axis,
                           .role = model::JointRole::actuated,
                           .spring = model::LinearSpring{.stiffness = 1},
                           .command = -1};
  const model::Joint knee{.name = "knee",
                          .role = model::JointRole::preloaded,
                          .spring = model::LinearSpring{.stiffness = 0.01}};
  model::RigidLink link;
  link.transform.p = axis;
  return {.name = name, .elements = {drive, knee, link}};
}

inline model::Mechanism orthoglide() {
  return {.bodies = {{.name = "tool", .task_space = model::TaskSpace::xy, .pose = Vector::Zero(2)}},
          .chains = {leg("leg_x", model::Vec3<double>::UnitX()),
                     leg("leg_y", model::Vec3<double>::UnitY())}};
}

}  // namespace springfold::bench
