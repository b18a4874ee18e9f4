// Equal bistable units: where the load turns back, branches in which the units part cross the path. Along the path that
// is a limit point, which has a curve over a parameter, a threshold, a first critical load and rates.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "case_runs.hpp"
#include "springfold/analysis/design.hpp"

namespace springfold::io {
namespace {

/// Two springs F = c u - 3 u^2 + u^3 in series: F turns back at u = 1 - sqrt(1 - c/3) in both at once, until c = 3.
const std::string two_units = R"toml(
[parameters]
ks = 0.6
c = 2.2
[[node]]
name = "tool"
at = [1, 0]
fixed = ["y"]
[[spring]]
name = "rope"
to = "tool"
series = [
  { law = "polynomial", coefficients = [0, "c", -3, 1], falling = true },
  { law = "polynomial", coefficients = [0, "c", -3, 1], falling = true },
  { law = "linear", stiffness = "ks", free = 1 },
]
initial = [0.0, 0.0]
)toml";

std::string study_of(const std::string& control, const std::string& kind, const std::string& more) {
  return two_units + "[[study]]\nname = \"s\"\nbody = \"tool\"\ndirection = [1, 0]\ncontrol = \"" +
         control + "\"\nuntil = { lambda = [-0.4, 12], rope.1 = [-1, 4], rope.2 = [-1, 4] }\n" +
         "kind = \"" + kind + "\"\n" + more;
}

double place_of_turn(double c) { return 1 - std::sqrt(1 - c / 3); }
double load_of_turn(double c) {
  const double u = place_of_turn(c);
  return ((u - 3) * u + c) * u;
}

TEST(Hilltops, AreGoneWhereTheLimitPointsOfTheUnitsAre) {
  for (const std::string control : {"load", "mixed"}) {
    SCOPED_TRACE(control);
    const std::string what = "of = \"limit_point\", parameter = \"c\", range = [2, 4]";
    const std::string index = control == "load" ? "" : ", index = \"dead_load\"";
    const auto result =
        run(study_of(control, "threshold", "threshold = { " + what + index + " }\n")).of("s");
    ASSERT_TRUE(result.threshold && result.threshold->found);
    EXPECT_NEAR(result.threshold->value, 3, 1e-9);
    EXPECT_TRUE(result.doubts.empty());
  }
}

TEST(Hilltops, AreTheFirstCriticalLoadOverAParameterThatKeepsTheUnitsEqual) {
  const auto result =
      run(study_of("load", "critical_load",
                   "critical_load = { of = \"limit_point\", parameter = \"c\", range = [2, 4], "
                   "values = 5 }\n"))
          .of("s");
  ASSERT_EQ(result.branches.size(), 1U);
  EXPECT_TRUE(result.doubts.empty());
  for (const analysis::Sample& row : result.branches.front().samples)
    EXPECT_NEAR(row.values[1], load_of_turn(std::min(row.values.back(), 3.0)), 1e-9);
}

TEST(Hilltops, HaveRatesByParametersThatKeepTheUnitsEqual) {
  const auto result =
      run(study_of("load", "sensitivity", "sensitivity = { parameters = [\"c\", \"ks\"] }\n"))
          .of("s");
  const auto& events = result.branches.at(0).events;
  const auto turn = std::find_if(events.begin(), events.end(), [](const auto& event) {
    return event.kind == analysis::EventKind::branch_point;
  });
  ASSERT_NE(turn, events.end());
  // By the envelope the rate of F at its turn is that of F at a u that stays.
  EXPECT_NEAR(value(result, turn->row, "d(lambda)/d(c)"), place_of_turn(2.2), 1e-9);
  EXPECT_NEAR(value(result, turn->row, "d(lambda)/d(ks)"), 0, 1e-9);
}

TEST(Hilltops, OfADesignHaveTheLoadThatIsWanted) {
  const auto result = run(study_of("load", "design",
                                   "design = { parameters = { c = [2, 2.9] }, critical_load = { "
                                   "at_least = 0.7 }, starts = 2 }\n"))
                          .of("s");
  ASSERT_TRUE(result.design);
  EXPECT_EQ(result.design->status, analysis::DesignStatus::met);
  EXPECT_NEAR(load_of_turn(result.design->parameters.front().after), 0.7, 1e-9);
}

}  // namespace
}  // namespace springfold::io
