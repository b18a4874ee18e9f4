// Special points are followed through values of a parameter at which the study's start meets its own limit point and
// vanishes.
#include <gmock/gmock.h>

#include <cmath>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

/// x^3 - 3 x = b + lambda: a limit point at x = -1 with lambda = 2 - b; at b = 2 it passes the start, lambda = 0.
std::string cubic(const std::string& study) {
  return "[parameters]\nb = -1\n[[node]]\nname = \"m\"\nat = [-2, 0]\nfixed = [\"y\"]\n[[chain]]\n"
         "name = \"c\"\nto = \"m\"\nelements = [ { joint = \"prismatic\", axis = \"x\", name = "
         "\"q\", role = \"preloaded\", initial = -2, spring = { law = \"polynomial\", coefficients "
         "= [0, -3, 0, 1], falling = true } } ]\n[[study]]\nname = \"s\"\nbody = \"m\"\ncontrol = "
         "\"load\"\ndirection = [1, 0]\nload = [\"b\", 0]\nstart = { pose = [-2, 0] }\n"
         "until = { m.x = [-3, 3], lambda = [-6, 6] }\n" +
         study;
}

TEST(CriticalCurve, GoesOnWhereTheStartOfThePathVanishes) {
  const auto ran = run(cubic(
      "kind = \"critical_curve\"\ncritical_curve = { of = \"LP1\", parameter = \"b\", range = [-3, "
      "3] }\n"));
  const analysis::StudyResult& result = ran.of("s");
  EXPECT_TRUE(complete(result));
  const auto& samples = result.branches.at(0).samples;
  ASSERT_GE(samples.size(), 3u);
  EXPECT_LT(samples.size(), 100u);
  double low = 0, high = 0;
  for (const auto& sample : samples) {
    const double b = sample.values[column(result, "b")];
    EXPECT_NEAR(sample.values[column(result, "lambda")], 2 - b, 1e-11);
    EXPECT_NEAR(sample.values[column(result, "m.x")], -1, 1e-9);
    low = std::min(low, b);
    high = std::max(high, b);
  }
  EXPECT_NEAR(low, -3, 1e-12);
  EXPECT_NEAR(high, 3, 1e-12);
}

/// A drive with a spring of 1 between command and carriage holds the cubic at x = -2: x^3 - 2 x - rho = b + lambda, rho
/// = -3.
TEST(CriticalCurve, GoesOnWhereTheStartVanishesUnderCommandsThatAreKept) {
  const std::string y = "{ joint = \"prismatic\", axis = \"y\", name = ",
                    drive = "role = \"actuated\", value = 0, stiffness = 1 }";
  const auto ran = run(
      "[parameters]\nb = -1\n[[node]]\nname = \"m\"\nat = [-2, 0]\n[[chain]]\nname = \"c\"\nto = "
      "\"m\"\nelements = [ { joint = \"prismatic\", axis = \"x\", name = \"q\", role = "
      "\"preloaded\", initial = -2, spring = { law = \"polynomial\", coefficients = [0, -3, 0, 1], "
      "falling = true } }, " +
      y +
      "\"u\" } ]\n[[chain]]\nname = \"d\"\nto = \"m\"\nelements = [ { joint = \"prismatic\", "
      "axis = \"x\", name = \"a\", " +
      drive + ", " + y +
      "\"v\" } ]\n[[chain]]\nname = \"e\"\nto = "
      "\"m\"\nelements = [ " +
      y + "\"w\", " + drive +
      ", { joint = \"prismatic\", axis = \"x\", "
      "name = \"z\" } ]\n[[study]]\nname = \"s\"\nbody = \"m\"\ncontrol = \"load\"\ndirection = "
      "[1, 0]\nload = [\"b\", 0]\nstart = { pose = [-2, 0], solve = \"actuators\" }\nuntil = { m.x "
      "= "
      "[-3, 3], lambda = [-9, 9] }\nkind = \"critical_curve\"\ncritical_curve = { of = \"LP1\", "
      "parameter = \"b\", range = [-3, 6], tied = false }\n");
  const analysis::StudyResult& result = ran.of("s");
  EXPECT_TRUE(complete(result));
  const auto& samples = result.branches.at(0).samples;
  ASSERT_GE(samples.size(), 3u);
  EXPECT_LT(samples.size(), 100u);
  const double x = -std::sqrt(2.0 / 3);
  double high = 0;
  for (const auto& sample : samples) {
    const double b = sample.values[column(result, "b")];
    EXPECT_NEAR(sample.values[column(result, "lambda")], x * x * x - 2 * x + 3 - b, 1e-10);
    EXPECT_NEAR(sample.values[column(result, "m.x")], x, 1e-9);
    high = std::max(high, b);
  }
  EXPECT_NEAR(high, 6, 1e-12);
}

/// F = W + lambda = a x - x^2 has its limit point at a^2 / 4 - W. At W = 0.4 the case has no start: the curve goes on
/// there, and that in another parameter begins at its row.
TEST(VanishingStarts, LetFurtherCurvesBeginAtRowsOfValuesThatHaveNoStart) {
  const auto ran = run(R"toml(
[parameters]
W = 0.05
a = 1
[[body]]
name = "b"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "g"
elements = [ { joint = "prismatic", axis = "x", role = "preloaded", initial = 0, spring = { law = "polynomial", coefficients = [0, "a", -1], free = 0, falling = true } },
  { joint = "prismatic", axis = "y", role = "preloaded", initial = 0, spring = { law = "linear", stiffness = 1, free = 0 } } ]
[[study]]
name = "c1"
kind = "critical_curve"
control = "load"
direction = [1, 0]
load = ["W", 0]
until = { b.x = [-3, 3], lambda = [-3, 3] }
mark = { W = [0.4] }
critical_curve = { of = "LP1", parameter = "W", range = [0, 0.5] }
[[study]]
name = "c2"
kind = "critical_curve"
until = { b.x = [-3, 3], lambda = [-3, 3] }
critical_curve = { of = "c1/UZ1", parameter = "a", range = [0.5, 2] }
)toml");
  const auto& result = ran.of("c2");
  EXPECT_TRUE(complete(result));
  const auto& samples = result.branches.at(0).samples;
  for (const auto& sample : samples) {
    const double a = sample.values[column(result, "a")];
    EXPECT_NEAR(sample.values[column(result, "lambda")], a * a / 4 - 0.4, 1e-10) << a;
  }
  EXPECT_NEAR(samples.front().values[column(result, "a")], 0.5, 1e-12);
  EXPECT_NEAR(samples.back().values[column(result, "a")], 2, 1e-12);
}

/// A slider with 0.5 x - x^3 on an elastic drive of stiffness 1 under a dead load W: driven by q, x has its limit point
/// at x = sqrt(1/2), q = sqrt(1/2) - W. It comes to the start, q = 0, at W = sqrt(1/2).
TEST(VanishingStarts, OfADrivenSliderEndItsFirstCriticalLoadsThere) {
  const auto ran = run(R"toml(
[parameters]
W = 0.2
[[body]]
name = "tool"
task_space = "xy"
[[chain]]
name = "s"
elements = [ { joint = "prismatic", axis = "x", name = "drive", role = "actuated", value = 0, stiffness = 1 } ]
[[spring]]
name = "f"
shape = "line"
of = ["tool", { on = "base", at = [0, 1] }, { on = "base", at = [0, 0] }]
law = { law = "polynomial", coefficients = [0, 0.5, 0, -1], falling = true }
[[study]]
name = "first"
kind = "critical_load"
control = "actuator"
actuators = { s.drive = 1 }
load = ["W", 0]
until = { tool.x = [-1.5, 1.5], lambda = [-2, 2] }
critical_load = { of = "limit_point", parameter = "W", range = [0, 0.7], values = 8 }
[[study]]
name = "threshold"
kind = "threshold"
control = "actuator"
actuators = { s.drive = 1 }
load = ["W", 0]
until = { tool.x = [-1.5, 1.5], lambda = [-2, 2] }
threshold = { of = "limit_point", parameter = "W", range = [0, 1] }
)toml");
  const auto& first = ran.of("first");
  EXPECT_TRUE(complete(first)) << testing::PrintToString(first.doubts);
  for (const auto& sample : first.branches.at(0).samples)
    EXPECT_NEAR(sample.values[column(first, "lambda")], std::sqrt(0.5) - sample.values.back(),
                1e-9);
  const auto& threshold = ran.of("threshold");
  ASSERT_TRUE(threshold.threshold && threshold.threshold->found);
  EXPECT_NEAR(threshold.threshold->value, std::sqrt(0.5), 1e-9);
}

}  // namespace
}  // namespace springfold::io
