// A stop just behind the limit point of a slider: which of the two is told, down to the smallest distance.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

/// P(q) = q^3 - 3 a q + k max(0, q - g), with P(-3) taken off; it turns at q = -sqrt(a) = -1 unless g lies before that.
std::string slider_with_stop(const std::string& g, const std::string& study) {
  return R"toml(
[parameters]
a = 1
k = 4
g = ")toml" +
         g + R"toml("
[[body]]
name = "n"
task_space = "xy"
pose = [-3, 0]
[[chain]]
name = "c"
elements = [{ joint = "prismatic", axis = "x", name = "q", role = "preloaded", initial = -3, spring = { law = "polynomial", coefficients = [0, "-3*a", 0, 1], falling = true } }]
[[spring]]
name = "stop"
from_at = [-10, 0]
to = "n"
law = { law = "one_sided", stiffness = "k", from = "10 + g" }
[[study]]
name = "s"
control = "load"
direction = [1, 0]
load = ["-27 + 9*a", 0]
start = { pose = [-3, 0] }
until = { n.x = [-3.2, 3] }
)toml" + study;
}

TEST(FoldAtStop, TheGapAtWhichBucklingEndsIsConfirmedByTracingBesideIt) {
  const auto result =
      run(slider_with_stop("0.5",
                           "kind = \"threshold\"\nthreshold = { of = \"limit_point\", parameter = "
                           "\"g\", range = [-2, 0.5], value = \"largest\" }\n"))
          .of("s");
  ASSERT_TRUE(result.threshold && result.threshold->found);
  EXPECT_NEAR(result.threshold->value, -1, 1e-9);
  EXPECT_TRUE(result.threshold->verified);
  EXPECT_TRUE(result.doubts.empty());
}

TEST(FoldAtStop, ALoadThatFallsAndRisesAgainHasBothTurnsOrNone) {
  using analysis::EventKind;
  for (const double gap : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
    SCOPED_TRACE(gap);
    const auto result =
        run(slider_with_stop("-1 + " + std::to_string(gap * 1e9) + "e-9", "")).of("s");
    const auto turns = lambdas(result, EventKind::limit_point);
    EXPECT_EQ(lambdas(result, EventKind::corner_limit_point).size(), turns.size());
    EXPECT_EQ(turns.size(), gap >= 1e-6 ? 1U : turns.size());
  }
}

}  // namespace
}  // namespace springfold::io
