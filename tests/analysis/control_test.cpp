// Study kind `control`: commands along paths.
#include <gmock/gmock.h>

#include <numbers>

#include "command_mechanisms.hpp"

namespace springfold::analysis {
namespace {

using testing::HasSubstr;

using std::numbers::pi;
const double edge_pose = 0.454;

Study along(const std::vector<Vector>& targets) {
  Study study = command_study(StudyKind::control);
  study.targets.targets = targets;
  return study;
}

TEST(Control, RowsOfTable1ComeFromOnePathThroughQ1AndQ2) {
  // Paper, Table 1 with 12 digits from the closed form of the diagonal.
  const double stiffness[] = {0, 0.01, 0.05, 0.1};
  const double rho_Q1[] = {0.437001683500, 0.433497973681, 0.419483134407, 0.401964585313};
  const double rho_Q2[] = {1.345001683500, 1.355785384759, 1.398920189796, 1.452838696091};
  for (int i = 0; i < 4; ++i) {
    Study study = along({Vector::Constant(2, -edge_pose), Vector::Constant(2, edge_pose)});
    study.direction = Vector::Constant(2, std::sqrt(0.5));
    const StudyResult result = run_study(orthoglide(linear(stiffness[i])), study);
    ASSERT_TRUE(complete(result));
    const std::size_t last = result.branches[0].samples.size() - 1;
    EXPECT_NEAR(value(result, 0, "leg_x.drive.rho"), rho_Q1[i], 1e-9);
    EXPECT_NEAR(value(result, last, "leg_y.drive.rho"), rho_Q2[i], 1e-9);
    EXPECT_NEAR(value(result, 0, "residual.Fx"), 0, 1e-12);
    EXPECT_NEAR(value(result, last, "residual.Fy"), 0, 1e-12);
    EXPECT_EQ(value(result, last, "index_force"), 0);
  }
}

TEST(Control, CompensationIsTheDifferenceFromPlainInverseKinematics) {
  Study study = along({Vector{{0.3, -0.2}}});
  study.constant_load = Vector{{0.1, 0.05}};
  const StudyResult result = run_study(orthoglide(linear(0.05)), study);
  ASSERT_TRUE(complete(result));
  EXPECT_NEAR(value(result, 0, "leg_x.drive.plain"), 0.3 + std::sqrt(1 - 0.04), 1e-12);
  EXPECT_NEAR(value(result, 0, "leg_y.drive.plain"), -0.2 + std::sqrt(1 - 0.09), 1e-12);
  EXPECT_NEAR(value(result, 0, "leg_x.drive.compensation"),
              value(result, 0, "leg_x.drive.rho") - value(result, 0, "leg_x.drive.plain"), 1e-15);
  EXPECT_GT(std::abs(value(result, 0, "leg_x.drive.compensation")), 0.01);
}

TEST(Control, OnACircleOneSidedSpringsSwitchWhereTheirAnglesSay) {
  Study study = command_study(StudyKind::control);
  study.targets.circle = {.centre = Vector::Zero(2), .radius = 0.4, .from = 0, .to = 2 * pi};
  study.targets.circle_points = 25;
  const StudyResult result = run_study(orthoglide(one_sided(0.5, pi / 12)), study);
  ASSERT_TRUE(complete(result)) << result.branches[0].forward.reason;
  EXPECT_NEAR(value(result, result.branches[0].samples.size() - 1, "way"), 0.8 * pi, 1e-12);
  int switches = 0;
  for (const Event& event : result.branches[0].events) {
    ASSERT_EQ(event.kind, EventKind::switching);
    ++switches;
    // leg_x has the angle asin y, leg_y asin x.
    const double x = value(result, event.row, "tool.x"), y = value(result, event.row, "tool.y");
    const double edge = std::sin(pi / 12);
    EXPECT_LT(std::min(std::abs(x - edge), std::abs(y - edge)), 1e-10);
  }
  EXPECT_EQ(switches, 4);
  for (std::size_t row = 0; row < result.branches[0].samples.size(); ++row) {
    if (result.branches[0].samples[row].piece != "0.0") continue;
    EXPECT_NEAR(value(result, row, "leg_x.drive.compensation"), 0, 1e-12);
  }
}

/// Two links with elastic drives at their joints.
model::Mechanism arm() {
  using namespace model;
  const auto drive = [](const char* name, double stiffness, double command) {
    return Joint{.name = name,
                 .role = JointRole::actuated,
                 .spring = LinearSpring{stiffness, 0},
                 .command = command};
  };
  const auto link = [](double length) {
    return RigidLink{{Mat3<double>::Identity(), {length, 0, 0}}};
  };
  Mechanism m;
  m.bodies = {{"tip", TaskSpace::xy, Vector{{1.2, 0.9}}}};
  m.chains = {
      {.name = "arm",
       .elements = {drive("shoulder", 2, 0.1), link(1), drive("elbow", 1, 1.2), link(0.8)}}};
  return m;
}

TEST(Control, IsLostAtTheLimitPointWhereTheArmIsStretched) {
  Study study = along({Vector{{1.2, 0}}, Vector{{1.6, 0}}, Vector{{2, 0}}});
  study.constant_load = Vector{{0.3, -0.2}};
  const StudyResult result = run_study(arm(), study);
  EXPECT_FALSE(complete(result));
  ASSERT_FALSE(result.branches.empty());
  const std::size_t row = row_of(result, "LP1");
  EXPECT_NEAR(value(result, row, "path"), 2.5, 1e-9);  // 1.6 + 0.5 * 0.4 = 1 + 0.8
  EXPECT_NEAR(value(result, row, "tip.x"), 1.8, 1e-9);
  EXPECT_THAT(result.branches[0].forward.reason, HasSubstr("control is lost at path = 2.5"));
  const Sample& unreachable = result.branches[0].samples.back();
  EXPECT_THAT(unreachable.status, HasSubstr("arm cannot be closed, it is short by 0.2"));
  EXPECT_TRUE(std::isnan(unreachable.values[column(result, "arm.elbow.rho")]));
  EXPECT_TRUE(std::isnan(unreachable.values[column(result, "tip.x")]));
}

TEST(Control, IsLostAtAKinematicSingularityWhereALegIsStretched) {
  // Straight up: the link of leg_x stands across its slider at y = 1.
  const StudyResult result =
      run_study(orthoglide(linear(0)), along({Vector{{0, 0}}, Vector{{0, 0.9}}, Vector{{0, 1.2}}}));
  ASSERT_FALSE(result.branches.empty());
  const std::size_t row = row_of(result, "KS1");
  EXPECT_NEAR(value(result, row, "path"), 2 + 1.0 / 3, 1e-9);
  EXPECT_EQ(result.branches[0].events.size(), 1u);
  EXPECT_THAT(result.branches[0].forward.reason, HasSubstr("control is lost at path = 2.3333"));
}

TEST(Control, SaysWhereACommandedPointLosesItsStability) {
  // Without springs the stiffness along the diagonal vanishes where the links lie in one line:
  // under a dead load outwards it does before.
  Study study = along({Vector::Constant(2, 0.3), Vector::Constant(2, 0.69)});
  study.constant_load = Vector::Constant(2, 0.1 * std::sqrt(0.5));
  study.direction = Vector::Constant(2, std::sqrt(0.5));
  const StudyResult result = run_study(orthoglide(linear(0)), study);
  ASSERT_FALSE(result.branches.empty());
  const std::size_t row = row_of(result, "SC1");
  // F = sqrt(2) K theta theta', K_along = K (theta'^2 + theta theta''), theta' = 1 - tan a.
  const double s = value(result, row, "tool.x"), t = s / std::sqrt(1 - s * s);
  const double theta = 0.1 / (std::sqrt(2) * (1 - t));
  const double curvature = -1 / std::pow(1 - s * s, 1.5);
  EXPECT_NEAR((1 - t) * (1 - t) + theta * curvature, 0, 1e-8);
  EXPECT_NEAR(value(result, row, "stiffness"), 0, 1e-8);
  EXPECT_EQ(result.branches[0].samples.back().status, "unstable");
}

TEST(Control, WrenchesMayChangeFromTargetToTarget) {
  Study study = along({Vector{{0.1, 0.1}}, Vector{{0.1, 0.1}}, Vector{{0.1, 0.1}}});
  study.targets.loads = {Vector{{0, 0}}, Vector{{0.1, 0}}, Vector{{0.2, 0}}};
  const StudyResult result = run_study(orthoglide(linear(0)), study);
  ASSERT_TRUE(complete(result)) << result.branches[0].forward.reason;
  EXPECT_NEAR(value(result, 0, "leg_x.drive.compensation"), 0, 1e-12);
  const double first = value(result, 1, "leg_x.drive.compensation");
  EXPECT_GT(std::abs(first), 0.05);
  EXPECT_NEAR(value(result, 2, "leg_x.drive.compensation"), 2 * first, 1e-10);
}

TEST(Control, ThePapersSchemeGivesTheSameRows) {
  Study study = along({Vector{{0.1, 0.2}}, Vector{{0.3, 0.2}}, Vector{{0.4, -0.3}}});
  const StudyResult exact = run_study(orthoglide(linear(0.05)), study);
  study.command.method = CommandMethod::paper;
  const StudyResult paper = run_study(orthoglide(linear(0.05)), study);
  ASSERT_TRUE(complete(exact));
  ASSERT_TRUE(complete(paper));
  for (std::size_t row = 0; row < 3; ++row)
    EXPECT_NEAR(value(exact, row, "leg_x.drive.rho"), value(paper, row, "leg_x.drive.rho"), 1e-10);
}

TEST(Control, OtherUnitsChangeNothingButTheNumbers) {
  const std::vector<Vector> targets{Vector{{0.1, 0.2}}, Vector{{0.4, -0.3}}};
  const StudyResult one = run_study(orthoglide(linear(0.05)), along(targets));
  const StudyResult thousand = run_study(orthoglide(linear(0.05 * 1000), 1000),
                                         along({1000 * targets[0], 1000 * targets[1]}));
  EXPECT_NEAR(value(thousand, 1, "leg_x.drive.rho"), 1000 * value(one, 1, "leg_x.drive.rho"), 1e-8);
  EXPECT_NEAR(value(thousand, 1, "velocity_max"), value(one, 1, "velocity_max"), 1e-9);
  EXPECT_NEAR(value(thousand, 1, "K_trans_min"), value(one, 1, "K_trans_min") / 1000, 1e-12);
}

TEST(Control, FindsCommandsBeyondABacklashWhereverItsSpringStandsAtFirst) {
  for (const double rest : {0.0, 0.3}) {
    Study study = along({Vector{{-0.5, 0}}, Vector{{-0.25, 0}}, Vector{{0.25, 0}}});
    const StudyResult result = run_study(with_backlash(rest), study);
    ASSERT_TRUE(result.start.found);
    double x = 0;
    int targets = 0;
    for (std::size_t row = 0; row < result.branches[0].samples.size(); ++row) {
      if (result.branches[0].samples[row].status == "on the way") continue;
      ++targets;
      x = value(result, row, "tool.x");
      EXPECT_NEAR(value(result, row, "drive.slide.rho"), 1.5 * x + std::copysign(0.1, x), 1e-10);
    }
    EXPECT_EQ(targets, 3);
    EXPECT_NEAR(x, 0.25, 1e-15);
  }
}

TEST(Control, WithoutAnyReachableTargetThereIsNoStart) {
  const StudyResult result = run_study(orthoglide(linear(0)), along({Vector{{0, 2}}}));
  EXPECT_FALSE(result.start.found);
  EXPECT_THAT(result.start.message, HasSubstr("target 1: unreachable"));
  EXPECT_TRUE(result.branches.empty());
}

}  // namespace
}  // namespace springfold::analysis
