// Small mechanisms with known answers.
#pragma once

#include <cmath>
#include <numbers>

#include "springfold/statics/first_equilibrium.hpp"
#include "springfold/statics/stiffness.hpp"

namespace springfold::statics {

using Vec3 = model::Vec3<double>;
using Mat3 = model::Mat3<double>;

inline double degrees(double value) { return value * std::numbers::pi / 180; }

inline model::RigidLink link_along_x(double length) { return {{Mat3::Identity(), {length, 0, 0}}}; }

inline model::Joint hinge(const std::string& name, double initial = 0) {
  return {.name = name, .initial = initial};
}

inline model::Joint spring_hinge(const std::string& name, double stiffness, double free = 0) {
  return {.name = name,
          .role = model::JointRole::compliant,
          .spring = model::LinearSpring{stiffness, free},
          .initial = free};
}

/// A spring of free length l0 as a slider along x.
inline model::Joint spring_slider(double stiffness, double l0) {
  return {.name = "spring",
          .kind = model::JointKind::prismatic,
          .axis = Vec3::UnitX(),
          .role = model::JointRole::preloaded,
          .spring = model::LinearSpring{stiffness, l0},
          .initial = l0};
}

struct Bar {
  double x = 0, y = 0;  ///< anchor
  double stiffness = 1, free_length = 1;
};

/// A point in the plane that is held by springs from anchors: hinge - slider, seen from `guess`.
inline model::Mechanism spring_point(const std::vector<Bar>& bars, const Vector& guess) {
  model::Mechanism m;
  m.bodies = {{"point", model::TaskSpace::xy, guess}};
  for (const Bar& bar : bars) {
    const double angle = std::atan2(guess[1] - bar.y, guess[0] - bar.x);
    model::Chain chain{.name = "bar" + std::to_string(m.chains.size())};
    chain.from_attachment.p = {bar.x, bar.y, 0};
    chain.elements = {hinge("hinge", angle), spring_slider(bar.stiffness, bar.free_length)};
    m.chains.push_back(chain);
  }
  return m;
}

/// Planar triangle on three legs hinge - spring - hinge, bases on a circle R, platform circle r,
/// both at 90, 210 and 330 degrees, closed at `pose`.
struct ThreeRpr {
  double R = 1, r = 0.5, stiffness = 1, free_length = 0.5;
  bool actuated = false;  ///< the free length is the command
  Vector pose = Vector::Zero(3);
};

inline model::Mechanism three_rpr(const ThreeRpr& spec) {
  model::Mechanism m;
  m.bodies = {{"triangle", model::TaskSpace::planar, spec.pose}};
  const double phi = spec.pose[2];
  for (const double direction : {90, 210, 330}) {
    const double angle = degrees(direction);
    model::Chain chain{.name = "leg" + std::to_string(m.chains.size())};
    chain.from_attachment.p = spec.R * Vec3(std::cos(angle), std::sin(angle), 0);
    chain.to_attachment.p = spec.r * Vec3(std::cos(angle), std::sin(angle), 0);
    const Vec3 leg = Vec3(spec.pose[0], spec.pose[1], 0) - chain.from_attachment.p +
                     spec.r * Vec3(std::cos(angle + phi), std::sin(angle + phi), 0);
    const double towards = std::atan2(leg[1], leg[0]);
    model::Joint spring = spring_slider(spec.stiffness, spec.free_length);
    spring.initial = leg.norm();
    if (spec.actuated) {
      spring.role = model::JointRole::actuated;
      spring.spring = model::LinearSpring{spec.stiffness, 0};
      spring.initial = leg.norm() - spec.free_length;
      spring.command = spec.free_length;
    }
    chain.elements = {hinge("base", towards), spring, hinge("platform", phi - towards)};
    m.chains.push_back(chain);
  }
  return m;
}

struct Arm {
  double l1 = 1, l2 = 0.8, k1 = 2, k2 = 1;
};

/// Two links in the plane with joint springs that are free at q1, q2.
inline model::Mechanism two_link_arm(double q1, double q2, Arm arm = {}) {
  model::Mechanism m;
  m.bodies = {{"tip", model::TaskSpace::xy,
               Vector{{arm.l1 * std::cos(q1) + arm.l2 * std::cos(q1 + q2),
                       arm.l1 * std::sin(q1) + arm.l2 * std::sin(q1 + q2)}}}};
  m.chains = {{.name = "arm",
               .elements = {spring_hinge("shoulder", arm.k1, q1), link_along_x(arm.l1),
                            spring_hinge("elbow", arm.k2, q2), link_along_x(arm.l2)}}};
  return m;
}

/// N links of length 1/N on springs N (EI = 1), the base spring `base` times as stiff.
inline model::Mechanism cantilever(int N, double base, model::TaskSpace space) {
  model::Mechanism m;
  m.bodies = {{"tip", space, Vector::Unit(dimension(space), 0)}};
  m.chains = {{.name = "beam"}};
  for (int i = 0; i < N; ++i) {
    m.chains[0].elements.push_back(
        spring_hinge("hinge" + std::to_string(i), i == 0 ? base * N : N));
    m.chains[0].elements.push_back(link_along_x(1.0 / N));
  }
  return m;
}

/// The planar Orthoglide of the paper's Section 6: slider with drive spring 1, knee, leg 1, twice.
inline model::Mechanism orthoglide(const model::SpringLaw& knee, double x, double y) {
  model::Mechanism m;
  m.bodies = {{"tool", model::TaskSpace::xy, Vector{{x, y}}}};
  for (const Vec3& axis : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY())}) {
    const bool along_x = axis[0] == 1;
    const double command = along_x ? x + std::sqrt(1 - y * y) : y + std::sqrt(1 - x * x);
    m.chains.push_back({.name = along_x ? "leg_x" : "leg_y",
                        .elements = {model::Joint{.name = "drive",
                                                  .kind = model::JointKind::prismatic,
                                                  .axis = axis,
                                                  .role = model::JointRole::actuated,
                                                  .spring = model::LinearSpring{1, 0},
                                                  .command = command},
                                     model::Joint{.name = "knee",
                                                  .axis = (along_x ? -1 : 1) * Vec3::UnitZ(),
                                                  .role = model::JointRole::preloaded,
                                                  .spring = knee,
                                                  .initial = std::asin(along_x ? y : x)},
                                     model::RigidLink{{Mat3::Identity(), -axis}}}});
  }
  return m;
}

/// First equilibrium with the pose unknown, from the mechanism's own guess.
inline FirstEquilibrium free_equilibrium(const System& system, const Vector& W) {
  return first_equilibrium(system, {.z = guess(system), .inputs = {system.commands, W}});
}

/// First equilibrium with the body held at its own pose.
inline FirstEquilibrium held_equilibrium(const System& system) {
  return first_equilibrium(system, {.unknowns = StartUnknowns::wrench,
                                    .z = guess(system),
                                    .inputs = {system.commands, Vector::Zero(system.load_size)}});
}

/// KKT matrix at a solution.
inline Matrix matrix_at(const System& system, const FirstEquilibrium& found) {
  Workspace work;
  Vector r;
  Matrix A;
  equilibrium_matrix(system, found.piece, found.z, found.inputs, work, r, A);
  return A;
}

inline Matrix stiffness_at(const System& system, const FirstEquilibrium& found) {
  return platform_stiffness(system, matrix_at(system, found)).K;
}

inline Stability stability_at(const System& system, const FirstEquilibrium& found) {
  return stability(system, matrix_at(system, found));
}

inline Vector pose_of(const System& system, const FirstEquilibrium& found) {
  return found.z.tail(system.size - system.first_pose);
}

}  // namespace springfold::statics
