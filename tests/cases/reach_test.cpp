// Where a leg is stretched out a driven displacement has an end that no limit of the case names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "case_runs.hpp"
#include "cases/number_text.hpp"
#include "small_structures.hpp"

namespace springfold::io {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A 3-RRR platform: feet at the radius 0.5, plate of radius 0.12, links of 0.3, stiff drives and soft flexures.
std::string platform() {
  const double degree = std::numbers::pi / 180, reach = 0.5 - 0.12;
  const double bend = std::acos(reach / 0.6);  // of both links against the line from foot to plate
  std::string text = "[[body]]\nname = \"top\"\ntask_space = \"planar\"\npose = [0, 0, 0]\n";
  for (int leg = 0; leg < 3; ++leg) {
    const double at = (90 + 120 * leg) * degree, inwards = at + std::numbers::pi;
    const std::string flexure =
        ", role = \"preloaded\", spring = { law = \"linear\", stiffness = 4, origin = \"start\" }, "
        "initial = ";
    text += "[[chain]]\nname = \"leg" + std::to_string(leg) + "\"\nfrom_at = [" +
            number(0.5 * std::cos(at)) + ", " + number(0.5 * std::sin(at)) + "]\nto_at = [" +
            number(0.12 * std::cos(at)) + ", " + number(0.12 * std::sin(at)) +
            "]\nelements = [{ joint = \"revolute\", axis = \"z\", role = \"actuated\", value = " +
            number(inwards + bend) + ", stiffness = 20000 }, { rigid = [0.3, 0] }, " +
            "{ joint = \"revolute\", axis = \"z\"" + flexure + number(-2 * bend) +
            " }, { rigid = [0.3, 0] }, { joint = \"revolute\", axis = \"z\"" + flexure +
            number(bend - inwards) + " }]\n";
  }
  return text;
}

TEST(Reach, OfAStretchedLegEndsADrivenCurve) {
  // Leg 0 is straight when the plate has gone down by 0.6 - 0.38; its force grows without bound there.
  const auto result =
      run(platform() +
          "[[study]]\nname = \"push\"\ncontrol = \"mixed\"\ndirection = [0, -1, 0]\n"
          "until = { lambda = [-0.3, 0.3] }\n")
          .of("push");
  EXPECT_TRUE(complete(result));
  const auto& branch = result.branches.front();
  EXPECT_EQ(branch.forward.reason.rfind("end of the reach: chain leg0 is stretched out", 0), 0u)
      << branch.forward.reason;
  EXPECT_NEAR(branch.samples.back().values[1], 0.22, 1e-9);
}

/// A crank-rocker of two bodies, its crank on a torsion spring; the joint at the end of the rocker is driven upwards.
const std::string crank_rocker =
    four_bar(
        {.at_crank = 0.5,
         .at_rocker = 1.548215494177245,
         .at_coupler = 0.7154649010624505,
         .crank_spring =
             ", role = \"preloaded\", spring = { law = \"linear\", stiffness = 1, free = 0.5 }"}) +
    R"(
[[study]]
name = "p"
body = "Q"
control = "mixed"
direction = [0, 1]
until = { crank.a = [-1.0, 2.0] }
)";

TEST(Reach, OfACrankRockerEndsAtBothDeadCentresWhereTheForceHasNoBound) {
  const auto result = run(crank_rocker).of("p");
  EXPECT_TRUE(complete(result));
  const auto& branch = result.branches.front();
  for (const auto& stop : {branch.backward, branch.forward})
    EXPECT_EQ(stop.reason.rfind("end of the reach: ", 0), 0u) << stop.reason;
  // The rocker stands upright; crank and coupler lie on one line, 1.3 from foot to Q.
  const double start = 0.7997960510655668, x = (1.69 - 0.64 + 1) / 2;
  EXPECT_NEAR(branch.samples.back().values[1], 0.8 - start, 1e-8);
  EXPECT_NEAR(branch.samples.front().values[1], std::sqrt(1.69 - x * x) - start, 1e-8);
}

/// The same kind begun where it is soft: its unit of force is small, and steps in the coordinates pass the dead centre.
const std::string soft_crank_rocker =
    four_bar(
        {.at_crank = 2.2,
         .at_rocker = 1.9661186360622833,
         .at_coupler = 0.5186971407396499,
         .crank_spring =
             ", role = \"preloaded\", spring = { law = \"linear\", stiffness = 1, free = 2.2 }"}) +
    R"(
[[study]]
name = "p"
body = "Q"
control = "mixed"
direction = [6.123233995736766e-17, 1.0]
until = { crank.a = [0.7000000000000002, 3.7] }
)";

TEST(Reach, EndsWhereACurveWouldGoOnThroughAnInfiniteForce) {
  const auto result = run(soft_crank_rocker).of("p");
  EXPECT_TRUE(complete(result));
  const auto& branch = result.branches.front();
  EXPECT_EQ(branch.forward.reason.rfind("end of the reach: ", 0), 0u) << branch.forward.reason;
  EXPECT_NEAR(branch.samples.back().values[1], 0.8 - 0.7382979913423184, 1e-9);
  for (std::size_t row = branch.start_row + 1; row < branch.samples.size(); ++row)
    EXPECT_GT(value(result, row, "force"), 0);
}

/// A parallelogram on torsion springs 0.9 and 0.6 at its feet and 0.2 at one end of the coupler: 1.7 s = 0.9 f + 0.98
/// with the angle s of both cranks and the free angle f of the first spring. Flat, at s = 0 and pi, the cranks cannot
/// pass forces to each other: those along them grow as 1/sin(s).
const std::string parallelogram = R"toml(
[parameters]
f = 1
[[body]]
name = "c"
task_space = "planar"
pose = ["0.5*cos(1.1)", "0.5*sin(1.1)", 0]
[[chain]]
name = "l"
elements = [
  { joint = "revolute", axis = "z", name = "s", role = "preloaded", initial = 1.1, spring = { law = "linear", stiffness = 0.9, free = "f" } },
  { rigid = [0.5, 0] }, { joint = "revolute", axis = "z", initial = -1.1 } ]
[[chain]]
name = "r"
from_at = [1.2, 0]
to_at = [1.2, 0]
elements = [
  { joint = "revolute", axis = "z", role = "preloaded", initial = 1.1, spring = { law = "linear", stiffness = 0.6, free = 1.3 } },
  { rigid = [0.5, 0] },
  { joint = "revolute", axis = "z", role = "preloaded", initial = -1.1, spring = { law = "linear", stiffness = 0.2, free = -1 } } ]
[[study]]
name = "wind"
control = "parameter"
parameter = "f"
until = { lambda = [-5, 9] }
)toml";

TEST(Reach, OfAParallelogramEndsBesideItsFlatPositionsInRowsThatAreEquilibria) {
  const auto result = run(parallelogram).of("wind");
  EXPECT_FALSE(complete(result));
  const auto& branch = result.branches.front();
  for (const auto& stop : {branch.backward, branch.forward})
    EXPECT_EQ(stop.reason.rfind("infinite forces: the closures of chains l, r lose rank", 0), 0u)
        << stop.reason;
  const std::size_t rows = branch.samples.size();
  for (std::size_t row = 0; row < rows; ++row) {
    const double s = value(result, row, "l.s");
    const double rounded = 1e-11 * std::abs(value(result, row, "l.Fx"));
    EXPECT_NEAR(1.7 * s, 0.9 * value(result, row, "lambda") + 0.98, 1e-11 + rounded) << row;
    EXPECT_GT(s, 0) << row;
    EXPECT_LT(s, std::numbers::pi) << row;
  }
  EXPECT_NEAR(value(result, 0, "l.s"), 0, 1e-3);
  EXPECT_NEAR(value(result, rows - 1, "l.s"), std::numbers::pi, 1e-3);
  EXPECT_LT(value(result, 0, "l.Fx"), -1e3);
  EXPECT_GT(value(result, rows - 1, "l.Fx"), 1e3);
}

/// Four creases at 0, 70, 170 and 280 degrees, flat where all angles are zero.
constexpr const char* vertex = R"toml(
[[body]]
name = "panel"
task_space = "spatial"
pose = [0, 0, 0, 0.965572589849, -0.084476655423, -0.046149807191]
[[chain]]
name = "a"
elements = [
  { joint = "revolute", axis = [1, 0, 0], name = "c1", role = "actuated", value = 1 },
  { joint = "revolute", axis = ["cos(70*deg)", "sin(70*deg)", 0], name = "c2", role = "preloaded", initial = -0.0985, spring = { law = "linear", stiffness = 0.4, free = "-12*deg" } } ]
[[chain]]
name = "b"
elements = [
  { joint = "revolute", axis = ["cos(280*deg)", "sin(280*deg)", 0], name = "c4", role = "preloaded", initial = -0.0985, spring = { law = "linear", stiffness = 0.5, free = "36*deg" } },
  { joint = "revolute", axis = ["cos(170*deg)", "sin(170*deg)", 0], name = "c3", role = "preloaded", initial = -1, spring = { law = "linear", stiffness = 0.9, free = "50*deg" } } ]
[[study]]
name = "fold"
control = "actuator"
actuators = { "a.c1" = 1 }
until = { lambda = ["-70*deg", "60*deg"] }
)toml";

TEST(Reach, OfAFoldedVertexIsNotItsFlatStateBehindWhichItsCreasesGoOn) {
  // Flat-foldable: tan(c2/2) = tan(c1/2) cos((a + b)/2)/cos((a - b)/2) with sectors a, b (Tachi 2009).
  const auto result = run(vertex).of("fold");
  EXPECT_FALSE(complete(result));
  const auto& branch = result.branches.front();
  EXPECT_THAT(branch.backward.reason,
              AllOf(HasSubstr("infinite forces"), HasSubstr("kinematic singularity"),
                    Not(HasSubstr("hardly move"))));
  const double share =
      std::cos(85 * std::numbers::pi / 180) / std::cos(15 * std::numbers::pi / 180);
  EXPECT_NEAR(value(result, 0, "a.c1.rho"), 0, 1e-8);
  for (std::size_t row = 0; row < branch.samples.size(); ++row)
    EXPECT_NEAR(std::tan(value(result, row, "a.c2") / 2),
                -share * std::tan(value(result, row, "a.c1.rho") / 2), 1e-9)
        << row;
}

/// A crank of 0.6 and a rod as long, folded where the slider stands in the crank's foot: x = 1.2 cos(a). There it has a
/// force across the slide that grows as 1/x: 1.3 (a - 0.8) = c.Fy x with the torque of the crank's spring.
TEST(Reach, OfAFoldedRodEndsInARowThatBalances) {
  const auto result = run(R"toml(
[[body]]
name = "s"
task_space = "xy"
pose = ["1.2*cos(0.8)", 0]
[[chain]]
name = "c"
elements = [
  { joint = "revolute", axis = "z", name = "a", initial = 0.8, role = "preloaded", spring = { law = "linear", stiffness = 1.3, free = 0.8 } },
  { rigid = [0.6, 0] }, { joint = "revolute", axis = "z", initial = -1.6 }, { rigid = [0.6, 0] } ]
[[chain]]
name = "g"
elements = [ { joint = "prismatic", axis = "x", initial = 0.83, role = "preloaded", spring = { law = "linear", stiffness = 0.4, free = 0.5 } } ]
[[study]]
name = "push"
control = "mixed"
direction = [-1, 0]
until = { lambda = [-0.3, 2.2] }
)toml")
                          .of("push");
  EXPECT_TRUE(complete(result));
  const auto& branch = result.branches.front();
  EXPECT_EQ(branch.forward.reason.rfind("end of the reach: chain c is stretched out or folded", 0),
            0u);
  const std::size_t last = branch.samples.size() - 1;
  EXPECT_NEAR(value(result, last, "c.a"), std::numbers::pi / 2, 1e-9);
  for (const std::size_t row : {last - 1, last}) {
    const double x = value(result, row, "s.x");
    // Rounding of the closure leaves its root of the knee's angle, 1e-8.
    EXPECT_NEAR(x, 1.2 * std::cos(value(result, row, "c.a")), 1e-9);
    const double torque = 1.3 * (value(result, row, "c.a") - 0.8);
    const double force = value(result, row, "c.Fy");
    EXPECT_NEAR(force * x, torque, 1e-11 + 1e-14 * force) << row;
  }
}

/// Three legs at a body of irregular sizes, one of which the force along an irregular direction stretches. Behind 1e5
/// times the forces of the start rounding would make touches of a curve that has none.
TEST(Reach, IsFoundWhileACurveIsFollowedBeforeRoundingMakesEvents) {
  const auto result = run(R"toml(
[[body]]
name="b"
task_space="planar"
pose=[0.025, 1.054, 0.275]
[[chain]]
name="c0"
from_at=[-1.152, 0.013]
to_at=[-0.1, 0.02]
elements=[{joint="revolute",axis="z",name="j0",initial=1.2796192280277734,role="preloaded",spring={law="linear",stiffness=0.194,free=1.251}},
{rigid=[0.447,0]},
{joint="revolute",axis="z",name="j2",initial=-0.12228756325619794,role="preloaded",spring={law="linear",stiffness=0.186,free=-0.043}},
{rigid=[0.829,0]},
{joint="revolute",axis="z",name="j4",initial=-1.4034652099491713,role="preloaded",spring={law="linear",stiffness=0.288,free=-1.309}},
{rigid=[0.633,0]},
{joint="revolute",axis="z",name="j6",initial=0.5211335451775958,role="preloaded",spring={law="polynomial",coefficients=[0,0.18,0.054,0.144],free=0.569}}]
[[chain]]
name="c1"
from_at=[0.097, -0.103]
to_at=[-0.002, -0.052]
elements=[{joint="revolute",axis="z",name="j0",initial=0.9843372159770429,role="preloaded",spring={law="polynomial",coefficients=[0,2.125,0.6375,1.7],free=0.689}},
{rigid=[0.709,0]},
{joint="revolute",axis="z",name="j2",initial=1.3061449501102373,role="preloaded",spring={law="linear",stiffness=0.453,free=1.013}},
{rigid=[0.686,0]},
{joint="revolute",axis="z",name="j4",initial=-2.0154821660872804}]
[[chain]]
name="c2"
from_at=[0.901, 0.191]
to_at=[0.391, 0.111]
elements=[{joint="revolute",axis="z",name="j0",initial=2.0283522516296872,role="preloaded",spring={law="linear",stiffness=2.747,free=1.859}},
{joint="prismatic",axis="x",name="j1",initial=0.9993782585200923,role="preloaded",spring={law="linear",stiffness=1.7599999999999998,free=1.061}},
{rigid=[0.2,0]},
{joint="revolute",axis="z",name="j3",initial=-1.7533522516296873}]
[[spring]]
name="g"
from_at=[0.1,-1.5]
to="b"
stiffness=0.3
free=0.5
[[study]]
name="s"
body="b"
control="mixed"
direction=[-0.403, 0.646, 0]
until={lambda=[-1.2, 1.2]}
branches={depth=1,maximum=6}
)toml")
                          .of("s");
  EXPECT_TRUE(complete(result));
  ASSERT_EQ(result.branches.size(), 1u);
  const auto& branch = result.branches.front();
  EXPECT_EQ(branch.forward.reason.rfind("end of the reach: chain c1 is stretched out or folded", 0),
            0u)
      << branch.forward.reason;
  for (const analysis::Event& event : branch.events)
    EXPECT_EQ(event.kind, analysis::EventKind::end_of_range);
  const std::size_t last = branch.samples.size() - 1;
  EXPECT_GT(value(result, last, "force"), 1e6);
  EXPECT_NEAR(std::remainder(value(result, last, "c1.j2"), std::numbers::pi), 0, 1e-6);
}

/// Two mirrored arms of links 1 and 0.6 that fold at x = 0.4, their body held across by a spring: as the force grows
/// without bound the body buckles to one side, however stiff that spring is.
std::string folding_arms(double across, double off) {
  const double x = 0.9, knee = std::acos((x * x - 1.36) / 1.2);
  const double foot = -std::atan2(0.6 * std::sin(knee), 1 + 0.6 * std::cos(knee));
  std::string text = "[[body]]\nname = \"b\"\ntask_space = \"xy\"\npose = [0.9, 0]\n";
  for (const auto& [name, side] : {std::pair{"u", 1.0}, {"v", -1.0}})
    text +=
        std::string("[[chain]]\nname = \"") + name +
        "\"\nelements = [{ joint = \"revolute\", axis = \"z\", initial = " + number(side * foot) +
        " }, { rigid = [1, 0] }, { joint = \"revolute\", axis = \"z\", role = \"preloaded\", "
        "initial = " +
        number(side * knee) +
        ", spring = { law = \"linear\", stiffness = 1, free = " + number(side * knee) +
        " } }, { rigid = [0.6, 0] }]\n";
  return text +
         "[[chain]]\nname = \"g\"\nelements = [{ joint = \"prismatic\", axis = \"x\", initial = "
         "0.9 "
         "}, { joint = \"prismatic\", axis = \"y\", name = \"y\", role = \"preloaded\", initial = "
         "0, "
         "spring = { law = \"linear\", stiffness = " +
         number(across) + ", free = " + number(off) +
         " } }]\n[[study]]\nname = \"s\"\ncontrol = \"mixed\"\ndirection = [-1, 0]\nuntil = { "
         "lambda = [0, 1.2] }\n";
}

TEST(Reach, IsNotTakenForTheEndBeforeABranchPointAtALargeForce) {
  for (const double across : {120.0, 1e3, 1e5}) {
    const auto result = run(folding_arms(across, 0)).of("s");
    EXPECT_TRUE(complete(result)) << across;
    const auto& branch = result.branches.front();
    int points = 0;
    for (const analysis::Event& event : branch.events)
      if (event.kind == analysis::EventKind::branch_point) ++points;
    EXPECT_EQ(points, 1) << across;
    EXPECT_NEAR(value(result, branch.samples.size() - 1, "lambda"), 0.5, 1e-9) << across;
  }
}

/// A little askew the curve turns aside before the fold: it has no pole.
TEST(Reach, IsNoneOfACurveThatTurnsAsideAtALargeForce) {
  for (const double off : {1e-4, 1e-6}) {
    const auto result = run(folding_arms(1e3, off)).of("s");
    const auto& branch = result.branches.front();
    EXPECT_NE(branch.forward.reason.rfind("end of the reach: ", 0), 0u) << branch.forward.reason;
    EXPECT_GT(std::abs(value(result, branch.samples.size() - 1, "g.y")), 0.01) << off;
  }
}

}  // namespace
}  // namespace springfold::io
