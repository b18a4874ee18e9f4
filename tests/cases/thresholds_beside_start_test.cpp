// A bar of length 1 on a torsion spring under a load along it, and a threshold of the spring nearer to where the bar
// stands than can be told from it: it stands upon it, at the same place, and buckles at the stiffness of either side.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;

std::string bar(const std::string& law) {
  return R"toml(
[[body]]
name = "tip"
task_space = "xy"
pose = [0, 1]
[[chain]]
name = "bar"
elements = [
  { joint = "revolute", axis = "z", name = "h", role = "preloaded", spring = )toml" +
         law + R"toml( },
  { rigid = [0, 1] },
]
[[study]]
name = "press"
control = "load"
direction = [0, -1]
until = { lambda = [-0.2, 5], bar.h = [-2.5, 2.5] }
branches = { depth = 1 }
)toml";
}

struct Beside {
  std::string law{};
  std::vector<double> loads{};  ///< rising
};

TEST(ThresholdsBesideTheStart, MoveNeitherItNorTheLoadsAtWhichBranchesLeave) {
  const std::vector<Beside> all{
      {"{ law = \"piecewise_linear\", breakpoints = [2e-12], stiffnesses = [2, 0.5] }", {0.5, 2}},
      {"{ law = \"piecewise_linear\", breakpoints = [-3e-11], stiffnesses = [2, 0.5] }", {0.5, 2}},
      {"{ law = \"piecewise_linear\", breakpoints = [-0.3, 4e-13], stiffnesses = [3, 2, 4] }",
       {2, 4}},
      {"{ law = \"stops\", stiffness = 0.4, stop_stiffness = 0.2, low = -1e-11, high = 0.3 }",
       {0.4, 0.6}}};
  for (const auto& [law, loads] : all) {
    SCOPED_TRACE(law);
    const auto result = run(bar(law)).of("press");
    EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
    const std::size_t start = result.branches.at(0).start_row;
    EXPECT_EQ(value(result, start, "tip.x"), 0);
    std::vector<double> found = lambdas(result, EventKind::branching_kink);
    std::ranges::sort(found);
    ASSERT_EQ(found.size(), loads.size());
    for (std::size_t i = 0; i < loads.size(); ++i) EXPECT_NEAR(found[i], loads[i], 1e-10);
    EXPECT_EQ(result.branches.size(), 3u);
  }
}

/// Two bars at 45 degrees to the tip, that on the left pressed by 1e-12 of its length and softer there, that on the
/// right only pulling. Leaning to the right the tip is held by 0.5 + 3 / 2, to the left by 0.5 + 3 / 2 + 0.2 / 2.
TEST(ThresholdsBesideTheStart, OfBarsThatAreFreeThereAreMadeFreeInTheState) {
  std::string text = bar("{ law = \"linear\", stiffness = 0.5 }");
  const std::string link = "{ rigid = [0, 1] },", wide = "bar.h = [-2.5, 2.5]";
  text.replace(text.find(wide), wide.size(), "bar.h = [-1, 1]");  // before it meets their feet
  text.insert(text.find(link) + link.size(), "\n  { point = \"top\" },");
  text.insert(text.find("[[study]]"), R"toml([[spring]]
name = "left"
from_at = [-1, 0]
to = "bar.top"
law = { law = "piecewise_linear", breakpoints = ["sqrt(2) + 1e-12"], stiffnesses = [0.2, 3], free = "sqrt(2) + 1e-12" }
[[spring]]
name = "right"
from_at = [1, 0]
to = "bar.top"
law = { law = "one_sided", stiffness = 3, from = "sqrt(2)" }
)toml");
  const auto result = run(text).of("press");
  EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
  const std::vector<double> found = lambdas(result, EventKind::branching_kink);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0], 2, 1e-10);
  EXPECT_NEAR(found[1], 2.1, 1e-10);
  EXPECT_EQ(result.branches.size(), 3u);
}

/// A slide pressed against a stop by 0.04 stands 4e-8 within it, which is nothing in its length of 1000 but counts
/// beside a spring of 0.01: pulled by 0.5 it has left the stop, by (0.5 - 0.04) / 0.01.
TEST(ThresholdsBesideTheStart, KeepTheForceThatPressesAgainstAStiffStop) {
  const auto result = run(R"toml(
[[body]]
name = "t"
task_space = "xy"
pose = [1000, 0]
[[chain]]
name = "c"
elements = [ { joint = "prismatic", axis = "x", name = "x", initial = 1000, role = "preloaded", spring = { law = "piecewise_linear", breakpoints = [1000], stiffnesses = [1e6, 0.01], free = 1000 } } ]
[[study]]
name = "pull"
control = "load"
direction = [1, 0]
load = [-0.04, 0]
until = { lambda = [0, 0.5] }
)toml")
                          .of("pull");
  const auto& rows = result.branches.at(0).samples;
  ASSERT_FALSE(rows.empty());
  EXPECT_NEAR(value(result, rows.size() - 1, "lambda"), 0.5, 1e-12);
  EXPECT_NEAR(value(result, rows.size() - 1, "t.x"), 1046, 1e-6);
}

/// The torque is 0.7 there, and pushes the tip across: the load that holds it keeps its place, too.
TEST(ThresholdsBesideTheStart, LeaveThePreloadAsItIs) {
  const std::string held = bar(
      R"({ law = "piecewise_linear", breakpoints = [1e-12], stiffnesses = [2, 0.5], free = -0.35 })");
  std::string text = held;
  text.insert(text.find("until"), "load = [-0.7, 0]\n");
  const auto result = run(text).of("press");
  EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
  EXPECT_NEAR(value(result, result.branches.at(0).start_row, "tip.x"), 0, 1e-15);
  EXPECT_NEAR(value(result, result.branches.at(0).start_row, "energy"), 0.5 * 2 * 0.35 * 0.35,
              1e-11);
}

}  // namespace
}  // namespace springfold::io
