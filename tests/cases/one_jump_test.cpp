// One way down from a critical state is one jump, by however many pieces and modes it is found.
#include <gmock/gmock.h>

#include "case_runs.hpp"
#include "small_structures.hpp"
#include "springfold/analysis/snap.hpp"

namespace springfold::io {
namespace {

/// Two bars to an apex at height 3, and two stops at rest on the axis that is never left: it snaps from LP1 down to the
/// mirror image of LP1's height, and back from LP2.
TEST(WayDown, BesideStopsAtRestIsOneJump) {
  const std::string stop = R"(
[[spring]]
name = "NAME"
shape = "line"
of = ["apex", { on = "base", at = [0, 0] }, { on = "base", at = [0, 1] }]
law = { law = "one_sided", stiffness = 2, from = 0, side = "NAME" }
)";
  std::string above = stop, below = stop;
  for (std::string* text : {&above, &below})
    for (std::size_t at; (at = text->find("NAME")) != std::string::npos;)
      text->replace(at, 4, text == &above ? "above" : "below");
  const std::string rest = supports_and_apex("apex", "3") + R"([[bar]]
from = "l"
to = "apex"
stiffness = 1
[[bar]]
from = "r"
to = "apex"
stiffness = 1
[[study]]
name = "press"
kind = "snap_through"
body = "apex"
control = "load"
direction = [0, -1]
until = { apex.y = [-6, 6], apex.x = [-3, 3] }
)";
  const auto result = run(rest.substr(0, rest.find("[[study]]")) + above + below +
                          rest.substr(rest.find("[[study]]")))
                          .of("press");
  ASSERT_TRUE(result.snap);
  std::vector<int> loading;
  for (const auto& jump : result.snap->jumps) loading.push_back(jump.loading);
  EXPECT_THAT(loading, testing::UnorderedElementsAre(1, -1));
}

/// A chain of two links whose second spring gives way at 0.53: from that corner two pieces show one way down.
TEST(WayDown, FromACornerWithTwoFreeMotionsIsOneJump) {
  const auto result = run(R"([[body]]
name = "p"
task_space = "xy"
pose = [1.92, 0.36]
[[chain]]
name = "c"
elements = [
  { joint = "revolute", axis = "z", name = "a", role = "preloaded", initial = -0.03, spring = { law = "stops", stiffness = 0.5, stop_stiffness = 2, low = -0.42, high = 0.28, free = -0.02 } },
  { rigid = [1, 0] },
  { joint = "revolute", axis = "z", name = "b", role = "preloaded", initial = 0.43, spring = { law = "piecewise_linear", breakpoints = [0.23, 0.53], stiffnesses = [2, -1, 4], free = 0.43, falling = true } },
  { rigid = [1, 0] },
]
[[study]]
name = "press"
kind = "snap_through"
control = "load"
direction = [-0.8047, -0.5936]
until = { c.a = [-1.4, 1.4], c.b = [-2.5, 2.5], lambda = [-40, 40] }
branches = { depth = 0 }
)")
                          .of("press");
  ASSERT_TRUE(result.snap);
  std::vector<std::string> from;
  for (const auto& jump : result.snap->jumps) from.push_back(jump.from);
  EXPECT_THAT(from, testing::UnorderedElementsAre("CL1", "CL2"));
}

/// A bar on a hinge that is 1e-7 of its cable: from LP1 it falls back onto the taut cable, at 0.4089 to the right. What
/// rounding hides of so small energies is told as open: that there is no stable state would be wrong.
TEST(WayDown, ThatEndsNowhereIsNotWhereNoStableStateIs) {
  const auto result = run(R"([[body]]
name = "tip"
task_space = "xy"
pose = [0, 1]
[[chain]]
name = "bar"
elements = [
  { joint = "revolute", axis = "z", name = "h", role = "preloaded", spring = { law = "linear", stiffness = 1e-6, free = 0.05 } },
  { rigid = [0, 1] },
]
[[spring]]
name = "taut"
from_at = [1, 0]
to = "tip"
law = { law = "one_sided", stiffness = 10, from = 1.0873101797301075 }
[[spring]]
name = "slack"
from_at = [3, 0.3]
to = "tip"
law = { law = "one_sided", stiffness = 100, from = 3.4625508306095973 }
[[study]]
name = "press"
kind = "snap_through"
control = "load"
direction = [0, -1]
until = { lambda = [-2e-6, 5e-6], bar.h = [-2.5, 2.5] }
)")
                          .of("press");
  ASSERT_TRUE(result.snap);
  ASSERT_EQ(result.snap->jumps.size(), 2u);
  const analysis::Jump& back = result.snap->jumps[1];
  EXPECT_EQ(back.from, "LP1");
  const bool is_told = !result.doubts.empty();
  const bool lands =
      !back.landing.values.empty() && back.verdict == analysis::SnapVerdict::unambiguous;
  EXPECT_TRUE(is_told || lands) << analysis::to_string(back.verdict);
}

/// Two parallel bars at rest carry a plate that sways without a force, and above zero load falls to either side: at
/// zero load all its sways are in balance, and where it would go is not known. The load of the branch point is known to
/// 1e-10, and what force that makes along the sway is rounding, whichever way everything is turned.
TEST(WayDown, FromAStateWithoutForcesIsToldAsFlatWhateverTheOrientation) {
  for (const char* turn : {"0", "0.3", "0.7", "1.1", "2.2", "-0.9"}) {
    std::string text = "[parameters]\nturn = " + std::string(turn) + R"toml(
[[body]]
name = "plate"
task_space = "planar"
pose = ["-sin(turn)", "cos(turn)", "turn"]
)toml";
    for (const std::string side : {"-", ""})
      text += "[[chain]]\nname = \"leg" + std::string(side.empty() ? "r" : "l") +
              "\"\nfrom_at = [\"" + side + "0.5*cos(turn)\", \"" + side +
              "0.5*sin(turn)\"]\nto_at = [" + side + R"toml(0.5, 0]
elements = [
  { joint = "revolute", axis = "z", name = "foot", initial = "pi/2 + turn" },
  { joint = "prismatic", axis = "x", name = "bar", role = "virtual", stiffness = 1 },
  { rigid = [1, 0] },
  { joint = "revolute", axis = "z", name = "head", initial = "-pi/2" },
]
)toml";
    const auto result = run(text + R"toml([[study]]
name = "press"
kind = "snap_through"
control = "load"
direction = ["sin(turn)", "-cos(turn)", 0]
until = { lambda = [-0.2, 0.2] }
)toml")
                            .of("press");
    ASSERT_TRUE(result.snap);
    EXPECT_TRUE(result.snap->jumps.empty()) << turn;
    EXPECT_THAT(result.doubts, testing::Contains(testing::HasSubstr("the energy is flat there")))
        << turn;
  }
}

}  // namespace
}  // namespace springfold::io
