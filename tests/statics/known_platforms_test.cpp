// Published and closed-form stiffnesses of parallel platforms, and the commands that bring them to
// a loaded target.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "examples.hpp"

namespace springfold::statics {
namespace {

using std::numbers::pi;

// 3-RPR with leg springs, R = 1, r = 0.5, l = R - r in the centre:
// K_xx = K_yy = 3/2 k (2 - l0/l), K_psi = 3 k (l - l0) R r / l.
TEST(ThreeRpr, HasTheClosedFormsStiffnessInTheCentre) {
  for (const auto& [l0, K_xx, K_psi] :
       {std::tuple{0.3, 2.1, 0.6}, {0.45, 1.65, 0.15}, {0.55, 1.35, -0.15}, {0.8, 0.6, -0.9}}) {
    const System system = prepare(three_rpr({.free_length = l0}));
    const FirstEquilibrium found = free_equilibrium(system, Vector::Zero(3));
    ASSERT_EQ(found.status, StartStatus::found);
    const Matrix expected = Vector{{K_xx, K_xx, K_psi}}.asDiagonal();
    EXPECT_LT((stiffness_at(system, found) - expected).norm(), 1e-13) << "l0 = " << l0;
    EXPECT_EQ(stability_at(system, found).force_controlled, K_psi < 0 ? 1 : 0);
    EXPECT_EQ(stability_at(system, found).pose_controlled, 0);
  }
}

TEST(ThreeRpr, RestsTurnedWhereItsSpringsAreTooLong) {
  // cos psi = (R^2 + r^2 - l0^2) / (2 R r): all springs at their free length.
  for (const auto& [l0, psi] : {std::pair{0.55, 0.325471709506}, {0.8, 0.914735735870}})
    for (const double side : {-1.0, 1.0}) {
      const Vector near{{0.01, -0.02, side * (psi + 0.05)}};
      const System system = prepare(three_rpr({.free_length = l0, .pose = near}));
      const FirstEquilibrium found = free_equilibrium(system, Vector::Zero(3));
      ASSERT_EQ(found.status, StartStatus::found);
      EXPECT_NEAR(pose_of(system, found)[2], side * psi, 1e-11);
      EXPECT_NEAR(spring_energy(system, found.z), 0, 1e-20);
      EXPECT_EQ(stability_at(system, found).force_controlled, 0);
    }
}

TEST(ThreeRpr, TurnsUnderATorqueUpToTheClosedFormsLimit) {
  // M = 3 k (1 - l0/l) R r sin psi, limit at psi = 1.694472299461 for l0 = 0.3.
  const auto torque = [](double psi) {
    const double l = std::sqrt(1.25 - std::cos(psi));
    return 1.5 * (1 - 0.3 / l) * std::sin(psi);
  };
  for (const double psi : {0.2, 1.0, 1.694472299461, 2.5}) {
    const System system = prepare(three_rpr({.free_length = 0.3, .pose = Vector{{0, 0, psi}}}));
    const FirstEquilibrium found = held_equilibrium(system);
    ASSERT_EQ(found.status, StartStatus::found);
    EXPECT_NEAR(found.inputs.W[2], torque(psi), 1e-12) << "psi = " << psi;
  }
  EXPECT_NEAR(torque(1.694472299461), 1.107485546582, 1e-12);
}

// Inverse kinetostatics of the 3-RPR, k = 100: free lengths that hold the target under the load.
TEST(ThreeRpr, NeedsTheKnownCommandsForALoadedTarget) {
  struct Row {
    Vector target{}, load{}, lengths{};
  };
  const std::vector<Row> rows{{Vector{{0.05, -0.03, 0.1}}, Vector{{5, -3, 0.4}},
                               Vector{{0.504154077689, 0.506030278615, 0.468763103290}}},
                              {Vector{{-0.1, 0.08, -0.2}}, Vector{{0, -10, 1}},
                               Vector{{0.371932280753, 0.551839329495, 0.666099716085}}}};
  for (const Row& row : rows) {
    const System system =
        prepare(three_rpr({.stiffness = 100, .actuated = true, .pose = row.target}));
    const FirstEquilibrium found =
        first_equilibrium(system, {.unknowns = StartUnknowns::commands,
                                   .z = guess(system),
                                   .inputs = {system.commands, row.load}});
    ASSERT_EQ(found.status, StartStatus::found);
    EXPECT_LT((found.inputs.rho - row.lengths).norm(), 1e-11) << row.lengths.transpose();
    EXPECT_EQ(stability_at(system, found).force_controlled, 0);
    if (&row != &rows.front()) {
      const Vector mu = platform_stiffness(system, matrix_at(system, found)).eigenvalues;
      EXPECT_LT((mu - Vector{{10.145, 122.25, 183.28}}).norm(), 1e-2);
      continue;
    }
    const Matrix K = stiffness_at(system, found);
    const Vector entries{{K(0, 0), K(0, 1), K(0, 2), K(1, 1), K(1, 2), K(2, 2)}};
    const Vector expected{
        {158.414893908, -20.920472223, 1.948604000, 148.355371565, 1.051754356, 6.934675854}};
    EXPECT_LT((entries - expected).norm(), 1e-8);
  }
}

// 3-RRR, base circle 1, platform circle 0.3, links 0.6, base springs 10: K = J^-T k J^-1.
TEST(ThreeRrr, HasTheKnownUnloadedStiffness) {
  const auto stiffness_in = [](const Vector& pose) {
    model::Mechanism m;
    m.bodies = {{"triangle", model::TaskSpace::planar, pose}};
    for (const double direction : {90, 210, 330}) {
      const Vec3 out(std::cos(degrees(direction)), std::sin(degrees(direction)), 0);
      const double phi = pose[2];
      const Vec3 joint =
          Vec3(pose[0], pose[1], 0) +
          0.3 * Vec3(std::cos(degrees(direction) + phi), std::sin(degrees(direction) + phi), 0);
      const Vec3 across = joint - out;
      const double bend = std::acos(across.norm() / 1.2);  // of each link from the line across
      const double proximal = std::atan2(across[1], across[0]) + bend;
      model::Chain chain{.name = "leg" + std::to_string(direction)};
      chain.from_attachment.p = out;
      chain.to_attachment.p = 0.3 * out;
      chain.elements = {spring_hinge("base", 10, proximal), link_along_x(0.6),
                        hinge("elbow", -2 * bend), link_along_x(0.6),
                        hinge("platform", phi - proximal + 2 * bend)};
      m.chains.push_back(chain);
    }
    const System system = prepare(m);
    const FirstEquilibrium found = free_equilibrium(system, Vector::Zero(3));
    EXPECT_EQ(found.status, StartStatus::found);
    EXPECT_LT(found.moved, 1e-12);
    const Matrix K = stiffness_at(system, found);
    return Vector{{K(0, 0), K(0, 1), K(0, 2), K(1, 1), K(1, 2), K(2, 2)}};
  };
  EXPECT_LT((stiffness_in(Vector{{0, 0, 0}}) -
             Vector{{46.4017185822, 0, 0, 46.4017185822, 0, 5.5102040816}})
                .norm(),
            1e-9);
  EXPECT_LT(
      (stiffness_in(Vector{{0.1, 0.05, 0.1}}) - Vector{{45.2849728875, 11.9294654101, 1.4184463589,
                                                        49.2538100258, 1.9217634626, 6.5598156487}})
          .norm(),
      1e-9);
  EXPECT_LT((stiffness_in(Vector{{0.2, -0.1, -0.2}}) -
             Vector{{28.9022072779, 1.4865146311, 4.2704185302, 77.4841425534, 7.1871826059,
                     3.9681077757}})
                .norm(),
            1e-9);
}

// Commands that bring the loaded two-link arm to a target: q_a = IK(target) - K^-1 J^T F.
TEST(TwoLinkArm, NeedsTheKnownCommandsForALoadedTarget) {
  struct Row {
    double x, y, Fx, Fy, q1, q2, command1, command2;
  };
  const std::vector<Row> rows{
      {1.2, 0.9, 0.3, -0.2, 0.127907102547, 1.179648283489, 0.382907102547, 1.453014490060},
      {0.5, 1.0, -0.5, 0.4, NAN, NAN, -0.009825276497, 1.660931392697},
      {1.5, 0.3, 0, -0.8, NAN, NAN, 0.307798897812, 1.551890016307}};
  for (const Row& row : rows) {
    model::Mechanism m = two_link_arm(0.2, 1.2);
    for (model::Element& element : m.chains[0].elements)
      if (auto* joint = std::get_if<model::Joint>(&element)) {
        joint->command = joint->initial;
        joint->initial = 0;
        joint->role = model::JointRole::actuated;
        std::get<model::LinearSpring>(*joint->spring).free = 0;
      }
    m.bodies[0].pose = Vector{{row.x, row.y}};
    const System system = prepare(m);
    const FirstEquilibrium found =
        first_equilibrium(system, {.unknowns = StartUnknowns::commands,
                                   .z = guess(system),
                                   .inputs = {system.commands, Vector{{row.Fx, row.Fy}}}});
    ASSERT_EQ(found.status, StartStatus::found);
    EXPECT_LT((found.inputs.rho - Vector{{row.command1, row.command2}}).norm(), 1e-11);
    if (std::isnan(row.q1)) continue;
    EXPECT_LT((found.inputs.rho + found.z.head(2) - Vector{{row.q1, row.q2}}).norm(), 1e-11);
  }
}

}  // namespace
}  // namespace springfold::statics
