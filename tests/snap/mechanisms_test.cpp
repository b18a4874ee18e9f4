// Jumps of mechanisms from case files, against the closed forms of cases/snap-through/README.md.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "springfold/analysis/run.hpp"
#include "springfold/analysis/snap.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::analysis {
namespace {

constexpr double tight = 1e-9;

SnapResult run(const std::string& name, std::size_t number = 0,
               const std::map<std::string, std::string>& parameters = {}) {
  const io::Case c = io::load_case(
      std::string{SPRINGFOLD_SOURCE_DIR} + "/cases/snap-through/case-" + name + ".toml",
      parameters);
  const io::PlannedRun& planned = c.runs.at(number);
  return run_with_jumps(planned.mechanism, planned.plan);
}

double value(const SnapResult& result, const SnapState& state, const std::string& name) {
  for (std::size_t i = 0; i < result.traced.quantities.size(); ++i)
    if (result.traced.quantities[i].name == name && i < state.values.size()) return state.values[i];
  return std::numeric_limits<double>::quiet_NaN();
}

/// The jump at this load in this sense whose landing has the given value, or the first one there.
const Jump* jump_at(const SnapResult& result, double lambda, int loading) {
  for (const Jump& jump : result.report.jumps)
    if (std::abs(value(result, jump.critical, "lambda") - lambda) < 1e-9 && jump.loading == loading)
      return &jump;
  return nullptr;
}

void expect_loop(const SnapResult& result, const Jump& jump, double back_at, double back_released,
                 double loop) {
  ASSERT_GT(jump.back, 0);
  const Jump& back = result.report.jumps[static_cast<std::size_t>(jump.back - 1)];
  EXPECT_NEAR(value(result, back.critical, "lambda"), back_at, tight);
  EXPECT_NEAR(back.released, back_released, tight);
  EXPECT_NEAR(jump.loop, loop, tight);
}

TEST(SnapThrough, OfTheVonMisesTrussLandsAtItsMirrorImagesBranchAndComesBack) {
  const SnapResult result = run("truss");
  ASSERT_TRUE(complete(result.traced));
  const Jump* jump = jump_at(result, 0.26502825343741, 1);
  ASSERT_NE(jump, nullptr);
  EXPECT_EQ(jump->verdict, SnapVerdict::unambiguous);
  EXPECT_NEAR(1 - value(result, jump->landing, "apex.y"), 2.2297397072209, tight);
  EXPECT_NEAR(value(result, jump->landing, "index"), 0, 0);
  EXPECT_GT(jump->landing.branch, 0);
  EXPECT_NEAR(jump->released, 0.51698086561453, tight);
  expect_loop(result, *jump, -0.26502825343741, 0.51698086561453, 1.0339617312291);
}

TEST(SnapThrough, OfTheOrthoglideWithoutSpringsStaysUnderTheLoad) {
  const SnapResult result = run("orthoglide", 0);
  const Jump* jump = jump_at(result, 0.020238288956394, 1);
  ASSERT_NE(jump, nullptr);
  EXPECT_EQ(jump->verdict, SnapVerdict::unambiguous);
  EXPECT_NEAR(value(result, jump->landing, "tool.x"), 0.90350091573749, tight);
  EXPECT_NEAR(value(result, jump->landing, "leg_x.knee"), 64.622132375379 * std::numbers::pi / 180,
              tight);
  EXPECT_NEAR(jump->released, 0.011553912504788, tight);
  EXPECT_TRUE(jump->warnings.empty());
  expect_loop(result, *jump, -0.029523906987403, 0.019034810180522, 0.030588722685311);
}

TEST(SnapThrough, OfTheOrthoglideWithSpringsComesBackBeforeTheLoadIsGone) {
  const SnapResult result = run("orthoglide", 1);
  const Jump* jump = jump_at(result, 0.027008033907832, 1);
  ASSERT_NE(jump, nullptr);
  EXPECT_EQ(jump->verdict, SnapVerdict::unambiguous);
  EXPECT_NEAR(value(result, jump->landing, "tool.x"), 0.87471065688046, tight);
  EXPECT_NEAR(jump->released, 0.0052369174495642, tight);
  expect_loop(result, *jump, 0.00083755900613600, 0.0078087597671122, 0.013045677216676);
  const Jump& back = result.report.jumps[static_cast<std::size_t>(jump->back - 1)];
  EXPECT_NEAR(value(result, back.landing, "tool.x"), 0.45620003933821, tight);
}

TEST(SnapThrough, OfTheToggleEndsOnItsStopAndLeavesItAtTheCorner) {
  const SnapResult result = run("toggle");
  const Jump* jump = jump_at(result, 0.37480655042324, 1);
  ASSERT_NE(jump, nullptr);
  EXPECT_EQ(jump->verdict, SnapVerdict::unambiguous);
  const double top = std::sin(std::numbers::pi / 4);
  EXPECT_NEAR(top - value(result, jump->landing, "knee.y"), 0.44901711710292, tight);
  EXPECT_NEAR(jump->released, 0.0044837714304874, tight);
  EXPECT_EQ(jump->switches.size(), 1u);
  expect_loop(result, *jump, 0.31569001083599, 0.010398734432115, 0.014882505862603);
  const Jump& back = result.report.jumps[static_cast<std::size_t>(jump->back - 1)];
  EXPECT_NEAR(top - value(result, back.landing, "knee.y"), 0.13517822910378, tight);
}

TEST(SnapThrough, OfTheSwitchReleasesTheSameBothWays) {
  const SnapResult result = run("switch");
  const Jump* jump = jump_at(result, 0.11615869840176, 1);
  ASSERT_NE(jump, nullptr);
  EXPECT_EQ(jump->verdict, SnapVerdict::unambiguous);
  EXPECT_NEAR(value(result, jump->landing, "mass.x"), 0.79081292830809, tight);
  EXPECT_NEAR(jump->released, 0.15018405067161, tight);
  expect_loop(result, *jump, -0.11615869840176, 0.15018405067161, 0.30036810134321);
}

TEST(SnapThrough, OfTheSofteningStrutBeginsAtTheCornersOfBothBentBranches) {
  const SnapResult result = run("strut");
  const Jump* jump = jump_at(result, 1.0429148214667, 1);
  ASSERT_NE(jump, nullptr);
  EXPECT_EQ(jump->verdict, SnapVerdict::unambiguous);
  EXPECT_NEAR(std::abs(value(result, jump->landing, "strut.hinge")), 1.5856010608802, tight);
  EXPECT_NEAR(jump->released, 0.093250427155302, tight);
  expect_loop(result, *jump, 0.89102128487831, 0.027897645227885, 0.12114807238319);
  const Jump& back = result.report.jumps[static_cast<std::size_t>(jump->back - 1)];
  EXPECT_NEAR(value(result, back.landing, "strut.hinge"), 0, tight);
  // At the branch point the upright strut hands over to bent ones: nothing jumps.
  EXPECT_FALSE(result.report.handovers.empty());
  EXPECT_EQ(jump_at(result, 1, 1), nullptr);
}

TEST(SnapThrough, OfTheColumnGoesToBothSides) {
  const SnapResult result = run("column");
  std::vector<double> landings;
  for (const Jump& jump : result.report.jumps) {
    if (std::abs(value(result, jump.critical, "lambda") - 3) > 1e-9) continue;
    EXPECT_EQ(jump.verdict, SnapVerdict::unambiguous);
    EXPECT_NEAR(jump.released, 0.044659735099687, tight);
    landings.push_back(value(result, jump.landing, "column.hinge"));
    expect_loop(result, jump, 2.9170348529388, 0.013082310479312, 0.057742045579000);
  }
  ASSERT_EQ(landings.size(), 2u);
  EXPECT_NEAR(std::abs(landings[0]), 1.3787262298810, tight);
  EXPECT_NEAR(landings[0] + landings[1], 0, tight);
}

TEST(SnapThrough, OfTwoTrussesInSeriesDependsOnDampingAndMasses) {
  const SnapResult result = run("series");
  const Jump* jump = jump_at(result, 0.26502825343741, 1);
  ASSERT_NE(jump, nullptr);
  EXPECT_EQ(jump->verdict, SnapVerdict::depends);
  const double height = 1 + std::tan(46 * std::numbers::pi / 180);
  EXPECT_NEAR(height - value(result, jump->landing, "top.y"), 2.2297397072209 + 0.37277119270476,
              tight);
  EXPECT_NEAR(jump->released, 0.51698086561453, tight);
  ASSERT_EQ(jump->others.size(), 1u);
  EXPECT_NEAR(height - value(result, jump->others[0], "top.y"), 2.2297397072209 + 2.2956874378282,
              tight);
  EXPECT_NEAR(jump->landing.energy - jump->others[0].energy, 0.53854642672776, tight);
}

TEST(SnapThrough, KeepsTheMotionAlongWhichTheEnergyFalls) {
  const SnapResult result = run("truss");
  const Jump* jump = jump_at(result, 0.26502825343741, 1);
  ASSERT_NE(jump, nullptr);
  ASSERT_GT(jump->motion.size(), 30u);
  EXPECT_LT(jump->motion.size(), 70u);
  for (std::size_t i = 1; i < jump->motion.size(); ++i) {
    EXPECT_LE(jump->motion[i].state.energy, jump->motion[i - 1].state.energy + 1e-12);
    EXPECT_GT(jump->motion[i].time, jump->motion[i - 1].time);
    EXPECT_GT(jump->motion[i].way, jump->motion[i - 1].way);
  }
  EXPECT_NEAR(jump->motion.back().state.energy, jump->landing.energy, 1e-10);
  EXPECT_NEAR(value(result, jump->motion.back().state, "apex.y"),
              value(result, jump->landing, "apex.y"), 1e-4);
}

TEST(SnapThrough, UnderAFollowerForceIsRefusedWithTheReason) {
  const io::Case c =
      io::load_case(std::string{SPRINGFOLD_SOURCE_DIR} + "/cases/ziegler-column/case.toml");
  for (const io::PlannedRun& planned : c.runs) {
    if (planned.plan.kind != StudyKind::force_deflection) continue;
    const SnapResult result = run_with_jumps(planned.mechanism, planned.plan);
    if (result.traced.non_conservative.empty()) continue;
    EXPECT_TRUE(result.report.jumps.empty());
    EXPECT_FALSE(result.report.refusals.empty());
    return;
  }
  FAIL() << "no study with a follower force";
}

/// A truss with a mass at its apex and hardly any damping: its speed is largest near the state of least energy, where
/// it is that of a body which has got all that is released.
TEST(MotionWithMasses, IsAsFastAsTheReleasedEnergyAllows) {
  io::Case c =
      io::load_case(std::string{SPRINGFOLD_SOURCE_DIR} + "/cases/snap-through/case-truss.toml");
  io::PlannedRun& planned = c.runs.at(0);
  constexpr double mass = 3;
  planned.mechanism.bodies[0].mass = mass;
  planned.plan.snap->inertia = {.damping_ratio = 0.02, .damping = {}};
  const SnapResult result =
      run_with_jumps(planned.mechanism, planned.plan, nullptr, *planned.plan.snap);
  const Jump* jump = jump_at(result, 0.26502825343741, 1);
  ASSERT_NE(jump, nullptr);
  ASSERT_TRUE(jump->inertial);
  EXPECT_EQ(jump->inertial->end, InertialMotion::End::rest);
  EXPECT_NEAR(jump->inertial->released, jump->released, 1e-12);
  EXPECT_NEAR(jump->inertial->dissipated, jump->released, 1e-6 * jump->released);
  const double all = std::sqrt(2 * jump->released / mass);
  EXPECT_LT(jump->inertial->peak_speed, all);
  EXPECT_GT(jump->inertial->peak_speed, 0.9 * all);
  EXPECT_LT(jump->inertial->closure, 1e-12);
}

TEST(MotionWithMasses, IsRefusedWhereNothingWithAMassMoves) {
  io::Case c =
      io::load_case(std::string{SPRINGFOLD_SOURCE_DIR} + "/cases/snap-through/case-truss.toml");
  io::PlannedRun& planned = c.runs.at(0);
  planned.plan.snap->inertia = InertialSettings{};
  const SnapResult result =
      run_with_jumps(planned.mechanism, planned.plan, nullptr, *planned.plan.snap);
  ASSERT_FALSE(result.report.jumps.empty());
  ASSERT_TRUE(result.report.jumps[0].inertial);
  EXPECT_EQ(result.report.jumps[0].inertial->end, InertialMotion::End::no_mass);
  EXPECT_FALSE(result.report.jumps[0].inertial->massless.empty());
  EXPECT_FALSE(complete(run_study(planned.mechanism, planned.plan))) << "a question without answer";
}

}  // namespace
}  // namespace springfold::analysis
