// Displacement that is prescribed where nothing can move is said to be that, with what helps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

std::string straight_links(const std::string& control, const std::string& pose) {
  return R"toml([[body]]
name = "tip"
task_space = "xy"
pose = )toml" +
         pose + R"toml(
[[chain]]
name = "c"
elements = [
  { joint = "revolute", axis = "z", name = "a", role = "preloaded", spring = { law = "linear", stiffness = 1.3 } },
  { rigid = [1, 0] },
  { joint = "revolute", axis = "z", name = "b", role = "preloaded", spring = { law = "linear", stiffness = 0.2 } },
  { rigid = [1, 0] },
]
[[study]]
name = "s"
control = ")toml" +
         control + "\"\ndirection = [-1, 0]\nuntil = { lambda = [-0.1, 1], c.a = [-1, 1] }\n";
}

TEST(StraightLinks, AreRigidAlongTheDrive) {
  const auto result = run(straight_links("mixed", "[2, 0]")).of("s");
  ASSERT_EQ(result.branches.size(), 1U);
  EXPECT_FALSE(complete(result));
  EXPECT_THAT(result.branches.front().forward.reason,
              testing::HasSubstr("what is driven is rigid here: forces alone can change"));
}

TEST(StraightLinks, BuckleUnderALoad) {
  const auto result = run(straight_links("load", "[2, 0]")).of("s");
  const auto found = lambdas(result, analysis::EventKind::branch_point);
  ASSERT_EQ(found.size(), 1U);
  // det([1.5, -0.2; -0.2, 0.2] - lambda 1) = 0
  EXPECT_NEAR(found.front(), 0.85 - std::sqrt(0.85 * 0.85 - 0.26), 1e-9);
}

}  // namespace
}  // namespace springfold::io
