// Moments on spatial bodies that can turn about one direction only: they have a potential.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "case_runs.hpp"
#include "springfold/analysis/snap.hpp"
#include "springfold/io/results.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;
using std::numbers::pi;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A tower that rises and turns about its own axis.
const std::string tower = R"toml(
[[body]]
name = "top"
task_space = "spatial"
pose = [0, 0, 1, 0, 0, 0.3]
[[chain]]
name = "screw"
elements = [
  { joint = "prismatic", axis = "z", name = "z", role = "preloaded", initial = 1, spring = { law = "linear", stiffness = 3, free = 1 } },
  { joint = "revolute", axis = "z", name = "turn", role = "preloaded", initial = 0.3, spring = { law = "linear", stiffness = 300, free = 0.3 } }]
)toml";

TEST(MomentsOnBodies, TurnATowerThatStaysStable) {
  const Ran ran = run(tower + R"(
[[study]]
name = "direction"
control = "load"
direction = [0, 0, 0, 0, 0, 1]
until = { lambda = [-100, 100] }
[[study]]
name = "load"
control = "load"
loads = [{ on = "top", moment = [0, 0, 1], scale = "lambda" }]
until = { lambda = [-100, 100] }
[[study]]
name = "follower"
control = "load"
loads = [{ on = "top", moment = [0, 0, 1], scale = "lambda", follows = true }]
until = { lambda = [-100, 100] }
[[study]]
name = "both"
control = "load"
direction = [0, 0, 1, 0, 0, 2]
until = { lambda = [-100, 100] }
)");
  for (const StudyResult& result : ran.results) {
    EXPECT_THAT(result.non_conservative, IsEmpty()) << result.study;
    EXPECT_TRUE(complete(result));
    ASSERT_GT(result.branches[0].samples.size(), 3u);
    const bool both = result.study == "both";
    for (std::size_t row = 0; row < result.branches[0].samples.size(); ++row) {
      const double lambda = value(result, row, "lambda"), M = both ? 2 * lambda : lambda;
      EXPECT_NEAR(value(result, row, "screw.turn"), 0.3 + M / 300, 1e-12);
      EXPECT_NEAR(value(result, row, "screw.z"), both ? 1 + lambda / 3 : 1, 1e-12);
      EXPECT_NEAR(value(result, row, "screw.Mz"), M, 1e-10);
      EXPECT_EQ(value(result, row, "index"), 0);
    }
  }
}

/// A plate on a hinge about a slanted axis, its own frame slanted against that of the hinge, with a torsion spring 1
/// and a spring of free length 0 and stiffness 2 from its rim, at the distance 1, to a pin at the distance 1 on the
/// other side:
///
///     U = t^2/2 + 2 cos t,   M = t - 2 sin t,   dM/dt = 1 - 2 cos t.
std::string dead_centre(const std::string& start) {
  return R"toml(
[[body]]
name = "plate"
task_space = "spatial"
pose = [0, 0, 0, 0, -0.4, 0]
[[chain]]
name = "hinge"
to_at = { rotate = { axis = "y", angle = 0.4 } }
elements = [{ joint = "revolute", axis = [0.6, 0, 0.8], name = "t", role = "preloaded", initial = )toml" +
         start + R"toml(, spring = { law = "linear", stiffness = 1 } },
  { point = "end" }]
[[spring]]
name = "over"
from_at = [-0.8, 0, 0.6]
to = "plate"
to_at = ["0.8*cos(0.4) - 0.6*sin(0.4)", 0, "-0.8*sin(0.4) - 0.6*cos(0.4)"]
stiffness = 2
[[study]]
name = "turn"
control = "load"
until = { "hinge.t" = [-3, 3] }
)toml";
}

/// @param along  what lambda = 1 has along the axis
void expect_limit_points(const StudyResult& result, double along) {
  EXPECT_THAT(result.non_conservative, IsEmpty());
  EXPECT_TRUE(complete(result));
  const double limit = std::sqrt(3.0) - pi / 3;
  std::size_t found = 0;
  for (const auto& event : result.branches[0].events) {
    if (event.kind != EventKind::limit_point) continue;
    ++found;
    EXPECT_NEAR(along * std::abs(value(result, event.row, "lambda")), limit, 1e-10);
    EXPECT_NEAR(std::abs(value(result, event.row, "hinge.t")), pi / 3, 1e-8);
  }
  EXPECT_EQ(found, 2u);
  for (std::size_t row = 0; row < result.branches[0].samples.size(); ++row) {
    const double t = value(result, row, "hinge.t");
    EXPECT_NEAR(along * value(result, row, "lambda"), t - 2 * std::sin(t), 1e-10);
    if (std::abs(std::abs(t) - pi / 3) < 1e-6) continue;
    EXPECT_EQ(value(result, row, "index"), std::abs(t) < pi / 3 ? 1 : 0) << t;
  }
}

TEST(MomentsOnBodies, HaveTheLimitPointsOfAPlateThatIsPulledOverDeadCentre) {
  const std::string plate = dead_centre("0");
  expect_limit_points(run(plate + "direction = [0, 0, 0, 0.6, 0, 0.8]\n").of("turn"), 1);
  // What acts across the axis does no work; the direction has length 1.
  expect_limit_points(run(plate + "direction = [0, 0, 0, 1, 0.3, 0.5]\n").of("turn"),
                      1 / std::sqrt(1.34));
  // In the plate's own frame, which stands turned by -0.4 about y.
  expect_limit_points(run(plate + R"toml([[study.loads]]
on = "plate"
follows = true
scale = "lambda"
moment = ["0.6*cos(0.4) + 0.8*sin(0.4)", 0.4, "-0.6*sin(0.4) + 0.8*cos(0.4)"]
)toml")
                          .of("turn"),
                      1);
}

TEST(MomentsOnBodies, GiveTheColumnsThatTheyGiveAtTheEndOfTheChain) {
  const std::string load = "loads = [{ moment = [1, 0.3, 0.5], scale = \"lambda\", on = ";
  const StudyResult body = run(dead_centre("0.5") + load + "\"plate\" }]\n").of("turn"),
                    point = run(dead_centre("0.5") + load + "\"hinge.end\" }]\n").of("turn");
  const auto &a = body.branches[0].samples, &b = point.branches[0].samples;
  ASSERT_EQ(a.size(), b.size());
  ASSERT_EQ(body.quantities.size(), point.quantities.size());
  for (std::size_t row = 0; row < a.size(); ++row)
    for (std::size_t i = 0; i < a[row].values.size(); ++i) {
      const std::string& name = body.quantities[i].name;
      EXPECT_EQ(name, point.quantities[i].name);
      // The chain carries the moment to the body or from it.
      if (name.starts_with("hinge.M")) continue;
      if (std::isnan(a[row].values[i]) && std::isnan(b[row].values[i])) continue;
      EXPECT_NEAR(a[row].values[i], b[row].values[i], 1e-8 * (1 + std::abs(a[row].values[i])))
          << name << " in row " << row;
    }
}

TEST(MomentsOnBodies, LetGoOfTheEnergyThatAJumpHasInClosedForm) {
  const Ran ran = run(dead_centre("2") + "direction = [0, 0, 0, 0.6, 0, 0.8]\nsnap = true\n");
  const StudyResult& result = ran.of("turn");
  const double M = pi / 3 - std::sqrt(3.0);
  double t = -2.2;
  for (int i = 0; i < 20; ++i) t -= (t - 2 * std::sin(t) - M) / (1 - 2 * std::cos(t));
  const auto potential = [M](double at) { return at * at / 2 + 2 * std::cos(at) - M * at; };
  ASSERT_TRUE(result.snap);
  std::size_t found = 0;
  for (const auto& jump : result.snap->jumps) {
    if (jump.loading > 0) continue;
    ++found;
    EXPECT_NEAR(jump.released, potential(pi / 3) - potential(t), 1e-8);
  }
  EXPECT_EQ(found, 1u);
}

TEST(MomentsOnBodies, ActOnBodiesThatAreCarriedByOthers) {
  // Two plates on springs c = 2 and 3 in a row; a moment on each, and a force on the upper one, which turns with it and
  // along the axis: t1 = (lambda + 2)/2, t2 = lambda/3, z = 0.5 lambda.
  const StudyResult result = run(R"(
[[body]]
name = "lower"
task_space = "spatial"
[[body]]
name = "upper"
task_space = "spatial"
[[chain]]
name = "a"
to = "lower"
elements = [{ joint = "revolute", axis = "x", name = "t", role = "virtual", stiffness = 2 }]
[[chain]]
name = "b"
from = "lower"
to = "upper"
elements = [{ joint = "revolute", axis = "-x", name = "t", role = "virtual", stiffness = 3 },
  { joint = "prismatic", axis = "x", name = "x", role = "virtual", stiffness = 4 }]
[[load]]
on = "lower"
moment = [2, 0, 1]
[[study]]
name = "turn"
body = "upper"
control = "load"
direction = [0, 0, 0, 1, 0, 0]
loads = [{ on = "upper", at = [0, 1, 0], force = [2, 0, 0], follows = true, scale = "lambda" }]
until = { lambda = [0, 20] }
)")
                                 .of("turn");
  EXPECT_THAT(result.non_conservative, IsEmpty());
  EXPECT_TRUE(complete(result));
  for (std::size_t row = 0; row < result.branches[0].samples.size(); ++row) {
    const double lambda = value(result, row, "lambda");
    EXPECT_NEAR(value(result, row, "a.t"), (lambda + 2) / 2, 1e-11);
    EXPECT_NEAR(value(result, row, "b.t"), -lambda / 3, 1e-11);
    EXPECT_NEAR(value(result, row, "b.x"), 0.5 * lambda, 1e-11);
    EXPECT_EQ(value(result, row, "index"), 0);
  }
}

TEST(MomentsOnBodies, HaveNoPotentialWhereTheBodyTurnsAboutOtherAxesToo) {
  const Ran ran = run(R"(
[[body]]
name = "ball"
task_space = "spatial"
[[chain]]
name = "joint"
elements = [{ joint = "spherical", name = "s", role = "virtual", stiffness = 1 }]
[[study]]
name = "turn"
control = "load"
direction = [0, 0, 0, 0, 0, 1]
until = { lambda = [0, 0.5] }
)");
  EXPECT_THAT(ran.of("turn").non_conservative, ElementsAre("fixed-axis moment on ball"));
  EXPECT_THAT(summary_table(ran.read, ran.results), HasSubstr("NON-CONSERVATIVE"));
}

/// The body's y lies along the axis of its hinge: the follower moment M turns it as the driving one does, t = lambda +
/// M.
TEST(FollowerMoments, AsParametersMoveLoadsAsFixedOnesDo) {
  const auto result = run(R"toml(
[parameters]
M = 2
[[body]]
name = "top"
task_space = "spatial"
pose = [0, 0, 0, 0, 0, 0]
[[chain]]
name = "hinge"
to_at = { rotate = { axis = "x", angle = "pi/2" } }
elements = [{ joint = "revolute", axis = "z", name = "t", role = "preloaded", spring = { law = "linear", stiffness = 1 } }]
[[study]]
name = "sens"
kind = "sensitivity"
control = "load"
direction = [0, 0, 0, 0, 0, 1]
loads = [{ on = "top", moment = [0, "M", 0], follows = true }]
until = { lambda = [-3, 3] }
mark = { hinge.t = [0.5] }
sensitivity = { parameters = ["M"] }
)toml")
                          .of("sens");
  for (const auto& event : result.branches.at(0).events) {
    if (event.kind != EventKind::user_value) continue;
    const double lambda = value(result, event.row, "lambda");
    EXPECT_NEAR(std::abs(0.5 - lambda), 2, 1e-10);
    EXPECT_NEAR(std::abs(value(result, event.row, "d(lambda)/d(M)")), 1, 1e-9);
  }
}

/// All hinges are parallel at the start alone.
TEST(FixedMoments, HaveNoPotentialWhereTheParameterTiltsAnAxis) {
  const auto result = run(R"toml(
[parameters]
a = 0
[[body]]
name = "top"
task_space = "spatial"
pose = [0, 0, 0, 0, 0, 0]
[[chain]]
name = "c"
elements = [
  { joint = "revolute", axis = "z", role = "preloaded", spring = { law = "linear", stiffness = 1 } },
  { joint = "revolute", axis = ["sin(a)", 0, "cos(a)"], role = "preloaded", spring = { law = "linear", stiffness = 1 } },
  { rigid = [0, 0, 1] },
  { joint = "revolute", axis = "z", role = "preloaded", spring = { law = "linear", stiffness = 1 } } ]
[[study]]
name = "tilt"
control = "parameter"
parameter = "a"
load = [0, 0, 0, 0, 0, 3]
until = { lambda = [0, 1.2] }
)toml")
                          .of("tilt");
  EXPECT_TRUE(complete(result));
  EXPECT_FALSE(result.non_conservative.empty());
  EXPECT_LT(result.branches.at(0).samples.size(), 400u);
}

}  // namespace
}  // namespace springfold::io
