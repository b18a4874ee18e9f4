// Load cycles under driven displacement, and loops of jumps to both sides.
#include <gmock/gmock.h>

#include <cmath>

#include "case_runs.hpp"
#include "springfold/analysis/snap.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;

/// A link on a preloaded hinge, upright, with its tip; then the study "press". @param study  its keys
std::string strut(const std::string& height, const std::string& law, const std::string& study) {
  return "[[body]]\nname = \"tip\"\ntask_space = \"planar\"\npose = [0, " + height +
         R"(, 0]
[[chain]]
name = "strut"
elements = [{ joint = "revolute", axis = "-z", name = "hinge", role = "preloaded", spring = { )" +
         law + " } }, { rigid = [0, " + height + R"(] }]
[[study]]
name = "press"
kind = "snap_through"
control = "load"
)" + study;
}

/// A body on a guide with a spring.
std::string guided(const std::string& pose, const std::string& axis, const std::string& initial,
                   const std::string& law) {
  return "[[body]]\nname = \"mass\"\ntask_space = \"xy\"\npose = " + pose +
         "\n[[chain]]\nname = \"guide\"\nelements = [{ joint = \"prismatic\", axis = \"" + axis +
         R"(", name = "way", role = "preloaded", initial = )" + initial + ", spring = { " + law +
         " } }]\n";
}

/// A guided mass with a spring of 1, between two oblique springs of 2 whose feet are 0.12 beside the guide.
TEST(DrivenCycle, HasTheWorkOfSpringsThatAreShortBesideTheMechanism) {
  const Ran ran = run(guided("[0, -0.8]", "y", "-0.4", "law = \"linear\", stiffness = 1") +
                      R"toml(
[[spring]]
name = "left"
from_at = [-0.12, 0]
to = "mass"
stiffness = 2
free = 0.9
[[spring]]
name = "right"
from_at = [0.12, 0]
to = "mass"
stiffness = 2
free = 0.9
[[study]]
name = "cycle"
kind = "load_cycle"
control = "mixed"
direction = [0, 1]
start = { solve = "pose" }
until = { mass.y = [-1.5, 1.5] }
cycle = { levels = [0.3, 0.8, 1.1] }
)toml");
  const auto& cycle = *ran.of("cycle").snap->cycle;
  const auto energy = [](double y) {
    const double u = std::hypot(0.12, y) - 0.9;
    return y * y / 2 + 2 * u * u;
  };
  const double y0 = cycle.steps.front().at.values[column(ran.of("cycle"), "mass.y")];
  const double change = energy(y0 + 1.1) - energy(y0);
  EXPECT_NEAR(cycle.energy_change, change, 1e-11);
  EXPECT_NEAR(cycle.area, change, 1e-11);
}

/// A column whose body stands 1e20 lengths beside it: nothing can be corrected there, so its branch is its start alone.
TEST(LoadCycle, OfACurveWithoutBranchesEndsAtItsStart) {
  const Ran ran = run(R"toml(
[[body]]
name = "tip"
task_space = "xy"
pose = [1e20, 1]
[[chain]]
name = "column"
elements = [
  { joint = "revolute", axis = "-z", name = "hinge", role = "preloaded", spring = { law = "linear", stiffness = 2 } },
  { rigid = [0, 1] },
]
[[chain]]
name = "spring"
elements = [
  { joint = "prismatic", axis = "x", name = "side", role = "virtual", stiffness = 1 },
  { joint = "prismatic", axis = "y", name = "guide", initial = 1 },
]
[[study]]
name = "press"
kind = "load_cycle"
control = "load"
direction = [0, -1]
until = { lambda = [0, 4], column.hinge = [-2, 2] }
cycle = { levels = [3.2, 2.8], times = 2 }
)toml");
  const analysis::StudyResult& press = ran.of("press");
  ASSERT_EQ(press.branches.size(), 1u);
  EXPECT_FALSE(press.branches[0].forward.complete);
  EXPECT_EQ(press.snap->cycle->end, analysis::LoadCycle::End::out_of_range);
  EXPECT_TRUE(press.snap->cycle->steps.empty());
}

/// A link turns freely about its end, without length: no curve is determined, and a search for jumps says so too.
TEST(Jumps, OfACurveThatNothingDeterminesAreNotSilentlyNone) {
  const Ran ran = run(strut("1", "law = \"linear\", stiffness = 2",
                            "direction = [0, -1, 0]\nuntil = { lambda = [0, 4] }\n") +
                      R"toml(
[[chain]]
name = "spring"
elements = [
  { joint = "prismatic", axis = "x", name = "side", role = "virtual", stiffness = 1 },
  { joint = "revolute", axis = "z", name = "idle" },
  { joint = "prismatic", axis = "y", name = "guide", initial = 1 },
  { joint = "revolute", axis = "z", name = "pin" },
  { joint = "revolute", axis = "z", name = "twin" },
]
)toml");
  const analysis::StudyResult& press = ran.of("press");
  ASSERT_EQ(press.branches.size(), 1u);
  EXPECT_FALSE(press.branches[0].forward.complete);
  EXPECT_NE(press.branches[0].forward.reason.find("no curve was found"), std::string::npos);
}

/// A strut whose hinge softens at 0.4 rad to both sides: it snaps from corners, to either side and back.
TEST(LoopsOfJumps, AreTheSameToBothSides) {
  const Ran ran = run(strut("1.3",
                            "law = \"piecewise_linear\", breakpoints = [-0.4, 0.4], "
                            "stiffnesses = [0.24, 0.8, 0.24]",
                            "direction = [0, -1, 0]\n"
                            "until = { lambda = [-0.12, 0.92], strut.hinge = [-3, 3] }\n"));
  const auto& jumps = ran.of("press").snap->jumps;
  ASSERT_GE(jumps.size(), 2u);
  int loops = 0;
  for (const auto& jump : jumps)
    if (std::isfinite(jump.loop)) {
      ++loops;
      EXPECT_NEAR(jump.loop, jumps.front().loop, 1e-9);
    }
  EXPECT_EQ(loops, static_cast<int>(jumps.size()));
}

/// Contact with the power 1.5 (Hertz) that carries alone, driven out: its stiffness ends as a root does.
TEST(PowerContact, IsDrivenOutOfTouchWhateverItsPower) {
  for (const char* power : {"1.1", "1.5", "1.9"}) {
    const std::string law = "law = \"power\", force = 1, from = 0.5, exponent = ";
    const Ran ran = run(guided("[1, 0]", "x", "1", law + power) + R"toml(
[[study]]
name = "out"
control = "mixed"
direction = [-1, 0]
start = { solve = "wrench" }
until = { lambda = [0, 1] }
)toml");
    const auto& result = ran.of("out");
    EXPECT_TRUE(complete(result)) << power;
    EXPECT_THAT(lambdas(result, EventKind::switching),
                testing::ElementsAre(testing::DoubleNear(0.5, 1e-10)));
    EXPECT_THAT(lambdas(result, EventKind::unresolved), testing::IsEmpty()) << power;
  }
}

TEST(RefusedJumps, MakeARunIncomplete) {
  const Ran ran = run(strut("1", "law = \"linear\", stiffness = 1",
                            "until = { lambda = [0, 0.5] }\n"
                            "loads = [{ force = [0, -1], follows = true, scale = \"lambda\" }]\n"));
  EXPECT_FALSE(ran.of("press").snap->refusals.empty());
  EXPECT_FALSE(complete(ran.of("press")));
}

}  // namespace
}  // namespace springfold::io
