// Bars with laws of their elongation, struts and cables, run.
#include <gmock/gmock.h>

#include <cmath>

#include "cases/case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using testing::DoubleNear;

/// A von Mises truss at 30 deg, half of the span 1. @param bars  what both bars have in common
std::string roof(const std::string& bars, const std::string& more = "") {
  std::string text = R"toml([[node]]
repeat = { i = [0, 1] }
name = "foot{i}"
at = ["2*i - 1", 0]
fixed = true
[[node]]
name = "apex"
at = [0, "tan(30*deg)"]
)toml";
  for (const std::string i : {"0", "1"})
    text += "[[bar]]\nname = \"b" + i + "\"\nfrom = \"foot" + i + "\"\nto = \"apex\"\n" + bars;
  return text + more + R"toml([[study]]
name = "press"
body = "apex"
control = "load"
direction = [0, -1]
until = { apex.y = [-0.5, 0.6] }
)toml";
}

double limit_load(const std::string& bars) {
  return lambdas(run(roof(bars)).results[0], EventKind::limit_point).at(0);
}

// P = -2 N(e) y/L turns back where N'(e) y^2 L + N(e) = 0.
TEST(BarsWithALaw, GiveTheLimitLoadsOfATrussOfThisLaw) {
  EXPECT_NEAR(limit_load("law = { law = \"formula\", formula = \"u + 50*u^3\" }\n"), 0.1062877279,
              1e-10);
  EXPECT_NEAR(limit_load("law = { law = \"polynomial\", coefficients = [0, 1, 0, -20], falling = "
                         "true }\n"),
              0.0517850423, 1e-10);
}

TEST(BarsWithALaw, TakeTheirOwnLengthForTheLogarithm) {
  const double own = limit_load("law = { law = \"logarithmic\", stiffness = 1 }\n");
  EXPECT_NEAR(own, 0.0669912081, 1e-10);
  EXPECT_EQ(own, limit_load("law = { law = \"logarithmic\", stiffness = 1, length = "
                            "\"1/cos(30*deg)\" }\nfree = \"1/cos(30*deg)\"\n"));
}

// A law that is a straight line is no other bar.
TEST(BarsWithALaw, CountFromTheFreeLengthAsLinearOnesDo) {
  EXPECT_NEAR(limit_load("law = { law = \"linear\", stiffness = 3 }\nfree = 1.1\n"),
              limit_load("stiffness = 3\nfree = 1.1\n"), 1e-13);
  EXPECT_NEAR(limit_load("law = { law = \"linear\", stiffness = 3, free = 0.1 }\nfree = 1\n"),
              limit_load("stiffness = 3\nfree = 1.1\n"), 1e-13);
}

TEST(BarsWithALaw, TakeTheIndexOfARepetitionIntoTheirFormula) {
  const std::string repeated = roof("stiffness = 0\n", R"toml([[bar]]
repeat = { i = [0, 1] }
name = "c{i}"
from = "foot{i}"
to = "apex"
law = { law = "formula", formula = "(1 + i)*u" }
)toml");
  const std::string by_hand = roof("stiffness = 0\n", R"toml([[bar]]
name = "c0"
from = "foot0"
to = "apex"
law = { law = "formula", formula = "1*u" }
[[bar]]
name = "c1"
from = "foot1"
to = "apex"
law = { law = "formula", formula = "2*u" }
)toml");
  const auto loads = lambdas(run(repeated).results[0], EventKind::limit_point);
  EXPECT_FALSE(loads.empty());
  EXPECT_EQ(loads, lambdas(run(by_hand).results[0], EventKind::limit_point));
}

/// A bob between the ground, 1 below, and the ceiling, 1 above.
std::string bob(const std::string& members) {
  return R"toml([[node]]
name = "ground"
at = [0, -1]
fixed = true
[[node]]
name = "ceiling"
at = [0, 1]
fixed = true
[[node]]
name = "bob"
at = [0, 0]
fixed = ["x"]
[[bar]]
name = "tie"
from = "ceiling"
to = "bob"
stiffness = 3
)toml" + members +
         R"toml([[study]]
name = "pull"
body = "bob"
control = "load"
direction = [0, -1]
until = { bob.y = [-0.5, 0.2] }
)toml";
}

const std::string strut_and_cable = R"toml([[bar]]
name = "strut"
from = "ground"
to = "bob"
stiffness = 5
free = 0.9
compression_only = true
[[bar]]
name = "cable"
from = "ceiling"
to = "bob"
EA = 2.4
free = 1.2
tension_only = true
)toml";

// F(d) = 3 d + 5 [d - 0.1]^+ + 2 [d - 0.2]^+.
TEST(StrutsAndCables, ActOnOneSideOfTheirFreeLength) {
  const analysis::StudyResult result = run(bob(strut_and_cable)).results[0];
  ASSERT_TRUE(analysis::complete(result));
  EXPECT_THAT(lambdas(result, EventKind::switching),
              testing::UnorderedElementsAre(DoubleNear(0.3, 1e-12), DoubleNear(1.1, 1e-12)));
  for (std::size_t row = 0; row < result.branches[0].samples.size(); ++row) {
    const double d = -value(result, row, "bob.y");
    const double strut = 5 * std::max(d - 0.1, 0.0), cable = 2 * std::max(d - 0.2, 0.0);
    EXPECT_NEAR(value(result, row, "lambda"), 3 * d + strut + cable, 1e-11);
    EXPECT_NEAR(value(result, row, "strut.force"), -strut, 1e-11);
    EXPECT_NEAR(value(result, row, "cable.force"), cable, 1e-11);
    EXPECT_NEAR(value(result, row, "strut.length"), 1 - d, 1e-12);
  }
}

TEST(StrutsAndCables, AreOneSidedSpringsOfADistance) {
  const analysis::StudyResult bars = run(bob(strut_and_cable)).results[0];
  const analysis::StudyResult springs = run(bob(R"toml([[spring]]
name = "strut"
from_at = [0, -1]
to = "bob"
law = { law = "one_sided", stiffness = 5, from = 0.9, side = "below" }
[[spring]]
name = "cable"
from_at = [0, 1]
to = "bob"
law = { law = "one_sided", stiffness = "2.4/1.2", from = 1.2 }
)toml"))
                                            .results[0];
  ASSERT_EQ(bars.branches[0].samples.size(), springs.branches[0].samples.size());
  for (std::size_t row = 0; row < bars.branches[0].samples.size(); ++row)
    EXPECT_THAT(bars.branches[0].samples[row].values,
                testing::Pointwise(testing::NanSensitiveDoubleEq(),
                                   springs.branches[0].samples[row].values));
}

/// A slider on the line of a bar of free length 0.5, driven towards the bar's other end and past it.
analysis::StudyResult driven_past_the_end(const std::string& bar) {
  return run(R"toml([[node]]
name = "end"
at = [0, 0]
fixed = true
[[node]]
name = "slider"
at = [1, 0]
fixed = ["y"]
[[bar]]
name = "bar"
from = "end"
to = "slider"
)toml" + bar +
             R"toml([[study]]
name = "drive"
body = "slider"
control = "mixed"
direction = [-1, 0]
until = { slider.x = [-1, 2] }
)toml")
      .results[0];
}

// N = k (l - 0.5) pushes to the right before the end and to the left behind it: no curve leads from one to the other.
TEST(Bars, EndACurveThatWouldLeadThemThroughTheLengthZero) {
  for (const std::string bar :
       {"law = { law = \"linear\", stiffness = 2 }\nfree = 0.5\n", "stiffness = 2\nfree = 0.5\n"}) {
    const analysis::StudyResult result = driven_past_the_end(bar);
    EXPECT_FALSE(analysis::complete(result)) << bar;
    const analysis::Branch& branch = result.branches.at(0);
    EXPECT_THAT(branch.forward.reason, testing::HasSubstr("bar would be led through the length 0"));
    for (std::size_t row = 0; row < branch.samples.size(); ++row) {
      const double x = value(result, row, "slider.x");
      EXPECT_GT(x, 0);
      EXPECT_NEAR(value(result, row, "force"), -2 * (x - 0.5), 1e-12);
    }
  }
}

// The first critical load on the path from the start: nothing is claimed about what lies behind the end of the bar.
TEST(Bars, EndThePathOfAThresholdThatWouldLeadThemThroughTheLengthZero) {
  const analysis::StudyResult result = run(R"toml([parameters]
k = 2
[[node]]
name = "end"
at = [0, 0]
fixed = true
[[node]]
name = "slider"
at = [1, 0]
fixed = ["y"]
[[bar]]
name = "bar"
from = "end"
to = "slider"
stiffness = "k"
free = 0.5
[[study]]
name = "least"
kind = "threshold"
body = "slider"
control = "mixed"
direction = [-1, 0]
until = { slider.x = [-1, 2] }
threshold = { of = "limit_point", parameter = "k", range = [1, 3] }
)toml")
                                           .results[0];
  EXPECT_FALSE(analysis::complete(result));
}

// N = k l has no direction to lose.
TEST(Bars, WithoutAFreeLengthAreLedThroughTheLengthZero) {
  const analysis::StudyResult result = driven_past_the_end("stiffness = 2\nfree = 0\n");
  EXPECT_TRUE(analysis::complete(result));
  for (std::size_t row = 0; row < result.branches.at(0).samples.size(); ++row)
    EXPECT_NEAR(value(result, row, "force"), -2 * value(result, row, "slider.x"), 1e-12);
}

// As drawn the cable pulls with 0.6 and the tie holds against it.
TEST(StrutsAndCables, AreDrawnWithTheirPretension) {
  const analysis::StudyResult result = run(bob(R"toml([[bar]]
name = "cable"
from = "bob"
to = "ground"
stiffness = 2
pretension = 0.6
tension_only = true
)toml"))
                                           .results[0];
  const std::size_t start = result.branches[0].start_row;
  const double d = -value(result, start, "bob.y");  // 3 d = 0.6 - 2 d
  EXPECT_NEAR(d, 0.12, 1e-12);
  EXPECT_NEAR(value(result, start, "cable.force"), 0.36, 1e-12);
}

}  // namespace
}  // namespace springfold::io
