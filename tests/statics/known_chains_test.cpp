// Long chains, a joint with springs around it, and a platform in space, against closed forms.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "examples.hpp"

namespace springfold::statics {
namespace {

// Rolled up by an end moment: theta_i = (i - 1/2) d, d = M / N.
TEST(Cantilever, RollsUpUnderAnEndMoment) {
  const double pi = std::numbers::pi;
  for (const int N : {4, 10})
    for (const double M : {0.3, pi / 2, pi, 1.9 * pi}) {
      const System system = prepare(cantilever(N, 2, model::TaskSpace::planar));
      const FirstEquilibrium found = free_equilibrium(system, Vector{{0, 0, M}});
      ASSERT_EQ(found.status, StartStatus::found) << "N = " << N << ", M = " << M;
      const double d = M / N, radius = 1.0 / N / (2 * std::sin(d / 2));
      EXPECT_NEAR(pose_of(system, found)[0], radius * std::sin(N * d), 1e-12);
      EXPECT_NEAR(pose_of(system, found)[1], radius * (1 - std::cos(N * d)), 1e-12);
    }
}

// Transverse dead load at the tip, springs in the joints; computed independently.
TEST(Cantilever, BendsUnderATransverseLoadAsKnown) {
  struct Row {
    double base;
    int N;
    double P, y, shortening, angle, C_yy, C_xx;
  };
  const std::vector<Row> rows{
      {2, 2, 1, 0.336859082163, 0.065116180769, 0.457960023809, 0.274234107704, 0.044977111834},
      {2, 2, 10, 0.898601329904, 0.620256076766, 1.392570143605, 0.011708505345, 0.066724878268},
      {2, 5, 1, 0.307377942059, 0.057711763079, 0.460772122298, 0.253006629827, 0.038879457417},
      {2, 5, 5, 0.726708988004, 0.393435903765, 1.209374565313, 0.037344537912, 0.084444331693},
      {2, 10, 1, 0.303135902657, 0.056748880797, 0.461205622910, 0.249910384992, 0.038096782822},
      {2, 10, 10, 0.815101317004, 0.556948943698, 1.428469965604, 0.010759891744, 0.059082954724},
      {1, 2, 1, 0.503053601226, 0.141637998258, 0.631035286339, 0.334853082202, 0.125681801375},
      {1, 5, 5, 0.809042594582, 0.478014049928, 1.275810736513, 0.033147109383, 0.103341397584}};
  for (const Row& row : rows) {
    const System system = prepare(cantilever(row.N, row.base, model::TaskSpace::xy));
    const FirstEquilibrium found = free_equilibrium(system, Vector{{0, row.P}});
    ASSERT_EQ(found.status, StartStatus::found) << "N = " << row.N << ", P = " << row.P;
    EXPECT_NEAR(pose_of(system, found)[1], row.y, 1e-11);
    EXPECT_NEAR(1 - pose_of(system, found)[0], row.shortening, 1e-11);
    EXPECT_NEAR(found.z.head(row.N).sum(), row.angle, 1e-11);
    const Matrix C = stiffness_at(system, found).inverse();
    EXPECT_NEAR(C(1, 1), row.C_yy, 1e-11);
    EXPECT_NEAR(C(0, 0), row.C_xx, 1e-11);
  }
}

// Two triangles of height a and half base b with their apexes on one hinge, springs between facing
// corners: M(q) = k (-2 (a^2 - b^2) sin q + 2 L0 a sin(q/2)).
System dual_triangle(double L0, double q) {
  const double a = 1, b = 0.75;
  model::Mechanism m;
  m.bodies = {{"upper", model::TaskSpace::planar, Vector{{0, 0, q}}}};
  m.chains = {{.name = "apex", .elements = {hinge("hinge", q)}}};
  for (const double side : {-b, b}) {
    model::Chain chain{.name = side < 0 ? "left" : "right"};
    chain.from_attachment.p = {side, -a, 0};
    chain.to_attachment.p = {side, a, 0};
    const Vec3 spring = model::rotation_about<double>(Vec3::UnitZ(), q) * chain.to_attachment.p -
                        chain.from_attachment.p;
    const double angle = std::atan2(spring[1], spring[0]);
    chain.elements = {hinge("lower", angle), spring_slider(1, L0), hinge("upper", q - angle)};
    m.chains.push_back(chain);
  }
  return prepare(m);
}

TEST(DualTriangle, HoldsTheClosedFormsTorque) {
  for (const auto& [L0, q, M] : {std::tuple{1.2, 0.2, 0.065764535507},
                                 {1.2, 0.8, 0.306917442004},
                                 {0.7, -0.725937297211, 0.083785691969}}) {
    const System system = dual_triangle(L0, q + 0.01);
    const FirstEquilibrium found = free_equilibrium(system, Vector{{0, 0, M}});
    ASSERT_EQ(found.status, StartStatus::found);
    // The last state is a torque limit: there the angle has half the digits only.
    EXPECT_NEAR(pose_of(system, found)[2], q, L0 == 0.7 ? 2e-5 : 1e-10) << "M = " << M;
  }
}

TEST(DualTriangle, StandsUprightWithLongSpringsOnly) {
  for (const auto& [L0, stiffness] : {std::pair{0.5, -0.375}, {1.2, 0.325}}) {
    const System system = dual_triangle(L0, 0);
    const FirstEquilibrium found = free_equilibrium(system, Vector::Zero(3));
    ASSERT_EQ(found.status, StartStatus::found);
    const PlatformStiffness platform = platform_stiffness(system, matrix_at(system, found));
    ASSERT_EQ(platform.eigenvalues.size(), 3);  // the hinge is rigid in both translations
    EXPECT_NEAR(platform.eigenvalues[0], stiffness, 1e-13);
    EXPECT_TRUE(std::isinf(platform.eigenvalues[1]) && std::isinf(platform.eigenvalues[2]));
    EXPECT_EQ(stability_at(system, found).force_controlled, stiffness < 0 ? 1 : 0);
    EXPECT_EQ(stability_at(system, found).pose_controlled, 0);
  }
}

TEST(DualTriangle, RestsTiltedWithShortSprings) {
  // cos(q/2) = L0 a / (2 (a^2 - b^2))
  const System system = dual_triangle(0.7, 1.2);
  const FirstEquilibrium found = free_equilibrium(system, Vector::Zero(3));
  ASSERT_EQ(found.status, StartStatus::found);
  EXPECT_NEAR(pose_of(system, found)[2], 1.287002217587, 1e-12);
  EXPECT_EQ(stability_at(system, found).force_controlled, 0);
}

/// Gough-Stewart platform: R = 1, r = 0.6, joints 20 degrees off, stress-free at height 0.8, legs
/// universal - spring - spherical.
System gough_stewart(double height) {
  model::Mechanism m;
  m.bodies = {{"platform", model::TaskSpace::spatial, Vector::Unit(6, 2) * height}};
  for (int i = 0; i < 6; ++i) {
    const double base = degrees(60 * i), top = degrees(60 * i + (i % 2 == 0 ? 20 : -20));
    model::Chain chain{.name = "leg" + std::to_string(i)};
    chain.from_attachment.p = {std::cos(base), std::sin(base), 0};
    chain.to_attachment.p = {0.6 * std::cos(top), 0.6 * std::sin(top), 0};
    const auto leg_at = [&](double h) -> Vec3 {
      return chain.to_attachment.p + h * Vec3::UnitZ() - chain.from_attachment.p;
    };
    const Vec3 leg = leg_at(height);
    const double yaw = std::atan2(leg[1], leg[0]), pitch = -std::asin(leg[2] / leg.norm());
    const Mat3 turned = model::rotation_about<double>(Vec3::UnitZ(), yaw) *
                        model::rotation_about<double>(Vec3::UnitY(), pitch);
    model::Joint pitch_joint = hinge("pitch", pitch);
    pitch_joint.axis = Vec3::UnitY();
    model::Joint spring = spring_slider(1, leg_at(0.8).norm());
    spring.initial = leg.norm();
    chain.elements = {hinge("yaw", yaw), pitch_joint, spring,
                      model::RigidLink{{turned.transpose(), Vec3::Zero()}}};
    for (int axis = 0; axis < 3; ++axis) {
      chain.elements.push_back(hinge("ball" + std::to_string(axis)));
      std::get<model::Joint>(chain.elements.back()).axis = Vec3::Unit(axis);
    }
    m.chains.push_back(chain);
  }
  return prepare(m);
}

Matrix stewart_stiffness(double K_xx, double K_zz, double K_rx, double K_rz, double K_x_ry) {
  Matrix K = Vector{{K_xx, K_xx, K_zz, K_rx, K_rx, K_rz}}.asDiagonal();
  K(0, 4) = K(4, 0) = K_x_ry;
  K(1, 3) = K(3, 1) = -K_x_ry;
  return K;
}

TEST(GoughStewart, HasTheClosedFormsStiffnessUnloaded) {
  const System system = gough_stewart(0.8);
  const FirstEquilibrium found = free_equilibrium(system, Vector::Zero(6));
  ASSERT_EQ(found.status, StartStatus::found);
  const Matrix expected = stewart_stiffness(0.799096117577, 4.401807764847, 0.792325397672,
                                            0.289638952568, 0.560723105939);
  EXPECT_LT((stiffness_at(system, found) - expected).lpNorm<Eigen::Infinity>(), 1e-11);
}

TEST(GoughStewart, HasTheClosedFormsStiffnessUnderAVerticalLoad) {
  const System system = gough_stewart(0.8);
  const FirstEquilibrium found = free_equilibrium(system, -0.1 * Vector::Unit(6, 2));
  ASSERT_EQ(found.status, StartStatus::found);
  EXPECT_NEAR(0.8 - pose_of(system, found)[2], 0.022988772571, 1e-11);
  const Matrix expected =
      stewart_stiffness(0.722929846912, 4.296743768083, 0.7602985226, 0.236117518705, 0.5804124641);
  EXPECT_LT((stiffness_at(system, found) - expected).lpNorm<Eigen::Infinity>(), 2e-10);
}

TEST(GoughStewart, LosesItsStabilityByTiltTwistAndLimitInThisOrder) {
  struct Event {
    double w, P;
    Index before, after;
  };
  for (const Event& event :
       {Event{0.070503441914, 0.298500053063, 0, 2}, Event{0.119889292898, 0.491414606024, 2, 3},
        Event{0.441141753809, 1.193279344844, 3, 4}}) {
    EXPECT_NEAR(held_equilibrium(gough_stewart(0.8 - event.w)).inputs.W[2], -event.P, 1e-11);
    for (const double side : {-1e-9, 1e-9}) {
      const System system = gough_stewart(0.8 - event.w - side);
      const FirstEquilibrium found = held_equilibrium(system);
      ASSERT_EQ(found.status, StartStatus::found);
      EXPECT_EQ(stability_at(system, found).force_controlled, side < 0 ? event.before : event.after)
          << "w = " << event.w;
      EXPECT_EQ(stability_at(system, found).pose_controlled, 0);
    }
  }
}

}  // namespace
}  // namespace springfold::statics
