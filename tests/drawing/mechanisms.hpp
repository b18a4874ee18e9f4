// Small mechanisms for pictures.
#pragma once

#include "springfold/drawing/scene.hpp"

namespace springfold::drawing {

/// Two links of lengths 2 and 1 from the origin to the point "tool", turning about z in "shoulder" and
/// "elbow"; the elbow has a spring that acts above 0.5 rad only.
inline model::Mechanism two_links() {
  model::Mechanism mechanism;
  mechanism.bodies.push_back(
      {.name = "tool", .task_space = model::TaskSpace::xy, .pose = Vector::Zero(2)});
  model::Chain chain{.name = "arm"};
  const auto link = [](double length) {
    model::RigidLink rigid;
    rigid.transform.p = model::Vec3<double>(length, 0, 0);
    return rigid;
  };
  chain.elements.push_back(model::Joint{.name = "shoulder"});
  chain.elements.push_back(link(2));
  chain.elements.push_back(
      model::Joint{.name = "elbow",
                   .role = model::JointRole::preloaded,
                   .spring = model::OneSidedSpring{.stiffness = 4, .from = 0.5}});
  chain.elements.push_back(link(1));
  mechanism.chains.push_back(chain);
  return mechanism;
}

/// With these angles, and the tool at (x, y).
inline Posture posture_of(const statics::System& system, double shoulder, double elbow, double x,
                          double y) {
  Posture posture = guess_posture(system);
  for (Index i = 0; i < system.size; ++i) {
    const std::string& name = system.coordinate_names[static_cast<std::size_t>(i)];
    if (name == "arm.shoulder") posture.z[i] = shoulder;
    if (name == "arm.elbow") posture.z[i] = elbow;
    if (name == "tool.x") posture.z[i] = x;
    if (name == "tool.y") posture.z[i] = y;
  }
  return posture;
}

}  // namespace springfold::drawing
