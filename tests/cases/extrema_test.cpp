// Extrema of quantities along a curve, and their curves in a second parameter.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
constexpr double right_angle = std::numbers::pi / 2;

/// A bar of length 1 on a hinge c = 2 that is relaxed at 0.3 rad from upright, pressed down: P sin t = c (t - 0.3). Its
/// tip is farthest out where the bar lies flat.
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

const std::string one_bar = R"toml([[node]]
name = "a"
at = [0, 0.8]
fixed = ["x"]
[[node]]
name = "l"
at = [-1, 0]
fixed = true
[[bar]]
from = "l"
to = "a"
stiffness = 1
)toml";

/// Heights of a truss's apex at the extrema of a column: half span 1, height 0.8, pressed down to -1.2.
std::vector<double> heights_at_extrema(const std::string& column, const std::string& more) {
  const Ran ran = run(one_bar + more + R"toml(
[[study]]
name = "press"
body = "a"
control = "load"
direction = [0, -1]
until = { a.y = [-1.2, 1.0] }
extrema = [")toml" + column +
                      "\"]\n");
  std::vector<double> heights;
  const analysis::StudyResult& press = ran.of("press");
  for (const auto& event : press.branches.at(0).events)
    if (event.kind == EventKind::user_value) heights.push_back(value(press, event.row, "a.y"));
  std::sort(heights.begin(), heights.end());
  return heights;
}

/// The bar is relaxed at the start and at the mirror height, and shortest between them.
TEST(Extremum, OfTheEnergyLiesWhereNoForceActs) {
  const std::vector<double> heights = heights_at_extrema("energy", "");
  ASSERT_EQ(heights.size(), 3u);
  EXPECT_NEAR(heights[0], -0.8, 1e-10);
  EXPECT_NEAR(heights[1], 0, 1e-10);
  EXPECT_NEAR(heights[2], 0.8, 1e-10);
}

TEST(Extremum, OfASpringsLengthAndForceLiesWhereItPassesItsAnchor) {
  const std::string spring = R"toml(
[[spring]]
name = "s"
from_at = [1, 0.25]
to = "a"
stiffness = 0.01
free = 0.5
)toml";
  for (const std::string column : {"s.length", "s.force"}) {
    const std::vector<double> heights = heights_at_extrema(column, spring);
    ASSERT_EQ(heights.size(), 1u) << column;
    EXPECT_NEAR(heights[0], 0.25, 1e-10) << column;
  }
}

/// Over the height c of the anchor: the load there is 2 c (L0/L - 1) of one bar's share, and the spring pulls across.
TEST(Extremum, OfALengthIsFollowedInASecondParameter) {
  const Ran ran = run("[parameters]\nc = 0.25\n" + one_bar + R"toml([[spring]]
name = "s"
from_at = [1, "c"]
to = "a"
stiffness = 0.01
free = 0.5
[[study]]
name = "press"
kind = "critical_curve"
body = "a"
control = "load"
direction = [0, -1]
until = { a.y = [-1.2, 1.0] }
extrema = ["s.length"]
critical_curve = { of = "UZ1", parameter = "c", range = [-0.3, 0.6] }
)toml");
  const analysis::StudyResult& curve = ran.of("press");
  ASSERT_EQ(curve.branches.size(), 1u);
  const auto& samples = curve.branches[0].samples;
  for (std::size_t row = 0; row < samples.size(); ++row) {
    const double c = value(curve, row, "c"), rest = std::hypot(1, 0.8);
    EXPECT_NEAR(value(curve, row, "lambda"), c * (rest / std::hypot(1, c) - 1), 1e-9);
  }
  EXPECT_NEAR(value(curve, 0, "c"), -0.3, 1e-9);
  EXPECT_NEAR(value(curve, samples.size() - 1, "c"), 0.6, 1e-9);
}

/// The spring's force has its least value, zero, at the edge where it lets go: no smooth extremum, and none beside it.
TEST(Extremum, IsNotSeenWhereASpringBeginsToAct) {
  const std::string spring = R"toml(
[[spring]]
name = "s"
from_at = [0, 3]
to = "a"
law = { law = "one_sided", stiffness = 0.01, from = 2.7, side = "above" }
)toml";
  EXPECT_TRUE(heights_at_extrema("s.force", spring).empty());
  EXPECT_TRUE(heights_at_extrema("s.length", spring).empty());
}

}  // namespace
}  // namespace springfold::io
