// Equilibria that fill lines, and singular ones that do not.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "case_runs.hpp"
#include "springfold/analysis/equilibrium_notes.hpp"

namespace springfold::io {
namespace {

using std::numbers::pi;

TEST(EquilibriumFamily, IsToldAsOne) {
  // Two bars of 1/2 with a hinge of stiffness 1 between them; the upper end is guided along y and pushed down
  // by 5. Folded by half a turn and whole ones, the end is on the base and the pair turns freely: a line of
  // equilibria of energy h^2 / 2 for each h. The others: straight up, straight down, and bent by h on both
  // sides with h = 5/2 sin(h/2).
  const Ran ran = run(R"toml(
[[body]]
name = "mid"
task_space = "planar"
pose = [0, 0.5, "90*deg"]
[[body]]
name = "tip"
task_space = "xy"
pose = [0, 1]
[[chain]]
name = "lower"
to = "mid"
elements = [{ joint = "revolute", axis = "z", name = "foot", initial = "90*deg" }, { rigid = [0.5, 0] }]
[[chain]]
name = "upper"
from = "mid"
to = "tip"
elements = [
  { joint = "revolute", axis = "z", name = "h", role = "preloaded", spring = { law = "linear", stiffness = 1 } },
  { rigid = [0.5, 0] }]
[[chain]]
name = "guide"
to = "tip"
elements = [{ joint = "prismatic", axis = "y", name = "s", initial = 1 }]
[[study]]
name = "all"
body = "tip"
kind = "equilibria"
load = [0, -5]
)toml");
  const auto& result = ran.of("all");
  ASSERT_TRUE(result.equilibria);
  std::vector<double> folded;
  std::size_t regular = 0;
  for (const auto& state : result.equilibria->list) {
    const auto at = [&](const std::string& name) {
      return state.sample.values[static_cast<std::size_t>(column(result, name))];
    };
    if (state.note.starts_with(analysis::family_note)) {
      const double h = at("upper.h");
      folded.push_back(h);
      EXPECT_NEAR(std::cos(h / 2), 0, 1e-6);
      EXPECT_NEAR(at("tip.y"), 0, 1e-6);
      EXPECT_NEAR(state.potential, h * h / 2, 1e-6);
      EXPECT_TRUE(std::isnan(at("index")));
    } else {
      ++regular;
      EXPECT_NEAR(std::abs(at("upper.h")), 2.5 * std::abs(std::sin(at("upper.h") / 2)), 1e-9);
    }
  }
  EXPECT_THAT(folded, testing::IsSupersetOf(
                          {testing::DoubleNear(pi, 1e-6), testing::DoubleNear(-pi, 1e-6)}));
  std::sort(folded.begin(), folded.end());
  for (std::size_t i = 1; i < folded.size(); ++i)
    EXPECT_GT(folded[i] - folded[i - 1], pi) << "each line once";
  EXPECT_EQ(regular, 4u);
}

TEST(EquilibriumFamily, IsNotWhatABranchPointIs) {
  // A bar of 1 on a hinge of stiffness 1 under a load of 1: just critical, and at rest upright only.
  const Ran ran = run(
      "[[body]]\nname = \"tip\"\ntask_space = \"xy\"\npose = [0, 1]\n[[chain]]\nname = "
      "\"bar\"\nelements = "
      "[{ joint = \"revolute\", axis = \"z\", name = \"q\", role = \"preloaded\", spring = { law = "
      "\"linear\", stiffness = 1 } }, { rigid = [0, 1] }]\n[[study]]\nname = \"all\"\nkind = "
      "\"equilibria\"\nload = [0, -1]\n");
  const auto& result = ran.of("all");
  ASSERT_TRUE(result.equilibria);
  ASSERT_EQ(result.equilibria->list.size(), 1u);
  EXPECT_FALSE(result.equilibria->list[0].note.starts_with(analysis::family_note));
  EXPECT_TRUE(std::isnan(
      result.equilibria->list[0].sample.values[static_cast<std::size_t>(column(result, "index"))]));
}

}  // namespace
}  // namespace springfold::io
