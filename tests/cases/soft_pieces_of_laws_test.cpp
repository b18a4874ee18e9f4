// A piece of a spring's law that is softer than all others by many orders, far from where the mechanism stands, changes
// nothing there.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;

/// Two bars in a row, both without force as drawn but for the rounding of lengths.
TEST(SoftPiecesOfLaws, KeepAStartThatIsExactAsDrawn) {
  for (const std::string slope : {"-1e-10", "-1e-5", "1e-8"}) {
    SCOPED_TRACE(slope);
    const auto result = run(R"toml(
[[node]]
name = "n0"
at = [0, 0]
fixed = true
[[node]]
name = "n1"
at = [20.1, 0]
fixed = ["y"]
[[node]]
name = "n2"
at = [40.3, 0]
fixed = ["y"]
[[bar]]
name = "b1"
from = "n0"
to = "n1"
free = 20
law = { law = "linear", stiffness = 3, free = 0.1 }
[[bar]]
name = "b2"
from = "n1"
to = "n2"
free = 20
law = { law = "piecewise_linear", breakpoints = [-2, -1], stiffnesses = [3, )toml" +
                            slope + R"toml(, 2], free = 0.2, falling = true }
[[study]]
name = "stands"
kind = "equilibrium"
body = "n2"
)toml")
                            .of("stands");
    EXPECT_EQ(result.start.attempts, 1);
    EXPECT_NEAR(value(result, 0, "n2.x"), 40.3, 1e-13);
  }
}

/// An upright bar of length 1 on a spring of 0.5 under its buckling load of 0.5, to which lambda is added. Bent by h it
/// stands under 0.5 h / sin h; beyond the threshold on one side the spring is nearly gone.
TEST(SoftPiecesOfLaws, LeaveTheBranchesOfAStartThatIsABranchPoint) {
  for (const std::string slope : {"1e-6", "1e-4", "0.01"}) {
    SCOPED_TRACE(slope);
    const auto result = run(R"toml(
[[body]]
name = "tip"
task_space = "xy"
pose = [0, 1]
[[chain]]
name = "bar"
elements = [
  { joint = "revolute", axis = "z", name = "h", role = "preloaded", spring = { law = "piecewise_linear", breakpoints = [-0.6885], stiffnesses = [)toml" +
                            slope + R"toml(, 0.5] } },
  { rigid = [0, 1] },
]
[[study]]
name = "press"
control = "load"
direction = [0, -1]
load = [0, -0.5]
until = { lambda = [-0.4, 4.5], bar.h = [-2.5, 2.5] }
branches = { depth = 1 }
)toml")
                            .of("press");
    EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
    ASSERT_EQ(result.branches.size(), 3u);
    for (const auto& branch : result.branches)
      for (const auto& row : branch.samples) {
        const double h = row.values[column(result, "bar.h")];
        if (std::abs(h) < 1e-9 || h < -0.6885) continue;  // upright, or beyond the threshold
        EXPECT_NEAR(row.values[column(result, "lambda")], 0.5 * h / std::sin(h) - 0.5, 1e-9);
      }
  }
}

}  // namespace
}  // namespace springfold::io
