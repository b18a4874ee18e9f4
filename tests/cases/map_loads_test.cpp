// Critical loads at the nodes of maps, and stability along paths of commands.
#include <gmock/gmock.h>

#include <cmath>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

/// A slider at y = 1 on a spring that pushes back by 1.9 (1 - y) down to y = b and less below: the force has its
/// maximum in that corner, and nothing holds the slider at a larger one.
TEST(MapLoads, AreThoseOfCornersAtWhichAForceIsLargest) {
  const auto result = run(R"toml(
[parameters]
b = 0.42
[[body]]
name = "t"
task_space = "xy"
pose = [0, 1]
[[chain]]
name = "c"
elements = [ { joint = "prismatic", axis = "y", name = "y", initial = 1, role = "preloaded", spring = { law = "piecewise_linear", breakpoints = [-0.31, "b"], stiffnesses = [2.3, -0.7, 1.9], free = 1, falling = true } } ]
[[study]]
name = "map"
kind = "map"
axes = [{ parameter = "b", from = 0.2, to = 0.6, points = 5 }]
command = "given"
critical = { direction = [0, -1], up_to = 10 }
)toml")
                          .of("map");
  EXPECT_TRUE(analysis::complete(result));
  for (std::size_t row = 0; row < 5; ++row)
    EXPECT_NEAR(value(result, row, "critical_load"), 1.9 * (1 - value(result, row, "b")), 1e-9);
}

/// A drive of stiffness 0.5 and a spring along it whose force falls by 0.7 between two thresholds: without the drive
/// moving, the point is unstable there, 0.5 - 0.7 < 0.
TEST(ControlPath, LosesAndRegainsStabilityWhereASpringSwitchesInOneEventEach) {
  const auto result = run(R"toml(
[[body]]
name = "t"
task_space = "xy"
pose = [0.9, 0]
[[chain]]
name = "c"
elements = [ { joint = "prismatic", axis = "x", name = "d", role = "actuated", value = 0.9, stiffness = 0.5 }, { rigid = [0, 0] } ]
[[spring]]
name = "g"
from_at = [-5, 0]
to = "t"
law = { law = "piecewise_linear", breakpoints = [4.69, 5.42], stiffnesses = [2.3, -0.7, 1.9], free = 6.0, falling = true }
[[study]]
name = "p"
kind = "control"
prescribe = ["x"]
line = { from = [0.9], to = [-0.7], points = 17 }
)toml")
                          .of("p");
  const auto& events = result.branches.at(0).events;
  ASSERT_EQ(events.size(), 2u);
  for (const auto& event : events) EXPECT_EQ(event.kind, analysis::EventKind::switching);
  EXPECT_THAT(events[0].detail, testing::HasSubstr("stability is lost"));
  EXPECT_THAT(events[1].detail, testing::HasSubstr("stability improves"));
  for (std::size_t row = 0; row < result.branches[0].samples.size(); ++row) {
    const double x = value(result, row, "t.x");
    if (std::abs(x - 0.42) <= 1e-9 || std::abs(x + 0.31) <= 1e-9) continue;
    EXPECT_EQ(value(result, row, "index_force"), x > -0.31 && x < 0.42 ? 1 : 0) << x;
  }
}

}  // namespace
}  // namespace springfold::io
