// Limits and marks that are formulas of the parameter in which special points are looked at. A toggle of two links of
// length 1 with a spring of stiffness 1, drawn at the angle alpha: P = 4 (cos t - cos alpha) tan t, largest where
// cos^3 t = cos alpha.
#include <gtest/gtest.h>

#include <cmath>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

const double deg = std::acos(-1.0) / 180;

std::string toggle(const std::string& study) {
  return R"toml(
[parameters]
k = 1
alpha = "45*deg"
half = "alpha/2"
[[body]]
name = "knee"
task_space = "xy"
pose = ["cos(alpha)", "sin(alpha)"]
[[chain]]
name = "crank"
elements = [
  { joint = "revolute", axis = "z", name = "foot", initial = "alpha" },
  { rigid = [1, 0] },
]
[[chain]]
name = "rod"
from_at = ["2*cos(alpha)", 0]
elements = [
  { joint = "prismatic", axis = "x", name = "slider", role = "preloaded", spring = { law = "linear", stiffness = "k", free = 0 } },
  { joint = "revolute", axis = "z", name = "pin", initial = "180*deg - alpha" },
  { rigid = [1, 0] },
]
[[study]]
name = "s"
control = "load"
direction = [0, -1]
)toml" + study;
}

double load_at(double angle, double alpha) {
  return 4 * (std::cos(angle) - std::cos(alpha)) * std::tan(angle);
}

/// Rows of the special points of the first branch of this kind.
std::vector<std::size_t> rows_with(const analysis::StudyResult& result, analysis::EventKind kind) {
  std::vector<std::size_t> rows;
  for (const auto& event : result.branches.at(0).events)
    if (event.kind == kind) rows.push_back(event.row);
  return rows;
}

TEST(ValuesThatFollow, TheRateOfAMarkedValueHasTheRateOfItsMark) {
  const auto result = run(toggle(R"toml(kind = "sensitivity"
until = { crank.foot = [0.1, "1.1*alpha"] }
mark = { crank.foot = ["half"] }
sensitivity = { parameters = ["alpha", "k"] }
)toml"))
                          .of("s");
  const auto rows = rows_with(result, analysis::EventKind::user_value);
  ASSERT_EQ(rows.size(), 1U);
  const double alpha = 45 * deg, t = alpha / 2, c = std::cos(t);
  const double rate =
      4 * (std::sin(alpha) - 0.5 * std::sin(t)) * std::tan(t) + 2 * (c - std::cos(alpha)) / (c * c);
  EXPECT_NEAR(value(result, rows[0], "d(lambda)/d(alpha)"), rate, 1e-10);
  EXPECT_NEAR(value(result, rows[0], "d(crank.foot)/d(alpha)"), 0.5, 1e-10);
  EXPECT_NEAR(value(result, rows[0], "d(lambda)/d(k)"), load_at(t, alpha), 1e-10);
}

TEST(ValuesThatFollow, TheCurveOfAMarkedValueIsThatOfItsFormula) {
  const auto result = run(toggle(R"toml(kind = "critical_curve"
until = { crank.foot = [0.1, "1.1*alpha"] }
mark = { crank.foot = ["half"] }
critical_curve = { of = "UZ1", parameter = "alpha", range = ["20*deg", "60*deg"] }
)toml"))
                          .of("s");
  EXPECT_TRUE(complete(result));
  const auto& samples = result.branches.at(0).samples;
  for (std::size_t row = 0; row < samples.size(); ++row) {
    const double alpha = value(result, row, "alpha");
    EXPECT_NEAR(value(result, row, "crank.foot"), alpha / 2, 1e-10);
    EXPECT_NEAR(value(result, row, "lambda"), load_at(alpha / 2, alpha), 1e-10);
  }
  EXPECT_NEAR(value(result, 0, "alpha"), 20 * deg, 1e-10);
  EXPECT_NEAR(value(result, samples.size() - 1, "alpha"), 60 * deg, 1e-10);
}

TEST(ValuesThatFollow, LimitsAndMarksOfACriticalCurveAreThoseOfItsValues) {
  // From flat to steep the limit point lies at 0.577 alpha to alpha.
  const auto result = run(toggle(R"toml(kind = "critical_curve"
until = { crank.foot = ["0.59*alpha", "1.1*alpha"] }
mark = { crank.foot = ["1.3*half"] }
critical_curve = { of = "LP1", parameter = "alpha", range = ["20*deg", "85*deg"] }
)toml"))
                          .of("s");
  EXPECT_TRUE(complete(result));
  const double begin = value(result, 0, "alpha");
  EXPECT_GT(begin, 21 * deg);
  EXPECT_NEAR(value(result, 0, "crank.foot"), 0.59 * begin, 1e-10);
  EXPECT_NEAR(std::pow(std::cos(0.59 * begin), 3), std::cos(begin), 1e-10);
  const std::size_t last = result.branches.at(0).samples.size() - 1;
  EXPECT_NEAR(value(result, last, "alpha"), 85 * deg, 1e-10);
  const auto marks = rows_with(result, analysis::EventKind::user_value);
  ASSERT_EQ(marks.size(), 1U);
  const double alpha = value(result, marks[0], "alpha");
  EXPECT_NEAR(value(result, marks[0], "crank.foot"), 0.65 * alpha, 1e-10);
  EXPECT_NEAR(std::pow(std::cos(0.65 * alpha), 3), std::cos(alpha), 1e-10);
}

TEST(ValuesThatFollow, FirstCriticalLoadsAreOneCurveWhereTheLimitsFollow) {
  const auto result = run(toggle(R"toml(kind = "critical_load"
until = { crank.foot = ["half", "1.1*alpha"] }
critical_load = { of = "limit_point", parameter = "alpha", range = ["20*deg", "85*deg"], values = 9 }
)toml"))
                          .of("s");
  EXPECT_TRUE(complete(result));
  ASSERT_EQ(result.branches.size(), 1U);
  EXPECT_NEAR(value(result, 0, "alpha"), 20 * deg, 1e-10);
  EXPECT_NEAR(value(result, result.branches[0].samples.size() - 1, "alpha"), 85 * deg, 1e-10);
}

TEST(ValuesThatFollow, MarksThatTheParameterPartsHaveNoRateByIt) {
  const std::string marks = R"toml(until = { crank.foot = [0.1, "1.1*alpha"] }
mark = { crank.foot = ["half", "22.5*deg"] }
)toml";
  const auto rates = run(toggle("kind = \"sensitivity\"\n" + marks +
                                "sensitivity = { parameters = [\"alpha\", \"k\"] }\n"))
                         .of("s");
  const auto rows = rows_with(rates, analysis::EventKind::user_value);
  ASSERT_FALSE(rows.empty());
  EXPECT_TRUE(std::isnan(value(rates, rows[0], "d(lambda)/d(alpha)")));
  EXPECT_NEAR(value(rates, rows[0], "d(lambda)/d(k)"), load_at(22.5 * deg, 45 * deg), 1e-10);
  const auto curve = run(toggle("kind = \"critical_curve\"\n" + marks +
                                "critical_curve = { of = \"UZ1\", parameter = \"alpha\" }\n"))
                         .of("s");
  EXPECT_FALSE(curve.start.found);
  EXPECT_NE(curve.start.message.find("the parameter parts them"), std::string::npos);
}

}  // namespace
}  // namespace springfold::io
