// Sensitivities and critical curves of marked values where a spring switches beside them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;

/// A slide on a spring of stiffness k1 up to x = b, and k2 beyond.
std::string slide_with_stop(const std::string& b, const std::string& k2, const std::string& study) {
  return "[parameters]\nb = " + b + "\nk1 = 1\nk2 = " + k2 + R"toml(
[[body]]
name = "tip"
task_space = "xy"
[[chain]]
name = "rail"
elements = [ { joint = "prismatic", axis = "x", name = "x", role = "preloaded", spring = { law = "piecewise_linear", breakpoints = ["b"], stiffnesses = ["k1", "k2"] } } ]
[[study]]
name = "s"
control = "load"
direction = [1, 0]
until = { lambda = [-0.01, 3] }
)toml" + study;
}

TEST(BesideBreakpoints, TheRateOfTheEnergyIsThatOfTheSegmentOfTheState) {
  // x = lambda / k1 = 1/2 before the breakpoint: energy lambda^2 / (2 k1).
  for (const std::string k2 : {"11", "10000"})
    for (const std::string b : {"0.501", "0.5001", "0.6"}) {
      const auto result =
          run(slide_with_stop(b, k2,
                              "kind = \"sensitivity\"\nmark = { lambda = [0.5] }\nsensitivity = { "
                              "parameters = [\"b\", \"k1\", \"k2\"] }\n"))
              .of("s");
      const auto& events = result.branches.at(0).events;
      const auto mark = std::find_if(events.begin(), events.end(), [](const auto& event) {
        return event.kind == EventKind::user_value;
      });
      ASSERT_NE(mark, events.end());
      EXPECT_NEAR(value(result, mark->row, "d(energy)/d(k1)"), -0.125, 1e-10) << b << " " << k2;
      EXPECT_NEAR(value(result, mark->row, "d(energy)/d(b)"), 0, 1e-10) << b << " " << k2;
      EXPECT_NEAR(value(result, mark->row, "d(energy)/d(k2)"), 0, 1e-10) << b << " " << k2;
    }
}

TEST(BesideBreakpoints, AMarkedValueIsFollowedToBehindASpringThatSwitches) {
  // x = 1/2 needs 1/2 + 10 max(0, 1/2 - b).
  for (const std::string b : {"0.6", "0.45"}) {
    const auto result =
        run(slide_with_stop(
                b, "11",
                "kind = \"critical_curve\"\nmark = { rail.x = [0.5] }\n"
                "critical_curve = { of = \"UZ1\", parameter = \"b\", range = [0.4, 0.7] "
                "}\n"))
            .of("s");
    ASSERT_EQ(result.branches.size(), 2U) << b;
    double low = 1, high = 0;
    int switches = 0;
    for (const analysis::Branch& branch : result.branches) {
      for (const auto& sample : branch.samples) {
        const double at = sample.values.back();
        low = std::min(low, at);
        high = std::max(high, at);
        EXPECT_NEAR(sample.values[1], 0.5 + 10 * std::max(0.0, 0.5 - at), 1e-10) << at;
      }
      switches += static_cast<int>(
          std::count_if(branch.events.begin(), branch.events.end(),
                        [](const auto& event) { return event.kind == EventKind::switching; }));
    }
    EXPECT_NEAR(low, 0.4, 1e-12);
    EXPECT_NEAR(high, 0.7, 1e-12);
    EXPECT_EQ(switches, 1);
    EXPECT_TRUE(complete(result));
  }
}

TEST(RatesOfForceLimits, AreThoseOfTheClosedFormWhereLambdaIsMeasuredInALargeUnit) {
  // A bar of free length l0 from (0, -a) to a node that is driven along y = 0: the force turns back at l0 a^2 = L^3,
  // and lambda is counted from x = -sqrt(l0^2 - a^2).
  const auto result = run(R"toml(
[parameters]
a = 0.5
[[node]]
name = "n"
at = [-1, 0]
fixed = ["y"]
[[node]]
name = "foot"
at = [0, "-a"]
fixed = true
[[bar]]
from = "foot"
to = "n"
stiffness = 3
free = 1.118033988749895
[[study]]
name = "s"
kind = "sensitivity"
body = "n"
control = "mixed"
direction = [1, 0]
until = { deflection = [-0.1, 1.9] }
)toml")
                          .of("s");
  const auto place = [](double a) {
    const double l0 = 1.118033988749895;
    return -std::sqrt(std::pow(l0 * a * a, 2.0 / 3) - a * a) + std::sqrt(l0 * l0 - a * a);
  };
  const auto& events = result.branches.at(0).events;
  const auto first = std::find_if(events.begin(), events.end(), [](const auto& event) {
    return event.kind == EventKind::limit_point;
  });
  ASSERT_NE(first, events.end());
  EXPECT_NEAR(value(result, first->row, "lambda"), place(0.5), 1e-10);
  const double h = 1e-3;
  const double rate =
      (8 * (place(0.5 + h) - place(0.5 - h)) - place(0.5 + 2 * h) + place(0.5 - 2 * h)) / (12 * h);
  EXPECT_NEAR(value(result, first->row, "d(lambda)/d(a)"), rate, 1e-9);
}

TEST(RatesOfForceLimits, AreKnownOfABodyWhosePoseIsDriven) {
  // No unknown is left: two springs of stiffness k, whose force turns back at places that do not depend on k.
  const auto result = run(R"toml(
[parameters]
k = 4
[[body]]
name = "tip"
task_space = "xy"
pose = [0, 0.5]
[[spring]]
name = "a"
from_at = [-1, 0]
to = "tip"
stiffness = "k"
free = 1.2
[[spring]]
name = "b"
from_at = [1, 0]
to = "tip"
stiffness = "k"
free = 1.2
[[study]]
name = "s"
kind = "sensitivity"
sensitivity = { parameters = ["k"] }
control = "pose"
direction = [0, -1]
until = { deflection = [-0.05, 1.4] }
)toml")
                          .of("s");
  int points = 0;
  for (const auto& event : result.branches.at(0).events)
    if (event.kind == EventKind::limit_point) {
      ++points;
      EXPECT_NEAR(value(result, event.row, "d(lambda)/d(k)"), 0, 1e-9);
    }
  EXPECT_EQ(points, 2);
}

}  // namespace
}  // namespace springfold::io
