// Designs whose requirements leave next to no room.
#include <gtest/gtest.h>

#include <string>

#include "case_runs.hpp"
#include "springfold/analysis/design.hpp"

namespace springfold::io {
namespace {

TEST(NarrowDesign, PassesPointsThatOneDesignAlonePassesHoweverNarrowTheTolerance) {
  // c1 x + c2 x^2 + c3 x^3 through (0.5, 0.3), (1, 0.5), (1.5, 1.4): c1 = 37/30, c2 = -9/5, c3 = 16/15.
  for (const std::string tolerance : {"1e-3", "1e-5", "1e-7", "1e-9"}) {
    SCOPED_TRACE(tolerance);
    const auto result = run(R"toml(
[parameters]
c1 = 1
c2 = -1.2
c3 = 0.4
[[body]]
name = "n"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "c"
elements = [{ joint = "prismatic", axis = "x", name = "q", role = "preloaded", spring = { law = "polynomial", coefficients = [0, "c1", "c2", "c3"], falling = true } }]
[[study]]
name = "s"
kind = "design"
control = "mixed"
direction = [1, 0]
until = { deflection = [0, 2] }
design = { parameters = { c1 = [0.1, 5], c2 = [-3, 1], c3 = [-1, 3] }, curve = { points = [[0.5, 0.3], [1, 0.5], [1.5, 1.4]], tolerance = )toml" +
                            tolerance + " } }\n")
                            .of("s");
    ASSERT_TRUE(result.design);
    EXPECT_EQ(result.design->status, analysis::DesignStatus::met) << result.design->message;
    const double near = 50 * std::stod(tolerance) + 1e-9;
    EXPECT_NEAR(result.design->parameters[0].after, 37 / 30.0, near);
    EXPECT_NEAR(result.design->parameters[1].after, -1.8, near);
    EXPECT_NEAR(result.design->parameters[2].after, 16 / 15.0, near);
  }
}

}  // namespace
}  // namespace springfold::io
