// Starts on special points and away from equilibrium; angles that count modulo full turns.
#include <gmock/gmock.h>

#include <numbers>

#include "analysis/path_problem.hpp"
#include "analysis/setup.hpp"
#include "analysis/steep_truss.hpp"
#include "cases/planar_orthoglide.hpp"

namespace springfold {
namespace {

using analysis::Branch;
using analysis::EventKind;
using analysis::StudyResult;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

using std::numbers::pi;

/// The truss held where it begins to sway.
analysis::Study at_sway_point(const SteepTruss& truss) {
  analysis::Study study = truss.study(0);
  study.start.solve = analysis::StartSolve::wrench;
  study.start.pose = Vector{{0.0, truss.sway_height(0)}};
  return study;
}

TEST(StartOnABranchPoint, IsFollowedAllWays) {
  const SteepTruss truss;
  const StudyResult result = run_study(truss.mechanism(), at_sway_point(truss));
  EXPECT_TRUE(complete(result));
  EXPECT_EQ(result.start.situation, "a branch point");
  ASSERT_THAT(result.start.ways, SizeIs(4));
  const std::size_t x = column(result, "apex.x");
  int across = 0;
  for (const auto& way : result.start.ways) {
    EXPECT_GT(way.branch, 0);
    if (std::abs(way.rates[x]) > 0.1) ++across;
  }
  EXPECT_EQ(across, 2);
  // One branch passes through it, as it would if it were begun elsewhere; the others begin there.
  EXPECT_EQ(result.branches.front().origin, "");
  EXPECT_THAT(events_of_kind(result, EventKind::branch_point), Not(IsEmpty()));
  for (std::size_t i = 1; i < result.branches.size(); ++i) {
    EXPECT_EQ(result.branches[i].origin, "BP1");
    EXPECT_EQ(result.branches[i].origin_branch, 1);
  }
}

TEST(StartOnALimitPoint, IsSaidToBeOne) {
  const SteepTruss truss;
  analysis::Study study = truss.study(0);
  study.start.solve = analysis::StartSolve::wrench;
  const double length = std::cbrt(truss.a * truss.a);
  study.start.pose = Vector{{0.0, std::sqrt(length * length - truss.a * truss.a)}};
  const StudyResult result = run_study(truss.mechanism(), study);
  EXPECT_TRUE(complete(result));
  EXPECT_EQ(result.start.situation, "a limit point");
  ASSERT_THAT(result.start.ways, SizeIs(2));
  const std::size_t y = column(result, "apex.y");
  EXPECT_LT(result.start.ways[0].rates[y] * result.start.ways[1].rates[y], 0);
  EXPECT_THAT(events_of_kind(result, EventKind::branch_point), SizeIs(4));
}

TEST(StartOnAThreshold, NamesTheSpringAndIsFollowedBothWays) {
  // The knees stand at 15 degrees, where their springs begin to act.
  const double angle = pi / 12;
  auto study = diagonal_study(std::sin(angle));
  const StudyResult result = run_study(planar_orthoglide(one_sided_knee()), study);
  EXPECT_TRUE(complete(result));
  EXPECT_EQ(result.start.situation,
            "on the threshold of spring leg_x.knee (acts above 0.2618), spring leg_y.knee (acts "
            "above 0.2618)");
  EXPECT_THAT(result.start.ways, SizeIs(2));
  EXPECT_GT(result.branches.front().start_row, 0u);
  EXPECT_LT(result.branches.front().start_row + 1, result.branches.front().samples.size());
}

TEST(StartAwayFromEquilibrium, SaysHowFarTheSolveMovedIt) {
  const SteepTruss truss;
  analysis::Study study = truss.study(0);
  study.start.pose = Vector{{0.0, truss.height() + 0.05}};
  const StudyResult result = run_study(truss.mechanism(), study);
  ASSERT_TRUE(result.start.found);
  EXPECT_NEAR(result.start.moved, 0.05, 0.02);  // the apex or a bar
  EXPECT_GT(result.start.guess_residual, 1e-3);
  EXPECT_FALSE(result.start.moved_most.empty());
}

TEST(StartAwayFromEquilibrium, IsRefusedBeyondTheLimit) {
  const SteepTruss truss;
  analysis::Study study = truss.study(0);
  study.start.pose = Vector{{0.0, truss.height() + 0.05}};
  study.start.maximum_move = 0.01;
  const StudyResult result = run_study(truss.mechanism(), study);
  EXPECT_FALSE(result.start.found);
  EXPECT_FALSE(complete(result));
  EXPECT_THAT(result.branches, IsEmpty());
  EXPECT_THAT(result.start.message, HasSubstr("start.maximum_move = 0.01"));
}

TEST(Periods, AreThoseOfJointsWithoutSpring) {
  const SteepTruss truss;
  const analysis::Setup setup = set_up(truss.mechanism(), truss.study(0), nullptr);
  const analysis::PathProblem problem(setup.system, setup.rule);
  const Vector periods = problem.periods();
  double sum = 0;
  for (Index i = 0; i < periods.size(); ++i) {
    const bool is_foot =
        setup.system.coordinate_names[static_cast<std::size_t>(i)].ends_with(".foot");
    EXPECT_EQ(periods[i], is_foot ? 2 * pi : 0) << i;
    sum += periods[i];
  }
  EXPECT_EQ(sum, 4 * pi);
}

TEST(Periods, AreNoneWhereASpringCountsTheTurns) {
  const analysis::Setup setup =
      set_up(planar_orthoglide(linear_knee(0.1)), diagonal_study(0.454), nullptr);
  const analysis::PathProblem problem(setup.system, setup.rule);
  EXPECT_TRUE(problem.periods().isZero(0));
}

/// A crank of length 1 on a rod of length 3 that is a spring; a slider drives it. Its relaxed
/// positions are a closed curve: the crank turns once round while the slider goes out and back.
TEST(Periods, CloseTheCurveOfACrankAfterOneTurn) {
  using namespace model;
  Mechanism m;
  const double angle = 1, slider = std::cos(angle) + std::sqrt(9 - std::pow(std::sin(angle), 2));
  m.bodies.push_back({"pin", TaskSpace::xy, Vector{{std::cos(angle), std::sin(angle)}}});
  Chain crank;
  crank.name = "crank";
  crank.elements.push_back(Joint{.name = "turn", .initial = angle});
  crank.elements.push_back(RigidLink{{Mat3<double>::Identity(), Vec3<double>::UnitX()}});
  Chain rod;
  rod.name = "rod";
  rod.elements.push_back(Joint{.name = "slider",
                               .kind = JointKind::prismatic,
                               .axis = Vec3<double>::UnitX(),
                               .role = JointRole::actuated,
                               .command = slider});
  rod.elements.push_back(
      Joint{.name = "swing", .initial = std::atan2(std::sin(angle), std::cos(angle) - slider)});
  rod.elements.push_back(Joint{.name = "stretch",
                               .kind = JointKind::prismatic,
                               .axis = Vec3<double>::UnitX(),
                               .role = JointRole::compliant,
                               .spring = LinearSpring{1, 0}});
  rod.elements.push_back(RigidLink{{Mat3<double>::Identity(), 3 * Vec3<double>::UnitX()}});
  m.chains = {crank, rod};
  analysis::Study study;
  study.name = "drive";
  study.control = analysis::ControlMode::actuator;
  study.actuators = {{"rod.slider", 1}};
  study.until = {{"rod.stretch", -0.5, 0.5}};
  const StudyResult result = run_study(m, study);
  ASSERT_THAT(result.branches, SizeIs(1));
  const Branch& branch = result.branches.front();
  EXPECT_TRUE(complete(result)) << branch.forward.reason;
  EXPECT_THAT(branch.forward.reason, HasSubstr("closed"));
  const double turned = value(result, branch, branch.samples.size() - 1, "crank.turn") -
                        value(result, branch, 0, "crank.turn");
  EXPECT_NEAR(std::abs(turned), 2 * pi, 1e-9);
  EXPECT_NEAR(value(result, branch, branch.samples.size() - 1, "lambda"), 0, 1e-9);
}

}  // namespace
}  // namespace springfold
