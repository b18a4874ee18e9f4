// Starts of a family whose numbers lie on a line in the parameter.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

TEST(StartsOnALine, AreThoseThatBalanceEveryMember) {
  // The planar Orthoglide, its drives commanded so that it rests at (p, p): with sin(a) = p the knees' torque Kv a is
  // balanced by the drives' springs at rho = p + cos(a) + Kv a / (cos(a) - sin(a)). Most starts of the curve are not
  // looked for.
  const auto curve = run(R"(
[parameters]
Kv = 0
[[body]]
name = "tool"
task_space = "xy"
[[chain]]
name = "leg_x"
elements = [
  { joint = "prismatic", axis = "x", name = "drive", role = "actuated", value = 1, stiffness = 1 },
  { joint = "revolute", axis = "-z", name = "knee", role = "preloaded", spring = { law = "linear", stiffness = "Kv" } },
  { rigid = [-1, 0] },
]
[[chain]]
name = "leg_y"
elements = [
  { joint = "prismatic", axis = "y", name = "drive", role = "actuated", value = 1, stiffness = 1 },
  { joint = "revolute", axis = "z", name = "knee", role = "preloaded", spring = { law = "linear", stiffness = "Kv" } },
  { rigid = [0, -1] },
]
[[study]]
name = "folds"
kind = "critical_curve"
control = "load"
direction = [1, 1]
start = { pose = [0.454, 0.454], solve = "actuators" }
until = { deflection = [-0.05, 0.6] }
critical_curve = { of = "LP1", parameter = "Kv", range = [0, 0.06] }
)")
                         .of("folds");
  const double p = 0.454, a = std::asin(p);
  const auto& rows = curve.branches.at(0).samples;
  ASSERT_GT(rows.size(), 20u);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const double Kv = value(curve, row, "Kv");
    const double rho = p + std::cos(a) + Kv * a / (std::cos(a) - std::sin(a));
    EXPECT_NEAR(value(curve, row, "leg_x.drive.rho"), rho, 1e-14) << "row " << row;
    const double moved = value(curve, row, "tool.x") + value(curve, row, "tool.y") - 2 * p;
    EXPECT_NEAR(value(curve, row, "deflection"), moved / std::numbers::sqrt2, 1e-14)
        << "row " << row;
  }
}

}  // namespace
}  // namespace springfold::io
