// The mechanisms of the comparison with AUTO-07p; compare.py writes the same ones as case files.
#pragma once

#include <cmath>
#include <string>

#include "springfold/model/mechanism.hpp"

namespace springfold::bench {

/// A mechanism in units of force in which its load counts as much in the arc length as in
/// `springfold run`: its forces times `force` are those of the case file.
struct Problem {
  model::Mechanism mechanism{};
  Vector direction{};  ///< of the load on the only body
  double force = 1;
};

/// Slider standing at `command`, knee, link of length 1 back along the axis.
inline model::Chain commanded_leg(const char* name, const model::Vec3<double>& axis,
                                  const model::Vec3<double>& knee_axis, double command,
                                  double drive_stiffness, double knee_stiffness) {
  const model::Joint drive{.name = "drive",
                           .kind = model::JointKind::prismatic,
                           .axis = axis,
                           .role = model::JointRole::actuated,
                           .spring = model::LinearSpring{.stiffness = drive_stiffness},
                           .command = command};
  const model::Joint knee{.name = "knee",
                          .axis = knee_axis,
                          .role = model::JointRole::preloaded,
                          .spring = model::LinearSpring{.stiffness = knee_stiffness}};
  model::RigidLink link;
  link.transform.p = -axis;
  return {.name = name, .elements = {drive, knee, link}};
}

/// The planar Orthoglide of cases/orthoglide-planar with K = 1 and Kv = 0.01, commanded to stand at
/// (p, p) without a load, pushed along the diagonal.
inline Problem commanded_orthoglide(double p) {
  using V = model::Vec3<double>;
  constexpr double kv = 0.01, force = 0x1p-6;
  const double a = std::asin(p);
  const double command = p + std::cos(a) + kv * a / (std::cos(a) - std::sin(a));
  const auto leg = [&](const char* name, const V& axis, const V& knee) {
    return commanded_leg(name, axis, knee, command, 1 / force, kv / force);
  };
  return {{.bodies = {{.name = "tool",
                       .task_space = model::TaskSpace::xy,
                       .pose = Vector::Constant(2, p)}},
           .chains = {leg("leg_x", V::UnitX(), -V::UnitZ()), leg("leg_y", V::UnitY(), V::UnitZ())}},
          Vector::Constant(2, std::sqrt(0.5)),
          force};
}

/// `links` links of length 1 / links along x, a torsion spring of stiffness `links` before each; a
/// force at the tip against x, turned by `skew`.
inline Problem column(int links, double skew) {
  model::Chain chain{.name = "column"};
  for (int i = 0; i < links; ++i) {
    chain.elements.push_back(model::Joint{.name = "j" + std::to_string(i + 1),
                                          .role = model::JointRole::preloaded,
                                          .spring = model::LinearSpring{.stiffness = 1}});
    model::RigidLink link;
    link.transform.p = model::Vec3<double>::UnitX() / links;
    chain.elements.push_back(link);
  }
  return {{.bodies = {{.name = "tip", .task_space = model::TaskSpace::xy, .pose = Vector{{1, 0}}}},
           .chains = {chain}},
          Vector{{-std::cos(skew), -std::sin(skew)}},
          static_cast<double>(links)};
}

}  // namespace springfold::bench
