// Study kind `map`.
#include <gmock/gmock.h>

#include <numbers>

#include "command_mechanisms.hpp"

namespace springfold::analysis {
namespace {

using std::numbers::pi;

Study grid(double edge, int points) {
  Study study = command_study(StudyKind::map);
  study.map.axes = {{.name = "node.x", .pose = 0, .from = -edge, .to = edge, .points = points},
                    {.name = "node.y", .pose = 1, .from = -edge, .to = edge, .points = points}};
  study.map.directions = {Vector::Constant(2, std::sqrt(0.5))};
  return study;
}

const Branch& rows(const StudyResult& result) { return result.branches.front(); }

TEST(Map, CommandsEqualPlainInverseKinematicsExactlyWhereNoSpringIsActive) {
  const StudyResult result = run_study(orthoglide(one_sided(0.5, pi / 12)), grid(0.45, 21));
  ASSERT_TRUE(complete(result));
  int idle = 0;
  for (std::size_t row = 0; row < rows(result).samples.size(); ++row) {
    ASSERT_EQ(rows(result).samples[row].status, "ok");
    const double compensation = std::max(std::abs(value(result, row, "leg_x.drive.compensation")),
                                         std::abs(value(result, row, "leg_y.drive.compensation")));
    const bool is_idle = rows(result).samples[row].piece == "0.0";
    idle += is_idle ? 1 : 0;
    EXPECT_EQ(compensation <= 1e-12, is_idle);
  }
  EXPECT_GT(idle, 100);
  EXPECT_LT(idle, 441);
}

TEST(Map, ComplianceAndStiffnessAreInverseAndSymmetric) {
  const StudyResult result = run_study(orthoglide(linear(0.05)), grid(0.4, 9));
  for (std::size_t row = 0; row < rows(result).samples.size(); ++row) {
    EXPECT_NEAR(value(result, row, "K_trans_min") * value(result, row, "C_trans_max"), 1, 1e-10);
    EXPECT_NEAR(value(result, row, "K_trans_max") * value(result, row, "C_trans_min"), 1, 1e-10);
    EXPECT_NEAR(value(result, row, "velocity_max") * value(result, row, "force_min"), 1, 1e-10);
    // Mirroring the manipulator at the diagonal exchanges x and y.
    const std::size_t mirrored = row % 9 * 9 + row / 9;
    EXPECT_NEAR(value(result, row, "stiffness"), value(result, mirrored, "stiffness"), 1e-11);
  }
}

TEST(Map, CommandedGeometricallyThePlatformSettlesBesideTheNode) {
  Study study = grid(0.4, 5);
  study.map.command = NodeCommand::geometric;
  const StudyResult result = run_study(orthoglide(linear(0.05)), study);
  ASSERT_TRUE(complete(result));
  EXPECT_GT(std::abs(value(result, 24, "tool.x") - value(result, 24, "node.x")), 1e-3);
  EXPECT_NEAR(value(result, 24, "leg_x.drive.compensation"), 0, 1e-13);
  EXPECT_NEAR(value(result, 12, "tool.x"), 0, 1e-13);
}

TEST(Map, NodesOutsideAreMarkedWithTheReasonAndHaveNoNumbers) {
  const StudyResult result = run_study(orthoglide(linear(0.05)), grid(1.2, 5));
  EXPECT_TRUE(complete(result));
  const Sample& corner = rows(result).samples.back();
  EXPECT_THAT(corner.status, testing::HasSubstr("unreachable: chain leg_"));
  EXPECT_EQ(corner.values[0], 1.2);
  for (std::size_t i = 2; i < corner.values.size(); ++i) EXPECT_TRUE(std::isnan(corner.values[i]));
  EXPECT_EQ(rows(result).samples[12].status, "ok");
}

TEST(Map, ADriveWithBacklashHoldsEveryNodeBesideTheOneWithoutForce) {
  // k (x - rho + w) = -x for x > 0, the mirror image for x < 0; without force the command is free.
  Study study = command_study(StudyKind::map);
  study.map.axes = {{.name = "node.x", .pose = 0, .from = -0.5, .to = 0.5, .points = 6}};
  study.map.pose = Vector::Zero(2);
  for (const double rest : {0.0, 0.3}) {
    const StudyResult result = run_study(with_backlash(rest), study);
    ASSERT_TRUE(complete(result));
    EXPECT_EQ(rows(result).forward.reason, "6 nodes held and stable");
    for (std::size_t row = 0; row < 6; ++row) {
      const double x = value(result, row, "node.x");
      EXPECT_NEAR(value(result, row, "drive.slide.rho"), 1.5 * x + std::copysign(0.1, x), 1e-12);
    }
  }
}

TEST(Map, WithinABacklashTheNodeWithoutForceIsHeldAndCritical) {
  Study study = command_study(StudyKind::map);
  study.map.axes = {{.name = "node.x", .pose = 0, .from = 0, .to = 0, .points = 1}};
  study.map.pose = Vector::Zero(2);
  model::Mechanism m = with_backlash(0);
  m.chains.pop_back();  // nothing but the drive
  const StudyResult result = run_study(m, study);
  EXPECT_EQ(rows(result).samples[0].status, "critical");
  EXPECT_NEAR(value(result, 0, "drive.slide.rho"), 0, 1e-15);
}

TEST(Map, WhatADriveWouldHaveToBearAndNeverDoesIsSaidOfANodeThatIsNotHeld) {
  Study study = command_study(StudyKind::map);
  study.map.axes = {{.name = "node.x", .pose = 0, .from = -0.5, .to = 0.5, .points = 2}};
  study.map.pose = Vector::Zero(2);
  model::Mechanism m = with_backlash(0);
  std::get<model::Joint>(m.chains[0].elements[0]).spring = one_sided(2, 0.1);  // it only pulls
  const StudyResult result = run_study(m, study);
  EXPECT_TRUE(complete(result));
  EXPECT_NEAR(value(result, 0, "drive.slide.rho"), -0.85, 1e-12);
  EXPECT_EQ(rows(result).samples[1].status,
            "not held: the spring of drive.slide.theta would have to bear a force of -0.5, which "
            "it never does");
}

TEST(Map, ANodeAtWhichNothingIsFoundIsUndecidedAndNotOutside) {
  // With the commands of the node the load draws the spring of the drive to where it has no force.
  Study study = command_study(StudyKind::map);
  study.map.command = NodeCommand::geometric;
  study.map.axes = {{.name = "node.x", .pose = 0, .from = 0, .to = 0.5, .points = 2}};
  study.map.pose = Vector::Zero(2);
  study.constant_load = Vector{{-1, 0}};
  model::Mechanism m = with_backlash(0);
  m.chains.pop_back();
  std::get<model::Joint>(m.chains[0].elements[0]).spring = one_sided(2, 0.1);
  const StudyResult result = run_study(m, study);
  EXPECT_FALSE(complete(result));
  EXPECT_EQ(rows(result).samples[0].state, NodeState::undecided);
  EXPECT_EQ(rows(result).forward.reason, "0 nodes held and stable, 2 undecided");
  ASSERT_EQ(result.doubts.size(), 1u);
}

TEST(Map, TheCriticalLoadOfAStudyAlongTheDiagonalIsThatOfTable1) {
  // From Q2 with the paper's commands, pushed along the diagonal: the first maximum of the force.
  Study study = command_study(StudyKind::map);
  study.map.axes = {{.name = "node.x", .pose = 0, .from = 0.454, .to = 0.454, .points = 1}};
  study.map.pose = Vector{{0, 0.454}};
  study.map.critical = {.direction = Vector::Constant(2, std::sqrt(0.5)), .up_to = 0.2};
  for (const auto& [stiffness, critical] :
       {std::pair{0.0, 0.020238288956}, {0.01, 0.027008033908}}) {
    const StudyResult result = run_study(orthoglide(linear(stiffness)), study);
    ASSERT_TRUE(complete(result));
    EXPECT_NEAR(value(result, 0, "critical_load"), critical, 1e-10);
  }
}

TEST(Map, WithoutLossOfStabilityUpToTheLimitTheCriticalLoadIsInfinite) {
  Study study = grid(0.1, 2);
  study.map.critical = {.direction = Vector::Constant(2, -std::sqrt(0.5)), .up_to = 0.05};
  const StudyResult result = run_study(orthoglide(linear(0.05)), study);
  ASSERT_TRUE(complete(result));
  EXPECT_TRUE(std::isinf(value(result, 0, "critical_load")));
}

TEST(Map, RunsOverParametersOfTheCase) {
  Study study = command_study(StudyKind::map);
  study.map.axes = {{.name = "Kv", .from = 0, .to = 0.1, .points = 3},
                    {.name = "node.x", .pose = 0, .from = -0.454, .to = 0.454, .points = 2}};
  study.map.pose = Vector{{0, 0.454}};
  study.map.situation = [](const std::vector<double>& values) {
    return Situation{.mechanism = orthoglide(linear(values[0])), .pose = Vector{{0, 0.454}}};
  };
  const StudyResult result = run_study(orthoglide(linear(0)), study);
  ASSERT_TRUE(complete(result));
  ASSERT_EQ(rows(result).samples.size(), 6u);
  EXPECT_EQ(value(result, 4, "Kv"), 0.05);
  EXPECT_NEAR(value(result, 4, "leg_x.drive.rho"), 1.398920189796, 1e-10);  // Table 1, Q2
  EXPECT_NEAR(value(result, 5, "leg_y.drive.rho"), 1.452838696091, 1e-10);
}

void expect_same(const StudyResult& a, const StudyResult& b) {
  ASSERT_EQ(rows(a).samples.size(), rows(b).samples.size());
  for (std::size_t row = 0; row < rows(a).samples.size(); ++row) {
    const Sample &x = rows(a).samples[row], &y = rows(b).samples[row];
    EXPECT_EQ(x.status, y.status);
    EXPECT_EQ(x.piece, y.piece);
    for (std::size_t i = 0; i < x.values.size(); ++i) {
      const bool both_undefined = std::isnan(x.values[i]) && std::isnan(y.values[i]);
      ASSERT_TRUE(both_undefined || x.values[i] == y.values[i]);
    }
  }
}

TEST(Map, IsTheSameWithOneTwoAndEightThreads) {
  Study study = grid(1.05, 15);
  study.map.critical = {.direction = Vector::Constant(2, std::sqrt(0.5)), .up_to = 0.05};
  const model::Mechanism mechanism = orthoglide(one_sided(0.5, pi / 12));
  const StudyResult one = run_study(mechanism, study, nullptr, {}, {.threads = 1});
  expect_same(one, run_study(mechanism, study, nullptr, {}, {.threads = 2}));
  expect_same(one, run_study(mechanism, study, nullptr, {}, {.threads = 8}));
}

TEST(Map, InterruptedAndResumedItIsTheSame) {
  const Study study = grid(1.05, 150);
  const model::Mechanism mechanism = orthoglide(linear(0.05));
  const StudyResult whole = run_study(mechanism, study);
  PartialRows kept;
  const StudyResult part =
      run_study(mechanism, study, nullptr, [](int nodes, double) { return nodes < 1; },
                {.threads = 1, .checkpoint = [&](const PartialRows& rows) { kept = rows; }});
  EXPECT_FALSE(complete(part));
  EXPECT_THAT(rows(part).forward.reason, testing::HasSubstr("not computed"));
  const auto done = std::count(kept.done.begin(), kept.done.end(), true);
  EXPECT_GT(done, 0);
  EXPECT_LT(done, 22500);
  const StudyResult resumed = run_study(mechanism, study, nullptr, {}, {.known = &kept});
  EXPECT_TRUE(complete(resumed));
  expect_same(whole, resumed);
}

}  // namespace
}  // namespace springfold::analysis
