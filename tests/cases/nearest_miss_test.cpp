// What cannot be met: the nearest miss is told in the terms of what is wanted.
#include <gtest/gtest.h>

#include <cmath>

#include "case_runs.hpp"
#include "small_structures.hpp"
#include "springfold/analysis/design.hpp"

namespace springfold::io {
namespace {

TEST(NearestMiss, OfACriticalLoadIsTheLargestOneWithinTheBounds) {
  // A truss of height h on the half span 1, two bars of stiffness k: P = 2 k ((1 + h^2)^(1/3) - 1)^(3/2) grows with
  // both. A truss that is nearly flat has next to no limit point, but next to no load either.
  const auto result = run(R"toml(
[parameters]
h = 0.5
k = 1
)toml" + supports_and_apex("t", R"("h")") +
                          R"toml(fixed = ["x"]
[[bar]]
from = "l"
to = "t"
stiffness = "k"
[[bar]]
from = "r"
to = "t"
stiffness = "k"
[[study]]
name = "d"
kind = "design"
control = "load"
direction = [0, -1]
until = { t.y = ["-1.2*h", "1.2*h"] }
[study.design]
parameters = { h = [0.2, 0.55], k = [0.5, 1.2] }
critical_load = { at_least = 0.08 }
)toml")
                          .of("d");
  ASSERT_TRUE(result.design);
  EXPECT_EQ(result.design->status, analysis::DesignStatus::cannot_be_met);
  EXPECT_NEAR(result.design->parameters[0].after, 0.55, 1e-9);
  EXPECT_NEAR(result.design->parameters[1].after, 1.2, 1e-9);
  EXPECT_NEAR(result.design->requirements.front().after,
              2 * 1.2 * std::pow(std::cbrt(1 + 0.55 * 0.55) - 1, 1.5), 1e-9);
}

}  // namespace
}  // namespace springfold::io
