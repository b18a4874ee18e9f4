// Special points at which several springs switch at once, followed in a parameter that keeps them together, or parts
// them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;

/// A slide on a spring of stiffness 1 towards two stops at x = g and x = g + e.
std::string two_stops(const std::string& study) {
  return R"toml(
[parameters]
g = 0.5
h = "g"
e = 0
[[body]]
name = "tip"
task_space = "xy"
[[chain]]
name = "rail"
elements = [ { joint = "prismatic", axis = "x", name = "x", role = "preloaded", spring = { law = "linear", stiffness = 1 } } ]
[[spring]]
name = "a"
from_at = [-1, 0]
to = "tip"
law = { law = "one_sided", stiffness = 2, from = "1 + g" }
[[spring]]
name = "b"
from_at = [-1, 0]
to = "tip"
law = { law = "one_sided", stiffness = 3, from = "1 + h + e" }
[[study]]
name = "s"
control = "load"
direction = [1, 0]
until = { lambda = [-0.01, 3] }
)toml" + study;
}

TEST(SpringsAtOnce, AreFollowedInAParameterThatKeepsThemTogether) {
  const auto result = run(two_stops("kind = \"critical_curve\"\ncritical_curve = { of = \"SA1\", "
                                    "parameter = \"g\", range = [0.2, 0.9] }\n"))
                          .of("s");
  ASSERT_EQ(result.branches.size(), 1U);
  const auto& rows = result.branches[0].samples;
  for (const auto& row : rows) EXPECT_NEAR(row.values[1], row.values.back(), 1e-12);
  EXPECT_NEAR(rows.front().values.back(), 0.2, 1e-12);
  EXPECT_NEAR(rows.back().values.back(), 0.9, 1e-12);
  EXPECT_TRUE(complete(result));
}

TEST(SpringsAtOnce, AreThoseThatSwitchFirstOnEachSideOfAParameterThatPartsThem) {
  const auto result = run(two_stops("kind = \"critical_curve\"\ncritical_curve = { of = \"SA1\", "
                                    "parameter = \"e\", range = [-0.2, 0.3] }\n"))
                          .of("s");
  ASSERT_EQ(result.branches.size(), 1U);
  const auto& rows = result.branches[0].samples;
  for (const auto& row : rows)
    EXPECT_NEAR(row.values[1], 0.5 + std::min(0.0, row.values.back()), 1e-12);
  EXPECT_NEAR(rows.front().values.back(), -0.2, 1e-12);
  EXPECT_NEAR(rows.back().values.back(), 0.3, 1e-12);
  EXPECT_TRUE(complete(result));
}

TEST(SpringsAtOnce, HaveRatesByParametersThatKeepThemTogetherOnly) {
  const auto result = run(two_stops("kind = \"sensitivity\"\n")).of("s");
  const auto& events = result.branches.at(0).events;
  const auto found = std::find_if(events.begin(), events.end(), [](const auto& event) {
    return event.kind == EventKind::switching;
  });
  ASSERT_NE(found, events.end());
  EXPECT_NEAR(value(result, found->row, "d(lambda)/d(g)"), 1, 1e-10);
  EXPECT_TRUE(std::isnan(value(result, found->row, "d(lambda)/d(e)")));
}

/// Two sliders reach their breakpoints at one load: s1 falls behind its own, and s0 goes back from where it came.
TEST(SpringsAtOnce, OfWhichOneGoesBackAreToldWithoutIt) {
  const auto ran = run(R"toml(
[[body]]
name = "tool"
task_space = "xy"
[[chain]]
name = "rail"
elements = [ { joint = "prismatic", axis = "x", name = "s0", role = "preloaded", spring = { law = "piecewise_linear", breakpoints = [0.5], stiffnesses = [2, 4] } }, { joint = "prismatic", axis = "y", name = "s1", role = "preloaded", spring = { law = "piecewise_linear", breakpoints = [0.5, 1], stiffnesses = [2, -1, 3], falling = true } } ]
[[study]]
name = "push"
control = "load"
direction = [1, 1]
until = { lambda = [-0.5, 2] }
)toml");
  const auto& events = ran.of("push").branches.at(0).events;
  const auto corner = std::find_if(events.begin(), events.end(), [](const auto& event) {
    return event.kind == analysis::EventKind::corner_limit_point;
  });
  ASSERT_NE(corner, events.end());
  EXPECT_EQ(corner->detail.rfind("spring rail.s1 gets softer (segment 0 to 1)", 0), 0u)
      << corner->detail;
}

}  // namespace
}  // namespace springfold::io
