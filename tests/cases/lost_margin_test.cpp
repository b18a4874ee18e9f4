// Limit points that come to the start of the path, which vanishes there.
#include <gtest/gtest.h>

#include <cmath>

#include "case_runs.hpp"
#include "small_structures.hpp"

namespace springfold::io {
namespace {

/// A truss of two bars at 45 degrees, pushed down by a weight W and lambda together: their limit point is at (1 -
/// 2^(-1/3))^1.5 times two, of bars of stiffness 1.
std::string weighed_truss(const std::string& study) {
  return R"toml(
[parameters]
W = 0.05
)toml" + supports_and_apex("apex", "1") +
         R"toml(fixed = ["x"]
[[bar]]
from = "l"
to = "apex"
stiffness = 1
[[bar]]
from = "r"
to = "apex"
stiffness = 1
[[study]]
name = "s"
control = "load"
body = "apex"
direction = [0, -1]
load = [0, "-W"]
until = { apex.y = [-1.6, 1.05], lambda = [-2, 3] }
)toml" + study;
}

/// F = 2 y (sqrt(2)/sqrt(1 + y^2) - 1) is largest where 1 + y^2 = 2^(1/3).
const double largest_weight = 2 * std::pow(std::cbrt(2) - 1, 1.5);

TEST(LostMargin, IsTheThresholdOfTheWeightThatIsTheLimitLoad) {
  const auto result = run(weighed_truss(R"toml(
kind = "threshold"
threshold = { of = "limit_point", parameter = "W", range = [0, 0.5] }
)toml"))
                          .of("s");
  ASSERT_TRUE(result.threshold && result.threshold->found);
  EXPECT_NEAR(result.threshold->value, largest_weight, 1e-9);
  EXPECT_EQ(result.threshold->decides, "the limit point reaches the start of the path");
  // Beyond it the truss starts snapped through.
  EXPECT_EQ(result.threshold->message.find("no start"), std::string::npos);
  EXPECT_TRUE(result.threshold->verified);
  EXPECT_TRUE(complete(result));
}

TEST(LostMargin, EndsTheFirstCriticalLoadsOverTheWeight) {
  const auto result = run(weighed_truss(R"toml(
kind = "critical_load"
critical_load = { of = "limit_point", parameter = "W", range = [0, 0.5], values = 11 }
)toml"))
                          .of("s");
  ASSERT_EQ(result.branches.size(), 1U);
  const auto& rows = result.branches.front().samples;
  for (const auto& row : rows) EXPECT_NEAR(row.values[1], largest_weight - row.values.back(), 1e-9);
  EXPECT_NEAR(rows.back().values.back(), largest_weight, 1e-9);
  EXPECT_EQ(result.branches.front().forward.reason, "it reaches the start of the path");
  EXPECT_TRUE(complete(result));
}

TEST(LostMargin, IsNotThatOfASecondLimitPointWhoseLoadPassesThatOfTheStart) {
  const auto result = run("[parameters]\nkv = 0.01\n" + truss_with_vertical_spring + R"toml(
[[study]]
name = "s"
kind = "threshold"
control = "load"
body = "t"
direction = [0, -1]
until = { t.y = [-0.6, 0.6] }
threshold = { of = "limit_point", parameter = "kv", range = [0, 2] }
)toml")
                          .of("s");
  ASSERT_TRUE(result.threshold && result.threshold->found);
  const auto& branch = result.branches.front();
  const auto says = [](const analysis::Stop& stop) {
    return stop.reason == "its load is that at which the path starts";
  };
  ASSERT_NE(says(branch.forward), says(branch.backward));
  const auto& end = says(branch.forward) ? branch.samples.back() : branch.samples.front();
  EXPECT_NEAR(end.values[column(result, "lambda")], 0, 1e-9);
  EXPECT_GT(std::abs(end.values[column(result, "deflection")]), 0.1);
}

}  // namespace
}  // namespace springfold::io
