// Springs that switch at once and leave the path unstable, or several ways on: a critical load like any other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "case_runs.hpp"
#include "small_structures.hpp"

namespace springfold::io {
namespace {

constexpr double strut_stiffness = 2, cable_tension = 0.1, half_span = 0.8;
const double cable_length = std::sqrt(1 + half_span * half_span);

/// A strut of stiffness ka and height 1 between two equal cables under the tension T. Both go slack at once, at the
/// load ka (1 - height) of the height at which a cable is as long as it is without force.
double height_of_slack(double tension) {
  return std::sqrt((cable_length - tension) * (cable_length - tension) - half_span * half_span);
}
const double load_of_slack = strut_stiffness * (1 - height_of_slack(cable_tension));

Ran strut(const std::string& study) {
  return run(R"toml(
[parameters]
kq = 0.02
ka = 2
T = 0.1
[[body]]
name = "top"
task_space = "xy"
pose = [0, 1]
[[chain]]
name = "mast"
elements = [
  { joint = "revolute", axis = "z", name = "q", role = "preloaded", spring = { law = "linear", stiffness = "kq" } },
  { joint = "prismatic", axis = "y", name = "a", role = "virtual", stiffness = "ka" },
  { rigid = [0, 1] },
]
[[node]]
repeat = { i = [0, 1] }
name = "n{i}"
at = ["0.8*(2*i-1)", 0]
fixed = true
[[bar]]
repeat = { i = [0, 1] }
name = "c{i}"
from = "n{i}"
to = "top"
stiffness = 1
pretension = "T"
tension_only = true
[[study]]
name = "s"
control = "load"
direction = [0, -1]
until = { lambda = [-0.2, 0.3], mast.q = [-1, 1] }
)toml" + study);
}

TEST(KinksOfSeveralSprings, HaveTheRatesOfTheirClosedForm) {
  const auto result =
      strut("kind = \"sensitivity\"\nsensitivity = { parameters = [\"T\", \"ka\", \"kq\"] }\n")
          .of("s");
  const auto& events = result.branches.at(0).events;
  const auto kink = std::find_if(events.begin(), events.end(), [](const auto& event) {
    return event.kind == analysis::EventKind::branching_kink;
  });
  ASSERT_NE(kink, events.end());
  EXPECT_NEAR(value(result, kink->row, "lambda"), load_of_slack, 1e-10);
  EXPECT_NEAR(value(result, kink->row, "d(lambda)/d(T)"),
              strut_stiffness * (cable_length - cable_tension) / height_of_slack(cable_tension),
              1e-8);
  EXPECT_NEAR(value(result, kink->row, "d(lambda)/d(ka)"), load_of_slack / strut_stiffness, 1e-8);
  EXPECT_NEAR(value(result, kink->row, "d(lambda)/d(kq)"), 0, 1e-8);
}

TEST(KinksOfSeveralSprings, AreNoLossOfStabilityWhereTheFootBearsTheStrutAlone) {
  // Without cables the shortened strut stands up to load * height = kq.
  const auto result = strut(
                          "kind = \"threshold\"\nthreshold = { of = \"loss_of_stability\", "
                          "parameter = \"kq\", range = [0.02, 1] }\n")
                          .of("s");
  ASSERT_TRUE(result.threshold && result.threshold->found);
  // Up to the end of the range of loads, 0.3.
  EXPECT_NEAR(result.threshold->value, 0.3 * (1 - 0.3 / strut_stiffness), 1e-6);
  EXPECT_TRUE(result.doubts.empty());
}

TEST(KinksOfSeveralSprings, AreTheFirstCriticalLoadOverTheTension) {
  const auto result = strut(
                          "kind = \"critical_load\"\ncritical_load = { of = "
                          "\"loss_of_stability\", parameter = \"T\", range = [0.06, 0.11], "
                          "values = 6 }\n")
                          .of("s");
  EXPECT_TRUE(result.doubts.empty());
  ASSERT_EQ(result.branches.size(), 1U);
  for (const auto& row : result.branches.front().samples)
    EXPECT_NEAR(row.values[1], strut_stiffness * (1 - height_of_slack(row.values.back())), 1e-10);
}

TEST(KinksOfSeveralSprings, HaveACurveOverTheTension) {
  const auto result = strut(
                          "kind = \"critical_curve\"\ncritical_curve = { of = \"KB1\", "
                          "parameter = \"T\", range = [0.05, 0.11] }\n")
                          .of("s");
  ASSERT_FALSE(result.branches.empty());
  const auto& rows = result.branches.front().samples;
  EXPECT_GT(rows.size(), 3U);
  for (const auto& row : rows)
    EXPECT_NEAR(row.values[1], strut_stiffness * (1 - height_of_slack(row.values.back())), 1e-10);
}

TEST(KinksOfSeveralSprings, AreFollowedUnderAPrescribedDisplacementAsUnderALoad) {
  // A flat truss of height 0.5 between two springs that push until they are as long as at the height 0.2, both at once.
  const auto result = run(truss_between_springs + R"toml([[study]]
name = "s"
kind = "critical_curve"
control = "mixed"
direction = [0, -1]
until = { t.y = [-0.6, 0.55] }
critical_curve = { of = "CL1", parameter = "kv", range = [0, 0.1] }
)toml");
  const auto& s = result.of("s");
  EXPECT_TRUE(complete(s));
  ASSERT_FALSE(s.branches.empty());
  const auto& rows = s.branches.front().samples;
  EXPECT_GT(rows.size(), 3U);
  EXPECT_NEAR(rows.front().values.back(), 0, 1e-12);
  EXPECT_NEAR(rows.back().values.back(), 0.1, 1e-12);
  for (std::size_t row = 0; row < rows.size(); ++row) EXPECT_NEAR(value(s, row, "t.y"), 0.2, 1e-9);
}

}  // namespace
}  // namespace springfold::io
