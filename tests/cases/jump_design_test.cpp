// Designs where a requirement jumps: a pair of branch points is born, so that beyond a line in the parameters' space
// there is no critical load at all, and before it one that is too low.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "case_runs.hpp"
#include "springfold/analysis/design.hpp"

namespace springfold::io {
namespace {

/// Ziegler's column with a load of which the part eta follows. It has no static critical load for
/// eta > 1 - 4 k2/(1 + 2 k2)^2, where k1 = 1.
analysis::StudyResult following_load(const std::string& keys) {
  return run(R"toml(
[parameters]
eta = 0.2
k2 = 1
[[body]]
name = "tip"
task_space = "xy"
pose = [2, 0]
[[chain]]
name = "c"
elements = [
  { joint = "revolute", axis = "z", name = "q1", role = "preloaded", spring = { law = "linear", stiffness = 1 } },
  { rigid = [1, 0] },
  { joint = "revolute", axis = "z", name = "q2", role = "preloaded", spring = { law = "linear", stiffness = "k2" } },
  { rigid = [1, 0] },
  { point = "end" },
]
[[load]]
on = "c.end"
force = ["-(1-eta)", 0]
scale = "lambda"
[[load]]
on = "c.end"
force = ["-eta", 0]
follows = true
scale = "lambda"
[[study]]
name = "s"
kind = "design"
control = "load"
until = { lambda = [-0.1, 5], c.q1 = [-1, 1] }
[study.design]
critical_load = { at_least = 2, of = "loss_of_stability" }
)toml" + keys)
      .of("s");
}

double line_of_eta(double k2) { return 1 - 4 * k2 / std::pow(1 + 2 * k2, 2); }

/// A strut of length 1 on a hinge spring kt presses its tip with k1 d, d <= g, and with k1 g beyond, its spring then
/// being released; another spring carries the load with it. The tip stays on its straight way as long as the thrust
/// times the length is less than kt: there is no buckling for kt > k1 g (1 - g), where two branch points meet at the
/// release.
const std::string one_release =
    R"(spring = { law = "piecewise_linear", breakpoints = ["1-g"], stiffnesses = [0, "k1"], free = 1 })";

analysis::StudyResult released_strut(const std::string& keys,
                                     const std::string& spring = one_release) {
  return run(R"toml(
[parameters]
kt = 0.1
k1 = 1
g = 0.2
[[body]]
name = "tip"
task_space = "xy"
pose = [1, 0]
[[chain]]
name = "strut"
elements = [
  { joint = "revolute", axis = "z", name = "hinge", role = "preloaded", spring = { law = "linear", stiffness = "kt" } },
  { joint = "prismatic", axis = "x", name = "length", role = "virtual", initial = 1, )toml" +
             spring + R"toml( },
]
[[chain]]
name = "carrier"
elements = [
  { joint = "prismatic", axis = "y", name = "guide" },
  { joint = "prismatic", axis = "x", name = "spring", role = "virtual", initial = 1, spring = { law = "linear", stiffness = 1, free = 1 } },
]
[[study]]
name = "s"
kind = "design"
control = "load"
direction = [-1, 0]
until = { lambda = [-0.1, 2], tip.x = [0.4, 2] }
[study.design]
critical_load = { at_least = 1, of = "loss_of_stability" }
)toml" + keys)
      .of("s");
}

double jump_value(const analysis::StudyResult& result, const std::string& name) {
  return design_value(*result.design, "design." + name).value_or(NAN);
}

bool says(const analysis::StudyResult& result, const std::string& words) {
  return result.design->message.find(words) != std::string::npos;
}

void expect_least(const analysis::StudyResult& result) {
  EXPECT_EQ(result.design->status, analysis::DesignStatus::met) << result.design->message;
  EXPECT_TRUE(result.design->verified);
  EXPECT_LT(result.design->optimality, 1e-5);
  EXPECT_TRUE(says(result, "where a requirement jumps")) << result.design->message;
  EXPECT_FALSE(says(result, "not shown")) << result.design->message;
}

TEST(JumpDesign, IsMovedAlongTheLineWhereBranchPointsAreBornToTheLeastChange) {
  const auto result = following_load("parameters = { k2 = [0.5, 2], eta = [0.1, 0.9] }\n");
  expect_least(result);
  EXPECT_NEAR(jump_value(result, "change"), 1.5707045948524076, 1e-9);
  EXPECT_NEAR(jump_value(result, "k2"), 0.569732941, 1e-5);
  EXPECT_NEAR(jump_value(result, "eta"), line_of_eta(jump_value(result, "k2")), 1e-12);
  EXPECT_EQ(result.design->limits, std::vector<std::string>{"critical_load"});
}

TEST(JumpDesign, MoreStartsLeadToNoWorseAnswer) {
  const std::string keys = "parameters = { k2 = [0.5, 1.5], eta = [0.1, 0.9] }\nstarts = ";
  double least = HUGE_VAL;
  for (const std::string starts : {"1", "4"}) {
    const auto result = following_load(keys + starts + "\n");
    EXPECT_LE(jump_value(result, "change"), least);
    least = jump_value(result, "change");
  }
  EXPECT_NEAR(least, 1.5707045948524076, 1e-9);
}

TEST(JumpDesign, EndsAtABoundThatCutsTheLine) {
  const auto result =
      following_load("parameters = { k2 = [0.8, 2], eta = [0.1, 0.9] }\nstarts = 2\n");
  expect_least(result);
  EXPECT_NEAR(jump_value(result, "k2"), 0.8, 1e-12);
  EXPECT_NEAR(jump_value(result, "eta"), line_of_eta(0.8), 1e-12);
  EXPECT_EQ(jump_value(result, "limits.k2"), -1);
  EXPECT_EQ(jump_value(result, "limits.critical_load"), 1);
}

TEST(JumpDesign, WithTheSumOfChangesLeavesTheOtherParameterAsItIs) {
  const auto result = following_load(
      "parameters = { k2 = [0.5, 2], eta = [0.1, 0.9] }\nchanges = \"sum\"\nstarts = 2\n");
  expect_least(result);
  EXPECT_NEAR(jump_value(result, "k2"), 1, 1e-9);
  EXPECT_NEAR(jump_value(result, "change"), (line_of_eta(1) - 0.2) / 0.2, 1e-9);
}

TEST(JumpDesign, OfOneParameterIsWhereTheRequirementBegins) {
  const auto result = following_load("parameters = { eta = [0.1, 0.9] }\nstarts = 2\n");
  expect_least(result);
  EXPECT_NEAR(jump_value(result, "eta"), 5 / 9.0, 1e-12);
}

TEST(JumpDesign, FindsTheLeastChangeWhereAReleaseEndsBuckling) {
  // The least (u, w) with 0.1 (1 + u) = g (1 - g), g = 0.2 (1 + w): u = 0.6 + 1.2 w - 0.4 w^2, u u' + w = 0.
  const auto result =
      released_strut("parameters = { kt = [0.05, 0.3], g = [0.05, 0.4] }\nstarts = 2\n");
  double w = -0.3;
  const auto u = [](double x) { return 0.6 + 1.2 * x - 0.4 * x * x; };
  for (int i = 0; i < 20; ++i) {
    const double slope = 1.2 - 0.8 * w;
    w -= (u(w) * slope + w) / (slope * slope - 0.8 * u(w) + 1);
  }
  expect_least(result);
  EXPECT_NEAR(jump_value(result, "change"), std::hypot(u(w), w), 1e-7);
  EXPECT_NEAR(jump_value(result, "g"), 0.2 * (1 + w), 1e-5);
}

TEST(JumpDesign, IsFoundWhereOneBoundAloneMeetsWhatNoStartDoes) {
  // 0.1 = g (1 - g), a hundredth of the range from its lower bound.
  for (const std::string starts : {"1", "8"}) {
    const auto result =
        released_strut("parameters = { g = [0.11, 0.4] }\nstarts = " + starts + "\n");
    expect_least(result);
    EXPECT_NEAR(jump_value(result, "g"), (1 - std::sqrt(0.6)) / 2, 1e-7);
  }
}

TEST(JumpDesign, KeepsAnotherRequirementOnItsLimit) {
  // The stiffness at the start, k1 + 1, wants k1 = 1.2: u = 0.92 + 1.44 w - 0.48 w^2.
  const auto result = released_strut(
      "parameters = { kt = [0.05, 0.4], g = [0.05, 0.4], k1 = [0.5, 2] }\nstarts = 1\n"
      "stiffness = [{ at_least = 2.2 }]\n");
  double w = -0.3;
  const auto u = [](double x) { return 0.92 + 1.44 * x - 0.48 * x * x; };
  for (int i = 0; i < 20; ++i) {
    const double slope = 1.44 - 0.96 * w;
    w -= (u(w) * slope + w) / (slope * slope - 0.96 * u(w) + 1);
  }
  expect_least(result);
  EXPECT_NEAR(jump_value(result, "k1"), 1.2, 1e-8);
  EXPECT_NEAR(jump_value(result, "change"), std::hypot(u(w), w, 0.2), 1e-7);
}

TEST(JumpDesign, WhereTwoJumpsMeetIsNotToldAsTheLeastChange) {
  // A second rise of the thrust, to 0.26 at d = 0.5, wants kt > 0.13 beside kt > g (1 - g).
  const auto result = released_strut(
      "parameters = { kt = [0.05, 0.3], g = [0.05, 0.35] }\nstarts = 2\n",
      R"(spring = { law = "piecewise_linear", breakpoints = [0.5, 0.6, "1-g"], stiffnesses = [0, "(0.26-g)/0.1", 0, 1], free = 1 })");
  EXPECT_EQ(result.design->status, analysis::DesignStatus::met) << result.design->message;
  EXPECT_TRUE(result.design->verified);
  EXPECT_TRUE(says(result, "where a requirement jumps; not shown to be the least change"))
      << result.design->message;
  const double g = 0.5 - std::sqrt(0.25 - 0.13);
  EXPECT_NEAR(jump_value(result, "change"), std::hypot(0.3, g / 0.2 - 1), 1e-4);
}

}  // namespace
}  // namespace springfold::io
