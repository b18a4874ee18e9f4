// Published and closed-form equilibria and stiffnesses of small planar mechanisms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "examples.hpp"

namespace springfold::statics {
namespace {

void expect_near(const Matrix& value, const Matrix& expected, double tolerance,
                 const std::string& what) {
  ASSERT_EQ(value.rows(), expected.rows()) << what;
  EXPECT_LT((value - expected).lpNorm<Eigen::Infinity>(), tolerance) << what << ": got\n"
                                                                     << value << "\ninstead of\n"
                                                                     << expected;
}

// Arm of two links, l = (1, 0.8), joint springs k = (2, 1), pushed at its tip:
// K = J^-T (K_theta - sum F d2p/dq2) J^-1, computed independently.
TEST(TwoLinkArm, HasTheClosedFormsPositionAndStiffnessUnderLoad) {
  struct Row {
    double q1, q2, Fx, Fy, q1_loaded, q2_loaded, x, y, K_xx, K_xy, K_yy;
  };
  const std::vector<Row> rows{
      {30, 60, 0, 0, 30, 60, 0.866025403784, 1.3, 1.5625, 2.3454854686, 6.1875},
      {30, 60, 0.3, -0.2, 14.0892953324, 43.4773455432, 1.398972148781, 0.918646452560,
       7.8018203593, 6.3804172128, 6.1578356116},
      {30, 60, -0.5, 0, 49.9965870986, 78.0487143665, 0.149805774081, 1.396025136132, 0.8690368185,
       -0.3116068509, 4.5053910170},
      {45, 90, 0, 0, 45, 90, 0.141421356237, 1.272792206136, 1.03125, -0.71875, 3.53125},
      {45, 90, 0, -0.8, 47.8729918351, 126.4921043718, -0.125357917262, 0.820211060174,
       2.1250930314, -0.5368205948, 1.5638099606},
      {-20, 110, 0.3, -0.2, -29.0177372058, 93.6472917285, 1.217244873101, 0.237764786734,
       2.7093732196, 1.3989551412, 2.0073222773},
      {10, 20, -0.5, 0, 27.2162891805, 41.3304439361, 1.181880154746, 1.201923724701, 5.0669498273,
       6.0900628132, 8.1551683103}};
  for (const Row& row : rows) {
    const System system = prepare(two_link_arm(degrees(row.q1), degrees(row.q2)));
    const FirstEquilibrium found = free_equilibrium(system, Vector{{row.Fx, row.Fy}});
    ASSERT_EQ(found.status, StartStatus::found);
    expect_near(found.z.head(2), Vector{{degrees(row.q1_loaded), degrees(row.q2_loaded)}}, 1e-11,
                "joint angles");
    expect_near(pose_of(system, found), Vector{{row.x, row.y}}, 1e-11, "tip");
    expect_near(stiffness_at(system, found), Matrix{{row.K_xx, row.K_xy}, {row.K_xy, row.K_yy}},
                1e-9, "stiffness");
    EXPECT_EQ(stability_at(system, found).force_controlled, 0);
  }
}

// The straight arm under axial compression: l1 l2 P^2 - (k2 (l1 + l2) + k1 l2) P + k1 k2 = 0.
TEST(TwoLinkArm, BucklesAtTheClosedFormLoads) {
  const System system = prepare(two_link_arm(0, 0));
  const auto index_under = [&](double P) {
    FirstEquilibrium straight{.z = guess(system), .inputs = {Vector(0), Vector{{-P, 0}}}};
    straight.z.segment(system.chain_slices[0].F, 2) = straight.inputs.W;
    return stability_at(system, straight).force_controlled;
  };
  Index index = 0;
  for (const double critical : {0.705272913550, 3.544727086450}) {
    EXPECT_EQ(index_under(critical - 1e-11), index);
    EXPECT_EQ(index_under(critical + 1e-11), ++index);
  }
}

// ANSYS VM9 (Vanderplaats 3-1); published 8.631, 4.533, energy 24.01; exact values computed.
TEST(UnequalSprings, DeflectAsInTheVerificationManual) {
  const std::vector<Bar> bars{{0, 0, 1, 10}, {0, 20, 8, 10}};
  const System system = prepare(spring_point(bars, Vector{{5, 12}}));
  const FirstEquilibrium found = free_equilibrium(system, Vector{{5, 5}});
  ASSERT_EQ(found.status, StartStatus::found);
  const Vector moved = pose_of(system, found) - Vector{{0, 10}};
  expect_near(moved, Vector{{8.6320661333, 4.5319066990}}, 1e-9, "displacement");
  expect_near(moved, Vector{{8.631, 4.533}}, 5e-4 * 8.631, "published displacement");
  EXPECT_NEAR(spring_energy(system, found.z), 24.0116342189, 1e-9);
  expect_near(stiffness_at(system, found),
              Matrix{{6.3206907055, -3.2794749398}, {-3.2794749398, 3.2585448938}}, 1e-9,
              "stiffness");
  EXPECT_EQ(stability_at(system, found).force_controlled, 0);
}

TEST(UnequalSprings, HaveOneUnstableEquilibriumBeside) {
  const std::vector<Bar> bars{{0, 0, 1, 10}, {0, 20, 8, 10}};
  const System system = prepare(spring_point(bars, Vector{{-4.4, 26.9}}));
  const FirstEquilibrium found = free_equilibrium(system, Vector{{5, 5}});
  ASSERT_EQ(found.status, StartStatus::found);
  expect_near(pose_of(system, found) - Vector{{0, 10}}, Vector{{-4.48651641, 16.87249425}}, 1e-8,
              "displacement");
  EXPECT_EQ(stability_at(system, found).force_controlled, 1);
}

// A vertical spring kv and two oblique ones ko = 1, free length 1.5, half span 1, held at height x:
// F = kv x + 2 ko x (1 - l0 / sqrt(x^2 + a^2)).
System quasi_zero_stiffness(double kv, double x) {
  model::Mechanism m = spring_point({{-1, 0, 1, 1.5}, {1, 0, 1, 1.5}}, Vector{{0, x}});
  model::Joint slide{.name = "slide", .kind = model::JointKind::prismatic, .axis = Vec3::UnitX()};
  model::Joint lift = spring_slider(kv, 0);
  lift.axis = Vec3::UnitY();
  lift.initial = x;
  m.chains.push_back({.name = "vertical", .elements = {slide, lift}});
  return prepare(m);
}

TEST(QuasiZeroStiffness, HoldsTheClosedFormsForce) {
  for (const auto& [x, F] : {std::pair{0.1, 0.001488842937},
                             {0.3, 0.037956343301},
                             {0.5, 0.158359213500},
                             {1.0, 0.878679656440}}) {
    const System system = quasi_zero_stiffness(1, x);
    const FirstEquilibrium found = held_equilibrium(system);
    ASSERT_EQ(found.status, StartStatus::found);
    EXPECT_NEAR(found.inputs.W[1], F, 1e-12) << "x = " << x;
    EXPECT_NEAR(found.inputs.W[0], 0, 1e-14);
  }
}

TEST(QuasiZeroStiffness, HasNoStiffnessInTheMiddle) {
  const System system = quasi_zero_stiffness(1, 0);
  const FirstEquilibrium found = held_equilibrium(system);
  ASSERT_EQ(found.status, StartStatus::found);
  EXPECT_NEAR(stiffness_at(system, found)(1, 1), 0, 1e-14);
  EXPECT_NEAR(stiffness_at(system, found)(0, 0), 2, 1e-14);  // two bars along x
  EXPECT_EQ(stability_at(system, found).pose_controlled, 0);
  EXPECT_FALSE(stability_at(system, found).force_controlled.has_value());
}

TEST(QuasiZeroStiffness, WithASofterSpringHasLimitPointsAndThreeRestPositions) {
  // (x^2 + a^2)^(3/2) = 2 ko l0 a^2 / (kv + 2 ko)
  const double limit = 0.359504151099;
  System system = quasi_zero_stiffness(0.5, limit);
  FirstEquilibrium found = held_equilibrium(system);
  EXPECT_NEAR(found.inputs.W[1], -0.116158698402, 1e-12);
  EXPECT_NEAR(stiffness_at(system, found)(1, 1), 0, 1e-11);
  for (const auto& [guess, rest, index] :
       {std::tuple{0.01, 0.0, 1}, {0.6, 0.663324958071, 0}, {-0.6, -0.663324958071, 0}}) {
    system = quasi_zero_stiffness(0.5, guess);
    found = free_equilibrium(system, Vector::Zero(2));
    ASSERT_EQ(found.status, StartStatus::found);
    EXPECT_NEAR(pose_of(system, found)[1], rest, 1e-11);
    EXPECT_EQ(stability_at(system, found).force_controlled, index);
  }
}

// Two equal springs, k = 1, l0 = 1.5, from (-1, 0) and (1, 0): five equilibria, by resultants.
TEST(TwoSprings, HaveFiveEquilibriaWithTheirIndices) {
  struct Row {
    double x, y;
    Index index;
  };
  const auto check = [](const Vector& W, const std::vector<Row>& rows) {
    for (const Row& row : rows) {
      const Vector near{{row.x + 0.02, row.y - 0.01}};
      const System system = prepare(spring_point({{-1, 0, 1, 1.5}, {1, 0, 1, 1.5}}, near));
      const FirstEquilibrium found = free_equilibrium(system, W);
      ASSERT_EQ(found.status, StartStatus::found);
      expect_near(pose_of(system, found), Vector{{row.x, row.y}}, 2e-9, "position");
      EXPECT_EQ(stability_at(system, found).force_controlled, row.index) << row.x << " " << row.y;
    }
  };
  check(Vector{{0, 0}},
        {{0, 0, 1}, {1.5, 0, 1}, {-1.5, 0, 1}, {0, std::sqrt(1.25), 0}, {0, -std::sqrt(1.25), 0}});
  check(Vector{{0.1, 0.05}}, {{-1.448737228, -0.025643712, 1},
                              {0.05018702, -0.049810509, 1},
                              {1.548128908, -0.03791727, 1},
                              {0.11100762, -1.074047668, 0},
                              {0.114697403, 1.16338159, 0}});
}

}  // namespace
}  // namespace springfold::statics
