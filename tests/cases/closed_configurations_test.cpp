// Mechanisms of one freedom whose joints turn: on each closed curve of configurations minima and maxima alternate.
#include <gmock/gmock.h>

#include <numbers>
#include <string>

#include "case_runs.hpp"
#include "io/result_access.hpp"
#include "small_structures.hpp"

namespace springfold::io {
namespace {

/// A crank-rocker in units of millimetres, and very soft springs with gaps.
const std::string four_bar_with_gaps = four_bar({.crank = 500,
                                                 .base = 1000,
                                                 .rocker = 900,
                                                 .coupler = 1100,
                                                 .at_crank = 3.5496818790460956,
                                                 .at_rocker = 2.4362263492476126,
                                                 .at_coupler = 0.7906731378849021}) +
                                       R"(
[[spring]]
name = "s0"
from_at = [800.0716067080065, 704.021103847786]
to = "Q"
law = { law = "gap", stiffness = 9.999999999999998e-13, low = 450.0539583797558, high = 600.0539583797558 }
[[spring]]
name = "s1"
from_at = [-227.44986013123457, 59.04880667820844]
to = "Q"
law = { law = "linear", stiffness = 1.9999999999999996e-13, free = 754.3372850633938 }
[[spring]]
name = "s2"
from_at = [-313.31653938034634, 493.3571121023257]
to = "P"
law = { law = "gap", stiffness = 9.999999999999998e-13, low = 664.0157706718439, high = 814.0157706718439 }
[[study]]
name = "p"
kind = "equilibria"
body = "Q"
load = [-2.618291351666364e-10, -1.2833959319533372e-10]
search = { starts = 200 }
)";

TEST(ClosedConfigurations, OfAFourBarWithGapsAreCountedAndNoEquilibriumIsMissing) {
  const auto result = run(four_bar_with_gaps).of("p");
  ASSERT_TRUE(result.equilibria);
  const analysis::EquilibriaReport& report = *result.equilibria;
  EXPECT_TRUE(report.morse.applies) << report.morse.why;
  EXPECT_EQ(report.morse.expected, 0);
  EXPECT_EQ(report.morse.found, 0);
  // As many as the crank turned through 4,000 angles shows on both assemblies.
  EXPECT_EQ(report.list.size(), 8u);
  int stable = 0;
  for (const auto& e : report.list)
    stable += e.sample.values[*column_of(result, "index")] == 0 ? 1 : 0;
  EXPECT_EQ(stable, 4);
}

/// Where crank and rocker of a parallelogram lie on one line with the ground its configurations cross.
const std::string parallelogram = four_bar({.crank = 0.2 * std::numbers::sqrt2,
                                            .rocker = 0.2 * std::numbers::sqrt2,
                                            .at_crank = std::numbers::pi / 4,
                                            .at_rocker = std::numbers::pi / 4}) +
                                  R"(
[[spring]]
name = "s"
from_at = [-0.3, 0.4]
to = "P"
law = { law = "one_sided", stiffness = 1, from = 0.3 }
[[study]]
name = "p"
kind = "equilibria"
body = "Q"
load = [0.05, -0.02]
search = { starts = 60 }
)";

TEST(ClosedConfigurations, ThatCrossAreNotCounted) {
  const auto result = run(parallelogram).of("p");
  ASSERT_TRUE(result.equilibria);
  EXPECT_FALSE(result.equilibria->morse.applies);
  EXPECT_THAT(result.equilibria->morse.why, testing::HasSubstr("without singular points"));
}

}  // namespace
}  // namespace springfold::io
