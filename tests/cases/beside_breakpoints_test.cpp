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

}  // namespace
}  // namespace springfold::io
