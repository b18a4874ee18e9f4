// Thresholds and first critical loads of points that the path from the start leaves, or that cannot be followed
// everywhere.
#include <gmock/gmock.h>

#include <cmath>

#include "case_runs.hpp"
#include "small_structures.hpp"

namespace springfold::io {
namespace {

using testing::HasSubstr;

TEST(OffThePath, AThresholdIsWhereThePathNoLongerComesToThePointThatIsFollowed) {
  // A truss whose bars have their free lengths at the height 0.3 is pulled sideways. With a pull a little downwards the
  // apex snaps through; with one a little upwards it does not; the limit point goes on to the mirror image of the path.
  const auto result = run(R"toml(
[parameters]
psi = -0.2
)toml" + supports_and_apex("apex", "0.3") +
                          R"toml([[bar]]
from = "l"
to = "apex"
stiffness = 1
free = "sqrt(1 + 0.3^2)"
[[bar]]
from = "r"
to = "apex"
stiffness = 0.2
free = "sqrt(1 + 0.3^2)"
[[study]]
name = "s"
kind = "threshold"
body = "apex"
control = "load"
direction = ["cos(psi)", "sin(psi)"]
until = { lambda = [-0.01, 0.5] }
threshold = { of = "loss_of_stability", parameter = "psi", range = [-0.6, 0.6] }
)toml")
                          .of("s");
  ASSERT_TRUE(result.threshold && result.threshold->found);
  EXPECT_NEAR(result.threshold->value, 0, 1e-9);
  EXPECT_TRUE(result.threshold->verified);
  EXPECT_THAT(result.threshold->message, HasSubstr("no longer comes to it"));
  EXPECT_TRUE(complete(result));
}

TEST(OffThePath, AThresholdIsACrossingJustBeforeTheEndOfThePointThatIsFollowed) {
  // An Orthoglide with one-sided springs in its knees: the corner goes on for 1.2e-4 behind the crossing at which the
  // path leaves it, to where it touches the surface of its spring. The crossing is one of F = 0 and adj(H) d = 0 on the
  // piece without springs, H the stiffness and d the direction of the load, solved in 25 digits.
  const auto result = run(R"toml(
[parameters]
psi = 1.3962
[[body]]
name = "tool"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "leg_x"
elements = [
  { joint = "prismatic", axis = "x", name = "drive", role = "actuated", value = 0.8897, stiffness = 0.838 },
  { joint = "revolute", axis = "-z", name = "knee", role = "preloaded", spring = { law = "one_sided", stiffness = 0.091805201865328, from = 0.3716 } },
  { rigid = [-0.8897, 0] },
]
[[chain]]
name = "leg_y"
elements = [
  { joint = "prismatic", axis = "y", name = "drive", role = "actuated", value = 0.8897, stiffness = 0.9576 },
  { joint = "revolute", axis = "z", name = "knee", role = "preloaded", spring = { law = "one_sided", stiffness = 0.057908917072566, from = 0.099 } },
  { rigid = [0, -0.8897] },
]
[[study]]
name = "s"
kind = "threshold"
control = "load"
direction = ["cos(psi)", "sin(psi)"]
start = { pose = [0.04750998, 0.17811794], solve = "actuators" }
until = { deflection = [-0.05, 0.536], lambda = [-0.1, 4] }
threshold = { of = "loss_of_stability", parameter = "psi", range = [-0.3, 2.2], value = "smallest" }
)toml")
                          .of("s");
  ASSERT_TRUE(result.threshold && result.threshold->found);
  EXPECT_NEAR(result.threshold->value, 1.884057643126777, 1e-9);
  EXPECT_TRUE(result.threshold->verified);
  EXPECT_TRUE(complete(result));
}

TEST(OffThePath, LossesUnderDeadLoadThatNoCurveFollowsAreSaid) {
  // Four springs hold a driven point sideways: it would leave its axis under dead load, though the force never turns.
  std::string text =
      "[parameters]\nk = 1\n[[body]]\nname = \"tip\"\ntask_space = \"xyz\"\npose = [0, 0, 1]\n";
  for (const char* at : {"[1, 0, 0]", "[0, 1, 0]", "[-1, 0, 0]", "[0, -1, 0]"})
    text += std::string{"[[spring]]\nname = \"s"} + std::to_string(text.size()) +
            "\"\nfrom_at = " + at + "\nto = \"tip\"\nstiffness = 1\nfree = 1\n";
  const auto result =
      run(text +
          "[[spring]]\nname = \"c\"\nfrom_at = [0, 0, 2]\nto = \"tip\"\nstiffness = \"k\"\nfree = "
          "0.5\n[[study]]\nname = \"s\"\nkind = \"threshold\"\ncontrol = \"pose\"\ndirection = [0, "
          "0, "
          "1]\nstart = { solve = \"wrench\" }\nuntil = { deflection = [0, 0.9] }\nthreshold = { of "
          "= "
          "\"loss_of_stability\", parameter = \"k\", range = [0.95, 3], index = \"dead_load\" }\n")
          .of("s");
  ASSERT_TRUE(result.threshold);
  EXPECT_FALSE(result.threshold->found);
  ASSERT_FALSE(result.doubts.empty());
  EXPECT_THAT(result.doubts.front(), HasSubstr("SC1"));
}

TEST(OffThePath, FirstCriticalLoadsGoOnOverAKinkOfTheCase) {
  // A guided truss over a post that is stiffer beyond the length b. Where its free length f passes b the law itself has
  // a kink in f: below the force is k1 (u - f), above k2 (b - f) + k1 (u - b).
  const auto result = run(R"toml(
[parameters]
f = 0.7
[[node]]
name = "left"
at = [-1, 0]
fixed = true
[[node]]
name = "foot"
at = [0, -0.2]
fixed = true
[[node]]
name = "apex"
at = [0, 0.5]
fixed = ["x"]
[[spring]]
name = "bar"
from = "base"
from_at = [-1, 0]
to = "apex"
law = { law = "linear", stiffness = 2, free = "sqrt(1.25)" }
[[spring]]
name = "post"
from = "base"
from_at = [0, -0.2]
to = "apex"
law = { law = "piecewise_linear", breakpoints = [0.78], stiffnesses = [0.05, 0.15], free = "f" }
[[study]]
name = "s"
kind = "critical_load"
body = "apex"
control = "load"
direction = [0, -1]
until = { lambda = [-0.01, 1], apex.y = [-0.7, 0.7] }
critical_load = { of = "loss_of_stability", parameter = "f", range = [0.5, 0.8], values = 21 }
)toml")
                          .of("s");
  const double L0 = std::sqrt(1.25), L = std::cbrt(L0 / 1.025), y = std::sqrt(L * L - 1);
  EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
  ASSERT_EQ(result.branches.size(), 1U);
  for (const analysis::Branch& branch : result.branches)
    for (const auto& sample : branch.samples) {
      const double f = sample.values.back(), u = y + 0.2;
      const double post = f < 0.78 ? 0.05 * (u - f) : 0.15 * (0.78 - f) + 0.05 * (u - 0.78);
      EXPECT_NEAR(sample.values[1], 2 * (L0 / L - 1) * y - post, 1e-10) << f;
    }
  EXPECT_NEAR(result.branches[0].samples.front().values.back(), 0.5, 1e-12);
  EXPECT_NEAR(result.branches[0].samples.back().values.back(), 0.8, 1e-12);
}

}  // namespace
}  // namespace springfold::io
