// Thresholds of limit points where the displacement is driven.
#include <gtest/gtest.h>

#include <cmath>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

/// A shallow truss of two bars with a spring of stiffness kv at its apex, which is driven down.
const std::string driven_truss = R"toml(
[parameters]
kv = 0
[[node]]
name = "left"
at = [-1, 0]
fixed = true
[[node]]
name = "apex"
at = [0, 0.5]
fixed = ["x"]
[[bar]]
from = "left"
to = "apex"
stiffness = 1
[[spring]]
name = "v"
shape = "line"
of = ["apex", { on = "base", at = [-1, 0] }, { on = "base", at = [1, 0] }]
law = { law = "linear", stiffness = "kv", free = 0.5 }
[[study]]
name = "s"
kind = "threshold"
control = "mixed"
body = "apex"
direction = [0, -1]
until = { apex.y = [-0.6, 0.6] }
)toml";

TEST(DrivenThreshold, ExtremaOfTheForceAreNoLimitPointsUnlessADeadLoadIsAsked) {
  // The way is driven: lambda, which is the way, never turns back, with any spring. The force does without one.
  const std::string keys = "threshold = { of = \"limit_point\", parameter = \"kv\", range = [0, 2]";
  const auto driven = run(driven_truss + keys + " }\n").of("s");
  ASSERT_TRUE(driven.threshold && driven.threshold->found);
  EXPECT_EQ(driven.threshold->value, 0);
  EXPECT_EQ(analysis::threshold_quantities[0].value(*driven.threshold), 0);
  EXPECT_EQ(analysis::threshold_quantities[1].value(*driven.threshold), 1);
  const auto dead = run(driven_truss + keys + ", index = \"dead_load\" }\n").of("s");
  ASSERT_TRUE(dead.threshold && dead.threshold->found);
  // F' = k (1 - L0/L + L0 y^2/L^3) + kv is least at y = 0, where L = 1.
  EXPECT_NEAR(dead.threshold->value, std::sqrt(1.25) - 1, 1e-9);
}

/// A slide with force x up to 0.5, and of slope 1 - p beyond; then x - c x^3 where `bend` is c.
std::string slide(const std::string& law, const std::string& value, const std::string& study) {
  return "[parameters]\np = " + value + R"toml(
[[body]]
name = "tool"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "c"
elements = [ { joint = "prismatic", axis = "x", name = "g", role = "preloaded", initial = 0, spring = )toml" +
         law + R"toml( } ]
[[study]]
name = "s"
direction = [1, 0]
)toml" + study;
}

const std::string softens =
    "{ law = \"piecewise_linear\", breakpoints = [0.5], stiffnesses = [1, \"1 - p\"], falling = "
    "true }";

TEST(DrivenThreshold, OfTheForceAtACornerIsWhereTheForceNoLongerTurnsBack) {
  for (const char* control : {"mixed", "load"}) {
    const auto found =
        run(slide(softens, "2",
                  std::string{
                      "kind = \"threshold\"\nuntil = { tool.x = [-0.1, 0.9] }\ncontrol = \""} +
                      control +
                      "\"\nthreshold = { of = \"limit_point\", parameter = \"p\", range = [0.5, "
                      "2], value = "
                      "\"largest\", index = \"dead_load\" }\n"))
            .of("s");
    ASSERT_TRUE(found.threshold && found.threshold->found) << control;
    EXPECT_NEAR(found.threshold->value, 1, 1e-9) << control;
    EXPECT_EQ(found.threshold->decides, "corner loses its reversal") << control;
    EXPECT_TRUE(found.threshold->verified) << control;
  }
}

/// V = p x^2/2 - x^4/4: on the path up to x = 0.2 there is a limit point for 0 < p < 0.12, and for p < 0 the start is
/// unstable.
const std::string softening =
    "{ law = \"polynomial\", coefficients = [0, \"p\", 0, -1], falling = true }";

TEST(UnstableStart, HasNoThresholdOfLossOfStability) {
  const auto found =
      run(slide(softening, "0.1",
                "kind = \"threshold\"\ncontrol = \"load\"\nuntil = { tool.x = [-0.2, 0.2] }\n"
                "threshold = { of = \"loss_of_stability\", parameter = \"p\", range = [-1, 1] }\n"))
          .of("s");
  ASSERT_TRUE(found.threshold);
  EXPECT_FALSE(found.threshold->found);
  ASSERT_FALSE(found.doubts.empty());
  EXPECT_NE(found.doubts.front().find("the start is unstable itself"), std::string::npos)
      << found.doubts.front();
}

TEST(UnstableStart, OfADesignIsADoubt) {
  const auto found =
      run(slide(softening, "-0.5",
                "kind = \"design\"\ncontrol = \"load\"\nuntil = { tool.x = [-0.2, 0.2] }\n"
                "[study.design]\nparameters = { p = [-1, 2] }\nno_limit_point = {}\n"))
          .of("s");
  ASSERT_FALSE(found.doubts.empty());
  EXPECT_NE(found.doubts.front().find("unstable itself"), std::string::npos);
}

}  // namespace
}  // namespace springfold::io
