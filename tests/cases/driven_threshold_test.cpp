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
  const auto dead = run(driven_truss + keys + ", index = \"dead_load\" }\n").of("s");
  ASSERT_TRUE(dead.threshold && dead.threshold->found);
  // F' = k (1 - L0/L + L0 y^2/L^3) + kv is least at y = 0, where L = 1.
  EXPECT_NEAR(dead.threshold->value, std::sqrt(1.25) - 1, 1e-9);
}

}  // namespace
}  // namespace springfold::io
