// Imperfections that act with the square of their parameter: to first order it seems to keep the branch point.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

/// A strut of length 1 on a hinge with moment q + c q^2, held by a guy of stiffness 0.3 and length 1.5 across. Its
/// anchor is shifted along the strut by m, which stretches it by m^2/3: across acts 0.3 m^2/3, and near the branch
/// point at 1.3 c q^2 - l q + 0.1 m^2 = 0.
std::string shifted_guy(const std::string& c, const std::string& study) {
  return "[parameters]\nm = 0\nc = " + c + R"toml(
[[body]]
name = "tip"
task_space = "xy"
pose = [1, 0]
[[chain]]
name = "c"
elements = [
  { joint = "revolute", axis = "z", name = "q", role = "preloaded", spring = { law = "polynomial", coefficients = [0, 1, "c"], falling = true } },
  { rigid = [1, 0] },
]
[[spring]]
name = "g"
from_at = ["1 + m", -1.5]
to = "tip"
law = { law = "linear", stiffness = 0.3, free = 1.5 }
[[study]]
name = "s"
control = "load"
direction = [-1, 0]
until = { lambda = [-0.05, 3], c.q = [-1.2, 1.2] }
)toml" + study;
}

TEST(ImperfectionsOfSecondOrder, LowerTheLoadLinearlyWhereBranchesCross) {
  const auto result =
      run(shifted_guy("0.5", "kind = \"sensitivity\"\nsensitivity = { parameters = [\"m\"] }\n"))
          .of("s");
  const auto& event = result.branches.at(0).events.at(1);
  ASSERT_EQ(event.kind, analysis::EventKind::branch_point);
  EXPECT_EQ(value(result, event.row, "exponent(m)"), 1);
  EXPECT_NEAR(value(result, event.row, "coefficient(m)"), 2 * std::sqrt(0.5 * 0.3 / 3), 1e-8);
  EXPECT_EQ(value(result, event.row, "sign(m)"), 0);
  EXPECT_TRUE(std::isnan(value(result, event.row, "d(lambda)/d(m)")));
}

TEST(ImperfectionsOfSecondOrder, HaveTwiceTheExponentOfThePitchfork) {
  const auto result =
      run(shifted_guy("0", "kind = \"sensitivity\"\nsensitivity = { parameters = [\"m\"] }\n"))
          .of("s");
  const auto& event = result.branches.at(0).events.at(1);
  ASSERT_EQ(event.kind, analysis::EventKind::branch_point);
  EXPECT_EQ(value(result, event.row, "exponent(m)"), 4.0 / 3);
  EXPECT_NEAR(value(result, event.row, "d(lambda)/d(m)"), 0, 1e-9);
}

TEST(ImperfectionsOfSecondOrder, LeaveNoCurveOfBranchPoints) {
  const auto result =
      run(shifted_guy("0.5",
                      "kind = \"critical_curve\"\ncritical_curve = { of = \"BP1\", parameter = "
                      "\"m\", range = [-0.1, 0.1] }\n"))
          .of("s");
  for (const auto& branch : result.branches)
    for (const auto& sample : branch.samples)
      EXPECT_NEAR(1.3 - sample.values[1], 2 * std::sqrt(0.05) * std::abs(sample.values.back()),
                  1e-3 * std::abs(sample.values.back()));
}

TEST(ImperfectVersions, AtABranchPointTheLimitPointsOfImperfectVersionsHaveNoPointBesideIt) {
  // lambda sin q = q + b q^3 - e: limit points at lambda = 1 + (3 b + 1/2) q^2 + ..., e = -(2 b + 1/3) q^3 + ...
  for (const std::string b : {"1", "-1"}) {
    SCOPED_TRACE(b);
    const auto result = run("[parameters]\ne = 0\nb = " + b + R"toml(
[[body]]
name = "tip"
task_space = "xy"
pose = [0, 1]
[[chain]]
name = "bar"
elements = [ { joint = "revolute", axis = "z", name = "q", role = "preloaded", spring = { law = "polynomial", coefficients = ["-e", 1, 0, "b"], falling = true } }, { rigid = [0, 1] } ]
[[study]]
name = "s"
kind = "critical_curve"
control = "load"
direction = [0, -1]
until = { bar.q = [-1, 1], lambda = [-1, 5] }
critical_curve = { of = "BP1", parameter = "e", range = [-0.1, 0.1] }
)toml")
                            .of("s");
    ASSERT_EQ(result.branches.size(), 1U);
    int at_branch_point = 0;
    for (const auto& event : result.branches[0].events)
      at_branch_point += std::abs(value(result, event.row, "e")) < 1e-6 ? 1 : 0;
    EXPECT_EQ(at_branch_point, 1);
    for (std::size_t row = 0; row < result.branches[0].samples.size(); ++row) {
      const double lambda = value(result, row, "lambda");
      if (value(result, row, "e") == 0) continue;
      EXPECT_GT((lambda - 1) * std::stod(b), 0);
    }
  }
}

}  // namespace
}  // namespace springfold::io
