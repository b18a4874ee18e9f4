// Nodes, bars, repetition and load histories: what they stand for, run.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "cases/case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;

/// All numbers of all rows, bit by bit.
std::string bytes_of(const analysis::StudyResult& result) {
  std::ostringstream text;
  text << std::hexfloat;
  for (const auto& quantity : result.quantities) text << quantity.name << ",";
  for (const auto& branch : result.branches)
    for (const auto& sample : branch.samples) {
      for (const double value : sample.values) text << value << ",";
      text << sample.event << "\n";
    }
  return text.str();
}

std::string truss(const std::string& bars) {
  return R"toml([parameters]
a = 1
[[node]]
name = "n0"
at = ["-a", 0]
fixed = true
[[node]]
name = "n1"
at = [0, "a/2"]
[[node]]
name = "n2"
at = ["a", 0]
fixed = true
)toml" + bars +
         R"toml([[study]]
name = "press"
control = "load"
direction = [0, -1]
until = { n1.y = [-1, 1] }
)toml";
}

TEST(RepeatedTables, GiveTheSameBytesAsWrittenOut) {
  const Ran repeated = run(truss(R"toml([[bar]]
repeat = { i = [0, 1] }
from = "n{2*i}"
to = "n1"
EA = "2 + i"
)toml"));
  const Ran by_hand = run(truss(R"toml([[bar]]
from = "n0"
to = "n1"
EA = "2 + 0"
[[bar]]
from = "n2"
to = "n1"
EA = "2 + 1"
)toml"));
  EXPECT_EQ(bytes_of(repeated.results[0]), bytes_of(by_hand.results[0]));
  EXPECT_GT(repeated.results[0].branches.at(0).samples.size(), 20U);
}

// F = 2 k (L0/l - 1) y turns back at l^3 = L0 a^2.
TEST(Bars, GiveTheLimitLoadsOfTheSameTrussOfChains) {
  const Ran bars =
      run(truss("[[bar]]\nrepeat = { i = [0, 2, 2] }\nfrom = \"n{i}\"\nto = "
                "\"n1\"\nstiffness = 3\n"));
  const Ran chains = run(R"toml([[body]]
name = "n1"
task_space = "xy"
pose = [0, 0.5]
[[chain]]
repeat = { i = [0, 1] }
name = "bar{i}"
from_at = ["2*i - 1", 0]
elements = [
  { joint = "revolute", axis = "z", name = "foot", initial = "atan2(0.5, 1 - 2*i)" },
  { joint = "prismatic", axis = "x", name = "length", role = "virtual", stiffness = 3 },
  { rigid = ["sqrt(1.25)", 0] },
]
[[study]]
name = "press"
control = "load"
direction = [0, -1]
until = { n1.y = [-1, 1] }
)toml");
  const double L0 = std::sqrt(1.25), l = std::cbrt(L0), y = std::sqrt(l * l - 1);
  const double P = 2 * 3 * (L0 / l - 1) * y;
  for (const Ran* ran : {&bars, &chains})
    EXPECT_THAT(lambdas(ran->results[0], EventKind::limit_point),
                testing::UnorderedElementsAre(testing::DoubleNear(P, 1e-12),
                                              testing::DoubleNear(-P, 1e-12)));
}

// Along the axis of symmetry nothing moves but what is driven: F(y) = 2 k (L0/l - 1) y.
TEST(Bars, CanBeDrivenAlongAnAxisOfSymmetryWhereNothingAnswers) {
  std::string text = truss(
      "[[bar]]\nrepeat = { i = [0, 2, 2] }\nfrom = \"n{i}\"\nto = "
      "\"n1\"\nstiffness = 3\n");
  const Ran driven = run(text.replace(text.find("\"load\""), 6, "\"mixed\""));
  const analysis::StudyResult& result = driven.results[0];
  ASSERT_TRUE(analysis::complete(result)) << result.start.message;
  const std::size_t rows = result.branches[0].samples.size();
  EXPECT_GT(rows, 10U);
  for (std::size_t row = 0; row < rows; ++row) {
    const double y = value(result, row, "n1.y"), l = std::hypot(1, y);
    EXPECT_NEAR(value(result, row, "force"), 6 * (std::sqrt(1.25) / l - 1) * y, 1e-13);
  }
}

// A body on four springs as it is drawn: K_phi = sum k (u x r)^2, no chain at all.
TEST(ABodyHeldBySpringsAlone, HasTheStiffnessOfItsSprings) {
  const Ran ran = run(R"toml([[body]]
name = "plate"
task_space = "planar"
pose = [0, 0, 0]
[[bar]]
repeat = { i = [0, 3] }
name = "s{i}"
from = "base"
from_at = ["3*cos(i*90*deg + 20*deg)", "3*sin(i*90*deg + 20*deg)"]
to = "plate"
to_at = ["cos(i*90*deg)", "sin(i*90*deg)"]
stiffness = 2
[[study]]
name = "turn"
control = "mixed"
direction = [0, 0, 1]
until = { deflection = [-1, 1] }
)toml");
  const analysis::StudyResult& result = ran.results[0];
  ASSERT_TRUE(analysis::complete(result)) << result.start.message;
  const double c = std::cos(20 * std::acos(-1.0) / 180), s = std::sin(20 * std::acos(-1.0) / 180);
  const double length2 = 10 - 6 * c, lever2 = 9 * s * s / length2;
  EXPECT_NEAR(result.start.stiffness(2, 2), 4 * 2 * lever2, 1e-12);
  EXPECT_NEAR(result.start.stiffness(0, 0), 4 * 2 * 0.5, 1e-12);
  // Turned by q the springs have the length sqrt(10 - 6 cos(20 deg - q)).
  const std::size_t last = result.branches[0].samples.size() - 1;
  const double q = value(result, last, "deflection");
  const double L = std::sqrt(10 - 6 * std::cos(20 * std::acos(-1.0) / 180 - q));
  const double torque =
      -4 * 2 * (1 - std::sqrt(length2) / L) * 3 * std::sin(20 * std::acos(-1.0) / 180 - q);
  EXPECT_NEAR(value(result, last, "force"), torque, 1e-11);
}

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
            "study \"preload\", from which it starts, has no point \"LP7\"");
}

std::size_t lines_of(const std::string& name) {
  std::ifstream file{SPRINGFOLD_SOURCE_DIR "/cases/short-files/" + name};
  std::size_t count = 0;
  for (std::string line; std::getline(file, line);) ++count;
  return count;
}

TEST(ShortFiles, AreShort) {
  EXPECT_LE(lines_of("case.toml"), 25U);
  EXPECT_LE(lines_of("case-platform.toml"), 20U);
  EXPECT_LE(lines_of("case-column.toml"), 12U);
}

}  // namespace
}  // namespace springfold::io
