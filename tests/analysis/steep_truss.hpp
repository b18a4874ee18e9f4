// A two-bar truss of height > span, built by hand: closed forms in cases/von-mises-truss/README.md.
#pragma once

#include <cmath>
#include <numbers>

#include "springfold/analysis/run.hpp"

namespace springfold {

/// Feet at (-a, 0) and (a, 0), bars of free length 1 and stiffness 1, apex at (x, y).
struct SteepTruss {
  double a = 0.3;

  double height() const { return std::sqrt(1 - a * a); }
  /// Length of the bars at the sway point with number j = 0 (reached first) or 1.
  double sway_length(int j) const {
    const double theta = std::acos(1 - 13.5 * a * a);
    return (1 + 2 * std::cos(theta / 3 - 2 * std::numbers::pi * j / 3)) / 3;
  }
  double sway_height(int j) const { return std::sqrt(std::pow(sway_length(j), 2) - a * a); }
  double load(double y) const { return 2 * y * (1 / std::hypot(a, y) - 1); }

  model::Mechanism mechanism() const {
    using namespace model;
    Mechanism m;
    m.bodies.push_back({"apex", TaskSpace::xy, Vector{{0.0, height()}}});
    for (const double side : {-1.0, 1.0}) {
      Chain chain;
      chain.name = side < 0 ? "left" : "right";
      chain.from_attachment.p = {side * a, 0, 0};
      chain.elements.push_back(Joint{.name = "foot",
                                     .kind = JointKind::revolute,
                                     .axis = Vec3<double>::UnitZ(),
                                     .initial = std::atan2(height(), -side * a)});
      chain.elements.push_back(Joint{.name = "bar",
                                     .kind = JointKind::prismatic,
                                     .axis = Vec3<double>::UnitX(),
                                     .role = JointRole::compliant,
                                     .spring = LinearSpring{1, 0}});
      chain.elements.push_back(RigidLink{{Mat3<double>::Identity(), Vec3<double>::UnitX()}});
      m.chains.push_back(std::move(chain));
    }
    return m;
  }

  /// Pressed down; no bar may shrink to nothing.
  analysis::Study study(int depth) const {
    analysis::Study study;
    study.name = "press";
    study.control = analysis::ControlMode::load;
    study.direction = Vector{{0.0, -1.0}};
    study.until = {
        {"apex.y", -1.2 * height(), 1.2 * height()}, {"left.bar", -0.99}, {"right.bar", -0.99}};
    study.branches.depth = depth;
    return study;
  }
};

}  // namespace springfold
