// Laws that are smooth but for a jump of a derivative: cubic tables at their data points, contacts with low exponents.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

/// A mass on a slide with a cubic table, whose extrema are data points, and a spring beside it.
std::string table_on_a_slide(const std::string& study) {
  return R"toml(
[parameters]
kp = 0
[[body]]
name = "m"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "c"
elements = [{ joint = "prismatic", axis = "x", name = "u", role = "preloaded", spring = { law = "table", falling = true, points = [[-1, -1], [0, 0], [0.3, 0.45], [0.6, 0.66], [1, 0.5], [1.3, 0.36], [2, 1]] } }]
[[spring]]
name = "beside"
shape = "line"
of = ["m", { on = "base", at = [0, 0] }, { on = "base", at = [0, 1] }]
stiffness = "kp"
[[study]]
name = "s"
control = "load"
direction = [1, 0]
until = { "c.u" = [-0.5, 1.9] }
)toml" + study;
}

TEST(CubicTables, HaveLimitPointsOnTheDataPointsThatAreTheirExtrema) {
  const analysis::StudyResult result = run(table_on_a_slide("")).of("s");
  EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
  std::vector<std::array<double, 2>> found;
  for (const auto& event : result.branches.at(0).events) {
    const auto& values = result.branches[0].samples[event.row].values;
    if (event.kind == analysis::EventKind::limit_point)
      found.push_back({values[column(result, "c.u")], values[column(result, "lambda")]});
  }
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0][0], 0.6, 1e-10);
  EXPECT_NEAR(found[0][1], 0.66, 1e-12);
  EXPECT_NEAR(found[1][0], 1.3, 1e-10);
  EXPECT_NEAR(found[1][1], 0.36, 1e-12);
}

/// The steepest fall of the cubics from (0.6, 0.66) over (1, 0.5) to (1.3, 0.36), whose slope at 1 is that of Fritsch
/// and Butland and at both ends 0.
double steepest_fall() {
  const double h1 = 0.4, h2 = 0.3, d1 = -0.16 / h1, d2 = -0.14 / h2;
  const double a = (1 + h2 / (h1 + h2)) / 3, slope = d1 * d2 / (a * d2 + (1 - a) * d1);
  const auto steepest = [](double h, double from, double to, double rise) {
    // The slope is a parabola over the interval: its least value, at an end or between them.
    const double c = (from + to - 2 * rise) / (h * h), b = (3 * rise - 2 * from - to) / h;
    const double at = -b / (3 * c);
    const double between = at > 0 && at < h ? from + 2 * b * at + 3 * c * at * at : from;
    return std::min({from, to, between});
  };
  return -std::min(steepest(h1, 0, slope, d1), steepest(h2, slope, 0, d2));
}

TEST(CubicTables, HaveAThresholdFromTheValueOnAtWhichTheirExtremaAreDataPoints) {
  const analysis::StudyResult result =
      run(table_on_a_slide("kind = \"threshold\"\nthreshold = { of = \"limit_point\", parameter = "
                           "\"kp\", range = [0, 5] }\n"))
          .of("s");
  EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
  ASSERT_TRUE(result.threshold && result.threshold->found);
  EXPECT_NEAR(result.threshold->value, steepest_fall(), 1e-8);
}

/// lambda = x + max(0, x - 0.5)^m.
TEST(LowExponents, OfContactsDoNotEndTheCurve) {
  for (const std::string m : {"10/9", "1.15", "1.25", "4/3", "1.5"}) {
    const analysis::StudyResult result = run(R"toml(
[[body]]
name = "m"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "c"
elements = [{ joint = "prismatic", axis = "x", name = "s", role = "preloaded", spring = { law = "linear", stiffness = 1 } }]
[[chain]]
name = "d"
elements = [{ joint = "prismatic", axis = "x", name = "s", role = "preloaded", spring = { law = "power", force = 1, depth = 1, exponent = ")toml" +
                                             m + R"toml(", from = 0.5 } }]
[[study]]
name = "s"
control = "load"
direction = [1, 0]
until = { lambda = [-0.5, 2] }
)toml")
                                             .of("s");
    EXPECT_TRUE(complete(result)) << m << testing::PrintToString(result.doubts);
    const double power = m == "10/9" ? 10.0 / 9 : m == "4/3" ? 4.0 / 3 : std::stod(m);
    const auto& rows = result.branches.at(0).samples;
    EXPECT_NEAR(rows.back().values[column(result, "lambda")], 2, 1e-10) << m;
    for (const auto& row : rows) {
      const double x = row.values[column(result, "c.s")];
      EXPECT_NEAR(row.values[column(result, "lambda")], x + std::pow(std::max(0.0, x - 0.5), power),
                  1e-10)
          << m;
    }
  }
}

}  // namespace
}  // namespace springfold::io
