// Load histories: studies that start in the states of others, run.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "cases/case_runs.hpp"
#include "small_structures.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;

std::string frame_with(const std::string& studies) {
  return R"toml([[node]]
name = "pin"
at = [0, 0]
fixed = true
[[node]]
name = "foot"
at = ["2*cos(30*deg)", 0]
fixed = ["y"]
[[node]]
name = "apex"
at = ["cos(30*deg)", 0.5]
[[bar]]
from = "pin"
to = "apex"
stiffness = 100
[[bar]]
from = "foot"
to = "apex"
stiffness = 100
[[bar]]
name = "tie"
from = "pin"
to = "foot"
stiffness = 1
)toml" + studies;
}

const std::string pushed = R"toml([[study]]
name = "push"
body = "apex"
control = "load"
direction = [0, -1]
start = { from = "preload" }
until = { apex.y = [0.1, 0.75] }
)toml";

TEST(LoadHistories, KeepTheLoadOfTheStudyBefore) {
  const Ran ran = run(frame_with(R"toml([[study]]
name = "preload"
body = "foot"
control = "load"
direction = [-1, 0]
until = { lambda = [0, 0.4] }
)toml" + pushed));
  const auto& second = ran.of("push");
  ASSERT_TRUE(analysis::complete(second)) << second.start.message;
  EXPECT_LT(second.start.moved, 1e-12);
  EXPECT_NEAR(value(second, second.branches[0].start_row, "tie.force"), -0.4, 1e-12);
  EXPECT_NEAR(lambdas(second, EventKind::limit_point).at(0), 0.4534552257, 1e-9);
}

TEST(LoadHistories, ADrivenPoseIsKeptAsTheForceThatDroveIt) {
  const Ran ran = run(frame_with(R"toml([[study]]
name = "preload"
body = "foot"
control = "mixed"
direction = [-1, 0]
until = { lambda = [0, 0.4] }
)toml" + pushed));
  EXPECT_NEAR(lambdas(ran.of("push"), EventKind::limit_point).at(0), 0.4534552257, 1e-9);
}

const std::string squeezed_held_and_pushed = R"toml([[study]]
name = "preload"
body = "foot"
control = "load"
direction = [-1, 0]
until = { lambda = [0, 0.4] }
[[study]]
name = "held"
body = "apex"
control = "load"
direction = [0, -1]
start = { from = "preload", hold = ["foot.x"] }
until = { lambda = [0, 0.2] }
[[study]]
name = "let go"
body = "foot"
control = "mixed"
direction = [1, 0]
start = { from = "held", release = ["foot.x"] }
until = { lambda = [-0.1, 0.1] }
)toml";

// N = k (l - 1) in the bars, which carry P, and the tie: the foot wants the force that each row has.
TEST(LoadHistories, WhatHeldAReleasedCoordinateIsKeptAsALoad) {
  const Ran ran = run(frame_with(squeezed_held_and_pushed));
  const auto& held = ran.of("held");
  const double wall = value(held, held.branches[0].samples.size() - 1, "foot.hold.Fx");
  const auto& free = ran.of("let go");
  ASSERT_TRUE(analysis::complete(free)) << free.start.message;
  EXPECT_LT(free.start.moved, 1e-12);
  EXPECT_GT(wall, 0.05);
  ASSERT_GT(free.branches[0].samples.size(), 3U);
  for (std::size_t row = 0; row < free.branches[0].samples.size(); ++row) {
    const double x = value(free, row, "foot.x"), y = value(free, row, "apex.y");
    const double l = std::hypot(x / 2, y), N = 100 * (l - 1);
    EXPECT_NEAR(-2 * N * y / l, 0.2, 1e-11);
    const double inwards = 0.4 + wall - value(free, row, "force");
    EXPECT_NEAR(-inwards - N * x / (2 * l) - (x - 2 * std::cos(std::numbers::pi / 6)), 0, 1e-11);
  }
}

TEST(LoadHistories, WithLoadsOfItsOwnAStudyReleasesTheForceToo) {
  std::string text = frame_with(squeezed_held_and_pushed);
  text = text.replace(text.find("release ="), 9, "loads = \"own\", release =");
  const Ran ran = run(text);
  const auto& free = ran.of("let go");
  ASSERT_TRUE(free.start.found) << free.start.message;
  EXPECT_NEAR(value(free, free.branches[0].start_row, "foot-apex.force"), 0, 1e-12);
}

TEST(LoadHistories, AParameterIsKeptAsItWasLeft) {
  std::string text = frame_with(R"toml([[study]]
name = "preload"
body = "foot"
control = "parameter"
parameter = "squeeze"
load = ["-squeeze", 0]
until = { lambda = [0, 0.4] }
)toml" + pushed);
  const Ran ran = run("[parameters]\nsqueeze = 0\n" + text);
  EXPECT_NEAR(lambdas(ran.of("push"), EventKind::limit_point).at(0), 0.4534552257, 1e-9);
}

// Held at half the span a the truss of two bars of length 1 turns back at l^3 = a^2.
TEST(LoadHistories, ADirectionIsBlockedWhereTheStudyBeforeLeftIt) {
  std::string text = frame_with(R"toml([[study]]
name = "preload"
body = "foot"
control = "load"
direction = [-1, 0]
until = { lambda = [0, 0.4] }
)toml" + pushed);
  text = text.replace(text.find("{ from = \"preload\" }"), 20,
                      "{ from = \"preload\", hold = [\"foot.x\"] }");
  const Ran ran = run(text);
  const auto& second = ran.of("push");
  ASSERT_TRUE(analysis::complete(second)) << second.start.message;
  const double a = std::sqrt(0.75) - 0.2, l = std::cbrt(a * a), y = std::sqrt(l * l - a * a);
  EXPECT_NEAR(lambdas(second, EventKind::limit_point).at(0), 2 * 100 * (1 / l - 1) * y, 1e-10);
  EXPECT_NEAR(value(second, second.branches[0].start_row, "foot.hold.Fx"), 0, 1e-12);
  EXPECT_NEAR(value(second, 0, "foot.x"), 2 * a, 1e-12);
}

// Wound up by M = 2 phi beyond whole turns, and unwound by another study.
TEST(LoadHistories, AnglesGoOnCountingTheTurnsOfTheDrawing) {
  const Ran ran = run(R"toml([[body]]
name = "arm"
task_space = "planar"
[[chain]]
name = "hinge"
elements = [{ joint = "revolute", axis = "z", name = "q" }]
[[spring]]
name = "coil"
shape = "angle"
of = [{ on = "base", at = [1, 0] }, { on = "base", at = [0, 0] }, { on = "arm", at = [1, 0] }]
stiffness = 2
near = 0
[[study]]
name = "wind"
control = "load"
direction = [0, 0, 1]
until = { lambda = [0, 20] }
[[study]]
name = "unwind"
control = "load"
direction = [0, 0, 1]
start = { from = "wind" }
until = { lambda = [-20, 0] }
[[study]]
name = "rest"
kind = "equilibrium"
start = { from = "unwind", at = "start" }
)toml");
  const auto& wind = ran.of("wind");
  const auto& unwind = ran.of("unwind");
  ASSERT_TRUE(analysis::complete(wind) && analysis::complete(unwind)) << unwind.start.message;
  const auto last = [](const auto& result) { return result.branches[0].samples.size() - 1; };
  EXPECT_NEAR(value(wind, last(wind), "arm.phi"), 10, 1e-10);
  EXPECT_NEAR(value(unwind, unwind.branches[0].start_row, "arm.phi"), 10, 1e-10);
  EXPECT_NEAR(value(unwind, unwind.branches[0].start_row, "coil.angle"), 10, 1e-10);
  EXPECT_NEAR(value(unwind, 0, "arm.phi"), 0, 1e-10);
  EXPECT_NEAR(value(ran.of("rest"), 0, "coil.angle"), 10, 1e-10);
}

// What the first study after the preload holds, those that start from it hold too.
TEST(LoadHistories, HoldsLastInTheStudiesThatFollow) {
  const Ran ran = run(frame_with(R"toml([[study]]
name = "preload"
body = "foot"
control = "load"
direction = [-1, 0]
until = { lambda = [0, 0.4] }
[[study]]
name = "push a little"
body = "apex"
control = "load"
direction = [0, -1]
start = { from = "preload", hold = ["foot.x"] }
until = { lambda = [0, 0.1] }
[[study]]
name = "push on"
body = "apex"
control = "load"
direction = [0, -1]
start = { from = "push a little" }
until = { lambda = [0, 0.1] }
)toml"));
  const auto end = [](const auto& result) { return result.branches[0].samples.size() - 1; };
  const auto& on = ran.of("push on");
  ASSERT_TRUE(analysis::complete(on)) << on.start.message;
  const double held = value(ran.of("preload"), end(ran.of("preload")), "foot.x");
  EXPECT_NEAR(value(on, end(on), "foot.x"), held, 1e-12);
  // Both bars carry half of the push of 0.2; the tie and the kept load balance each other.
  const double slope = value(on, end(on), "apex.y") / (held / 2);
  EXPECT_NEAR(std::abs(value(on, end(on), "foot.hold.Fx")), 0.1 / slope, 1e-10);
}

TEST(LoadHistories, StepsFollowEachOtherAndStartAtLabelledPoints) {
  const Ran ran = run(frame_with(R"toml([[study]]
name = "preload"
body = "foot"
control = "load"
direction = [-1, 0]
until = { lambda = [0, 0.4] }
)toml" + pushed + R"toml([[study]]
name = "on"
body = "apex"
control = "mixed"
direction = [0, -1]
start = { from = "push", at = "LP1" }
until = { lambda = [-0.1, 0.1] }
[[study]]
name = "rest"
body = "apex"
kind = "equilibrium"
start = { from = "on", at = "end" }
)toml"));
  const auto& on = ran.of("on");
  ASSERT_TRUE(analysis::complete(on)) << on.start.message;
  const auto& before = ran.of("push");
  for (const auto& event : before.branches[0].events) {
    if (event.label != "LP1") continue;
    EXPECT_NEAR(value(on, on.branches[0].start_row, "apex.y"), value(before, event.row, "apex.y"),
                1e-10);
  }
  const auto& rest = ran.of("rest");
  ASSERT_TRUE(rest.start.found) << rest.start.message;
  EXPECT_NEAR(value(rest, 0, "apex.y"), value(on, on.branches[0].samples.size() - 1, "apex.y"),
              1e-12);
}

TEST(LoadHistories, SayWhyThereIsNoStateToStartFrom) {
  std::string text = frame_with(R"toml([[study]]
name = "preload"
body = "foot"
control = "load"
direction = [-1, 0]
until = { lambda = [0, 0.4] }
)toml" + pushed);
  text =
      text.replace(text.find("{ from = \"preload\" }"), 20, "{ from = \"preload\", at = \"LP7\" }");
  const Ran ran = run(text);
  EXPECT_FALSE(ran.of("push").start.found);
  EXPECT_EQ(ran.of("push").start.message,
            "study \"preload\", from which it starts, has no point \"LP7\"; it has start, end, "
            "EP1, EP2");
}

/// A symmetric truss in its limit point: to first order V_y = a y^2/2 - b x^2/2, so that two curves cross there.
TEST(LoadHistories, LeaveALimitPointAcrossByAllItsWays) {
  const Ran ran = run(supports_and_apex("apex", "0.5") + R"toml([[bar]]
from = "l"
to = "apex"
EA = 1
[[bar]]
from = "r"
to = "apex"
EA = 1
[[study]]
name = "press"
body = "apex"
control = "load"
direction = [0, -1]
until = { apex.y = [-0.6, 0.6] }
[[study]]
name = "across"
body = "apex"
control = "load"
direction = [1, 0]
start = { from = "press", at = "LP1" }
until = { apex.y = [-0.8, 0.8], apex.x = [-0.5, 0.5] }
)toml");
  const auto& across = ran.of("across");
  EXPECT_TRUE(analysis::complete(across)) << across.branches.front().forward.reason;
  EXPECT_EQ(across.start.ways.size(), 4U);
  EXPECT_TRUE(across.doubts.empty()) << across.doubts.front();
}

/// The truss turns back at LP1 and comes to the asked load no more: its path ends unloaded, turned over and unstable at
/// first, or where its range has it end.
TEST(LoadHistories, SayThatTheStateLiesBehindALossOfStability) {
  const std::string truss = supports_and_apex("apex", "0.5") + R"toml([[bar]]
from = "l"
to = "apex"
EA = 1
[[bar]]
from = "r"
to = "apex"
EA = 1
[[study]]
name = "press"
body = "apex"
control = "load"
direction = [0, -1]
)toml";
  const std::string next = R"toml([[study]]
name = "next"
body = "apex"
control = "load"
direction = [1, 0]
until = { lambda = [-0.001, 0.001] }
start = { from = "press", at = "end" }
)toml";
  using testing::HasSubstr;
  const Ran lost = run(truss + "until = { lambda = [0, 1] }\n" + next);
  EXPECT_THAT(lost.of("next").start.method, HasSubstr("behind LP1, where stability was lost"));
  const Ran reached = run(truss + "until = { lambda = [0, 0.001] }\n" + next);
  EXPECT_THAT(reached.of("next").start.method, HasSubstr("from study \"press\" at end"));
  EXPECT_THAT(reached.of("next").start.method, testing::Not(HasSubstr("behind")));
}

}  // namespace
}  // namespace springfold::io
