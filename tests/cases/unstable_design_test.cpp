// Designs whose path begins unstable, or is least steep at one of its ends. A mass on a slide with a spring kv along
// it, between two springs of stiffness 1 and free length l0 across it, fixed at a distance of 1:
// F(x) = kv x + 2 x (1 - l0/sqrt(1 + x^2)), so that F'(0) = kv - 2 (l0 - 1) is the least stiffness.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

analysis::StudyResult slide_design(const std::string& keys) {
  return run(R"toml(
[parameters]
kv = 0.5
l0 = 1.5
[[body]]
name = "mass"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "straight"
elements = [
  { joint = "prismatic", axis = "x", name = "spring", role = "virtual", stiffness = "kv" },
  { joint = "prismatic", axis = "y", name = "guide" },
]
[[chain]]
name = "upper"
from_at = [0, 1]
elements = [
  { joint = "revolute", axis = "z", name = "eye", initial = "-90*deg" },
  { joint = "prismatic", axis = "x", name = "length", role = "virtual", initial = 1, spring = { law = "linear", stiffness = 1, free = "l0" } },
]
[[chain]]
name = "lower"
from_at = [0, -1]
elements = [
  { joint = "revolute", axis = "z", name = "eye", initial = "90*deg" },
  { joint = "prismatic", axis = "x", name = "length", role = "virtual", initial = 1, spring = { law = "linear", stiffness = 1, free = "l0" } },
]
[[study]]
name = "s"
kind = "design"
control = "load"
direction = [1, 0]
until = { mass.x = [-1.5, 1.5] }
)toml"
             "design = { " +
             keys + " }\n")
      .of("s");
}

double slide_value(const analysis::StudyResult& result, const std::string& name) {
  return design_value(*result.design, "design." + name).value_or(NAN);
}

bool doubts_start(const analysis::StudyResult& result) {
  return std::any_of(result.doubts.begin(), result.doubts.end(), [](const std::string& doubt) {
    return doubt.find("the start of this design is unstable") != std::string::npos;
  });
}

TEST(UnstableDesign, LimitPointsThatMergeAtTheStartItselfDoSoAtTheClosedForm) {
  const auto result = slide_design("parameters = { kv = [0.1, 3] }, no_limit_point = {}");
  EXPECT_NEAR(slide_value(result, "kv"), 1, 1e-9);
  EXPECT_TRUE(result.design->verified);
  EXPECT_EQ(result.design->limits, std::vector<std::string>{"no_limit_point"});
  EXPECT_FALSE(doubts_start(result));  // beside the limit it is stable
}

TEST(UnstableDesign, TheLeastChangeOfTwoParametersMakesTheStartStable) {
  // With changes u and v of kv/0.5 and l0/1.5: 0.5 (1 + u) = 2 (0.5 + 1.5 v), the nearest one is along (0.5, -3).
  const auto result =
      slide_design("parameters = { kv = [0.1, 3], l0 = [1, 3] }, no_limit_point = {}");
  const double way = 0.5 / (0.25 + 9);
  EXPECT_NEAR(slide_value(result, "kv"), 0.5 * (1 + 0.5 * way), 1e-9);
  EXPECT_NEAR(slide_value(result, "l0"), 1.5 * (1 - 3 * way), 1e-9);
  EXPECT_TRUE(result.design->verified);
}

TEST(UnstableDesign, TheNearestMissLiesAtTheBoundsThatLimitIt) {
  // kv = 2 (l0 - 1) is wanted: the stiffest spring and the shortest free lengths come nearest.
  const auto result =
      slide_design("parameters = { kv = [0.1, 0.6], l0 = [1.4, 3] }, no_limit_point = {}");
  EXPECT_EQ(result.design->status, analysis::DesignStatus::cannot_be_met);
  EXPECT_NEAR(slide_value(result, "kv"), 0.6, 1e-9);
  EXPECT_NEAR(slide_value(result, "l0"), 1.4, 1e-9);
  EXPECT_EQ(slide_value(result, "limits.kv"), 1);
  EXPECT_EQ(slide_value(result, "limits.l0"), -1);
}

TEST(UnstableDesign, ALimitPointThatLeavesThePathDoesSoAtItsLimit) {
  // F = kv x - b x^3/3 turns back at x^2 = kv/b, behind 1.2 where kv = 1.44 b.
  const std::string slide = R"toml(
[parameters]
kv = 1
b = 1
far = "1.2*b"
[[body]]
name = "mass"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "straight"
elements = [
  { joint = "prismatic", axis = "x", name = "spring", role = "virtual", spring = { law = "polynomial", coefficients = [0, "kv", 0, "-b/3"], falling = true } },
  { joint = "prismatic", axis = "y", name = "guide" },
]
[[chain]]
name = "side"
elements = [
  { joint = "prismatic", axis = "x", name = "guide" },
  { joint = "prismatic", axis = "y", name = "spring", role = "virtual", stiffness = 1 },
]
[[study]]
name = "s"
kind = "design"
control = "load"
direction = [1, 0]
)toml";
  const auto one = run(slide +
                       "until = { mass.x = [-1.2, 1.2] }\ndesign = { parameters = { kv = "
                       "[0.1, 3] }, no_limit_point = {}, starts = 1 }\n")
                       .of("s");
  EXPECT_NEAR(slide_value(one, "kv"), 1.44, 1e-8);
  EXPECT_TRUE(one.design->verified);
  // A limit that follows: kv = b (1.2 b)^2.
  const auto other = run(slide +
                         "until = { mass.x = [-1.2, \"far\"] }\ndesign = { parameters = { "
                         "b = [0.5, 2] }, no_limit_point = {}, starts = 1 }\n")
                         .of("s");
  EXPECT_NEAR(slide_value(other, "b"), std::cbrt(1 / 1.44), 1e-8);
}

TEST(UnstableDesign, PointsOfACurveThatBeginsUnstableAreMetWithADoubt) {
  // Up to the limit point, and from there past zero.
  const double x = -1.2, load = 0.6 * x + 2 * x * (1 - 1.5 / std::hypot(1, x));
  const auto result = slide_design(
      "parameters = { kv = [0.1, 3] }, curve = { x = \"mass.x\", y = "
      "\"lambda\", points = [[-1.2, " +
      std::to_string(load) + "]], tolerance = 1e-6 }");
  EXPECT_NEAR(slide_value(result, "kv"), 0.6, 2e-6);
  EXPECT_TRUE(doubts_start(result));
}

TEST(UnstableDesign, AStartThatIsUnstableHasNotTheCriticalLoadThatIsWanted) {
  // A strut that bears P0 = 1.1 before: its critical load is k - P0, and it stands for k > P0 only.
  const auto result = run(R"toml(
[parameters]
k = 1
P0 = 1.1
[[body]]
name = "tip"
task_space = "xy"
pose = [0, 1]
[[chain]]
name = "s"
elements = [
  { joint = "revolute", axis = "z", name = "q", role = "preloaded", spring = { law = "linear", stiffness = "k" } },
  { rigid = [0, 1] },
]
[[study]]
name = "s"
kind = "design"
control = "load"
direction = [0, -1]
load = [0, "-P0"]
until = { lambda = [-0.9, 3], s.q = [-1.5, 1.5] }
design = { parameters = { k = [0.1, 3] }, critical_load = { at_least = 1.2, of = "loss_of_stability" } }
)toml")
                          .of("s");
  ASSERT_TRUE(result.design);
  EXPECT_EQ(result.design->status, analysis::DesignStatus::met) << result.design->message;
  EXPECT_NEAR(result.design->parameters.front().after, 2.3, 1e-9);
  EXPECT_TRUE(result.design->verified);
}

}  // namespace
}  // namespace springfold::io
