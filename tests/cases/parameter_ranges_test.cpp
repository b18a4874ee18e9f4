// Special points over ranges of a parameter, on the truss of two bars: with k = 1 and half a span of 1 the load is
// 2 (L0 - L) y / L, L^2 = 1 + y^2, L0^2 = 1 + h^2, so that limit points are at L^3 = L0.
#include <cmath>

#include "case_runs.hpp"
#include "small_structures.hpp"

namespace springfold::io {
namespace {

std::string two_bars(const std::string& study) {
  return R"(
[parameters]
h = 0.5
)" + supports_and_apex("a", R"("h")") +
         R"([[bar]]
from = "l"
to = "a"
stiffness = 1
[[bar]]
from = "r"
to = "a"
stiffness = 1
[[study]]
name = "s"
control = "load"
direction = [0, -1]
until = { a.y = [-3.2, 3.2] }
)" + study;
}

double load_of_bars(double y, double h) {
  const double L = std::sqrt(1 + y * y), L0 = std::sqrt(1 + h * h);
  return 2 * (L0 - L) * y / L;
}
double limit_of_bars(double h) { return load_of_bars(std::sqrt(std::cbrt(1 + h * h) - 1), h); }

void expect_limit_loads(const analysis::StudyResult& result, double low, double high) {
  ASSERT_EQ(result.branches.size(), 1U);
  const auto& rows = result.branches[0].samples;
  ASSERT_GT(rows.size(), 2U);
  double least = high, most = low;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double h = value(result, i, "h");
    EXPECT_NEAR(value(result, i, "lambda"), limit_of_bars(h), 1e-10) << h;
    least = std::min(least, h);
    most = std::max(most, h);
  }
  EXPECT_NEAR(least, low, 1e-12);
  EXPECT_NEAR(most, high, 1e-12);
  EXPECT_TRUE(result.branches[0].forward.complete);
  EXPECT_TRUE(result.branches[0].backward.complete);
}

TEST(ParameterRanges, ACurveThatStartsAtAnEndOfItsRangeStaysWithinIt) {
  for (const auto& [range, low, high] :
       {std::tuple{"[0.5, 0.9]", 0.5, 0.9}, std::tuple{"[0.1, 0.5]", 0.1, 0.5}})
    expect_limit_loads(run(two_bars("kind = \"critical_curve\"\ncritical_curve = { of = \"LP1\", "
                                    "parameter = \"h\", range = " +
                                    std::string{range} + " }\n"))
                           .of("s"),
                       low, high);
}

TEST(ParameterRanges, ACurveReachesItsEndAlsoWhereTheStartIsSingularSoonBehind) {
  expect_limit_loads(
      run(two_bars("set = { h = 0.1 }\ntrace = { maximum_step = 0.01 }\nkind = \"critical_curve\"\n"
                   "critical_curve = { of = \"LP1\", parameter = \"h\", range = [0.01, 3] }\n"))
          .of("s"),
      0.01, 3);
}

TEST(ParameterRanges, TheSearchForAThresholdDoesNotDependOnTheValueOfTheCase) {
  for (const std::string h : {"0.11", "0.5", "0.9", "1.5", "3"}) {
    const auto result =
        run(two_bars("set = { h = " + h +
                     " }\nkind = \"threshold\"\nthreshold = { of = \"limit_point\", parameter = "
                     "\"h\", range = [0.3, 1.5], value = \"largest\" }\n"))
            .of("s");
    EXPECT_TRUE(result.doubts.empty()) << h;
    expect_limit_loads(result, 0.3, 1.5);
  }
}

TEST(ParameterRanges, AMarkIsFollowedWhereverItIsTheSameMark) {
  const auto result =
      run(two_bars("kind = \"critical_curve\"\nmark = { a.y = [0.3] }\ncritical_curve = { of = "
                   "\"UZ1\", parameter = \"h\", range = [0.1, 3] }\n"))
          .of("s");
  ASSERT_EQ(result.branches.size(), 1U);
  EXPECT_EQ(result.branches[0].events.size(), 2U);
  for (std::size_t i = 0; i < result.branches[0].samples.size(); ++i)
    EXPECT_NEAR(value(result, i, "lambda"), load_of_bars(0.3, value(result, i, "h")), 1e-10);
  EXPECT_NEAR(value(result, 0, "h"), 0.1, 1e-12);
}

/// u^2 + (ro - 1)^2 = p: limit points at (ro - 1)^2 = p. At p = 0 the start is gone.
TEST(ParameterRanges, LimitPointsInAParameterAreFollowedTowardsWhereTheStartVanishes) {
  const auto result = run(R"(
[parameters]
ro = 1
p = 0.36
[[body]]
name = "p"
task_space = "xy"
pose = [0.6, 0]
[[chain]]
name = "c"
elements = [ { joint = "prismatic", axis = "x", name = "s", role = "preloaded", initial = 0.6, spring = { law = "formula", formula = "u^2 + (ro-1)^2 - p", range = [-9, 9], falling = true } } ]
[[study]]
name = "s"
kind = "critical_curve"
control = "parameter"
parameter = "ro"
direction = [1, 0]
until = { lambda = [-3, 3], c.s = [-3, 3] }
critical_curve = { of = "LP1", parameter = "p", range = [0.01, 2] }
)")
                          .of("s");
  ASSERT_EQ(result.branches.size(), 1U);
  const auto& branch = result.branches[0];
  EXPECT_TRUE(branch.backward.complete) << branch.backward.reason;
  EXPECT_LT(branch.samples.size(), 300U);
  for (std::size_t i = 0; i < branch.samples.size(); ++i)
    EXPECT_NEAR(std::pow(value(result, i, "lambda") - 1, 2), value(result, i, "p"), 1e-10);
}

}  // namespace
}  // namespace springfold::io
