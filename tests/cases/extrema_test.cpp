// Extrema of quantities along a curve, and their curves in a second parameter.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
constexpr double right_angle = std::numbers::pi / 2;

/// A bar of length 1 on a hinge c = 2 that is relaxed at 0.3 rad from upright, pressed down: P sin t = c (t - 0.3). Its tip is
/// farthest out where the bar lies flat.
std::string bar(const std::string& study) {
  return R"toml(
[parameters]
c = 2
[[body]]
name = "tip"
task_space = "xy"
pose = ["sin(0.3)", "cos(0.3)"]
[[chain]]
name = "bar"
elements = [
  { joint = "revolute", axis = "-z", name = "hinge", role = "preloaded", initial = 0.3, spring = { law = "linear", stiffness = "c", free = 0.3 } },
  { rigid = [0, 1] },
]
[[study]]
name = "press"
control = "load"
direction = [0, -1]
until = { bar.hinge = [-1, 2.5] }
)toml" + study;
}

TEST(Extremum, OfTheReachOfABarLiesWhereItIsFlat) {
  const Ran ran = run(bar("extrema = [\"tip.x\"]\n"));
  const analysis::StudyResult& press = ran.of("press");
  int found = 0;
  for (const auto& event : press.branches.at(0).events) {
    if (event.kind != EventKind::user_value) continue;
    ++found;
    EXPECT_EQ(event.label, "UZ1");
    EXPECT_EQ(event.detail, "extremum of tip.x");
    EXPECT_NEAR(value(press, event.row, "tip.x"), 1, 1e-12);
    EXPECT_NEAR(value(press, event.row, "bar.hinge"), right_angle, 1e-10);
    EXPECT_NEAR(value(press, event.row, "lambda"), 2 * (right_angle - 0.3), 1e-10);
  }
  EXPECT_EQ(found, 1);
}

TEST(Extremum, IsFollowedInASecondParameter) {
  const Ran ran = run(bar(R"toml(
extrema = ["tip.x"]
kind = "critical_curve"
critical_curve = { of = "UZ1", parameter = "c", range = [1, 5] }
)toml"));
  const analysis::StudyResult& curve = ran.of("press");
  ASSERT_EQ(curve.branches.size(), 1u);
  const auto& samples = curve.branches[0].samples;
  EXPECT_GT(samples.size(), 5u);
  for (std::size_t row = 0; row < samples.size(); ++row)
    EXPECT_NEAR(value(curve, row, "lambda"), value(curve, row, "c") * (right_angle - 0.3), 1e-9);
  EXPECT_NEAR(value(curve, 0, "c"), 1, 1e-9);
  EXPECT_NEAR(value(curve, samples.size() - 1, "c"), 5, 1e-9);
}

TEST(Extremum, OfTheLoadIsRefusedAsItIsALimitPoint) {
  try {
    run(bar("extrema = [\"lambda\", \"nothing\", 3]\n"));
    FAIL();
  } catch (const CaseError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("need the name of a quantity"));
  }
  EXPECT_THROW(run(bar("extrema = [\"lambda\"]\n")), CaseError);
  EXPECT_THROW(run(bar("extrema = [\"nothing\"]\n")), CaseError);
}

/// It would be found nowhere, silently.
TEST(Extremum, OfAQuantityWithoutExactRateIsRefused) {
  try {
    run(bar("extrema = [\"energy\"]\n"));
    FAIL();
  } catch (const CaseError& error) {
    EXPECT_THAT(error.what(),
                testing::HasSubstr("the rate of \"energy\" along the branch is not known exactly"));
  }
}

}  // namespace
}  // namespace springfold::io
