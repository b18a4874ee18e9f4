// Load histories of studies that change parameters: every member has the history of a case with its values.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "cases/case_runs.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;
using testing::HasSubstr;

std::string digits(double number) {
  std::ostringstream text;
  text.precision(17);
  text << number;
  return text.str();
}

/// Two bars of length 1 whose feet a tie joins, squeezed first and pushed down then.
/// @param d  way by which the foot is driven before it is held
std::string squeezed_frame(double ks, double squeeze, const std::string& studies, double d = 0.2) {
  return "[parameters]\nk = 100\nks = " + digits(ks) + "\nsqueeze = " + digits(squeeze) +
         "\nd = " + digits(d) + R"toml(
[[node]]
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
stiffness = "k"
[[bar]]
from = "foot"
to = "apex"
stiffness = "k"
[[bar]]
name = "tie"
from = "pin"
to = "foot"
stiffness = "ks"
[[study]]
name = "preload"
body = "foot"
control = "load"
direction = [-1, 0]
until = { lambda = [0, "squeeze"] }
[[study]]
name = "drive"
body = "foot"
control = "mixed"
direction = [-1, 0]
until = { lambda = [0, "d"] }
trace = { maximum_step = 0.2 }
)toml" + studies;
}

const std::string pushed_apex = R"toml(body = "apex"
control = "load"
direction = [0, -1]
start = { from = "preload" }
until = { apex.y = [0.1, 0.9] }
)toml";

double limit_load(const StudyResult& result) {
  return lambdas(result, EventKind::limit_point).at(0);
}

/// Of a value of separately run cases, error O(h^4).
double difference(const std::function<double(double)>& of, double x, double h) {
  return (8 * (of(x + h) - of(x - h)) - (of(x + 2 * h) - of(x - 2 * h))) / (12 * h);
}

TEST(HistoriesOfMembers, ASensitivityIsThatOfTheWholeHistory) {
  const Ran ran =
      run(squeezed_frame(1, 0.4,
                         "[[study]]\nname = \"how\"\nkind = \"sensitivity\"\n" + pushed_apex +
                             "sensitivity.parameters = [\"ks\", \"squeeze\"]\n"));
  const StudyResult& how = ran.of("how");
  ASSERT_TRUE(analysis::complete(how)) << how.start.message;
  EXPECT_NEAR(limit_load(how), 0.4534552257, 1e-9);
  const auto load = [](double ks, double squeeze) {
    const std::string push = "[[study]]\nname = \"push\"\n" + pushed_apex;
    return limit_load(run(squeezed_frame(ks, squeeze, push)).of("push"));
  };
  const std::size_t row = how.branches[0].events.at(0).row;
  const auto at = [&](const char* rate) {
    for (const auto& event : how.branches[0].events)
      if (event.kind == EventKind::limit_point) return value(how, event.row, rate);
    return value(how, row, rate);
  };
  EXPECT_NEAR(at("d(lambda)/d(ks)"), difference([&](double ks) { return load(ks, 0.4); }, 1, 2e-3),
              1e-8);
  EXPECT_NEAR(at("d(lambda)/d(squeeze)"),
              difference([&](double squeeze) { return load(1, squeeze); }, 0.4, 2e-3), 1e-8);
}

TEST(HistoriesOfMembers, ACriticalCurveGoesThroughTheLimitLoadsOfOtherPreloads) {
  const Ran ran = run(squeezed_frame(
      1, 0.4, "[[study]]\nname = \"follow\"\nkind = \"critical_curve\"\n" + pushed_apex + R"toml(
critical_curve = { of = "LP1", parameter = "squeeze", range = [0.05, 0.6] }
mark = { squeeze = [0.1, 0.5] }
)toml"));
  const StudyResult& follow = ran.of("follow");
  ASSERT_TRUE(analysis::complete(follow)) << follow.start.message;
  int seen = 0;
  for (const auto& event : follow.branches[0].events) {
    if (event.kind == EventKind::extremum) continue;
    const double squeeze = value(follow, event.row, "squeeze");
    const std::string push = "[[study]]\nname = \"push\"\n" + pushed_apex;
    EXPECT_NEAR(value(follow, event.row, "lambda"),
                limit_load(run(squeezed_frame(1, squeeze, push)).of("push")), 1e-9)
        << "squeeze = " << squeeze;
    ++seen;
  }
  EXPECT_GE(seen, 4);  // both ends of the range and two marks
}

const std::string held_and_pushed = R"toml(body = "apex"
control = "load"
direction = [0, -1]
start = { from = "drive", hold = ["foot.x"], loads = "own" }
until = { apex.y = [-0.9, 0.9] }
)toml";

/// The foot held at half the span a the truss turns back at l^3 = a^2 under P = 2 k (1 - l)^(3/2).
double held_limit_load(double d) {
  const double a = std::sqrt(0.75) - d / 2;
  return 200 * std::pow(1 - std::cbrt(a * a), 1.5);
}

TEST(HistoriesOfMembers, FirstCriticalLoadsAreThoseOfWhereMembersAreHeld) {
  const Ran ran = run(squeezed_frame(
      1, 0.4, "[[study]]\nname = \"first\"\nkind = \"critical_load\"\n" + held_and_pushed + R"toml(
critical_load = { parameter = "d", range = [0.1, 0.4], values = 3, of = "limit_point" }
)toml"));
  const StudyResult& first = ran.of("first");
  ASSERT_TRUE(analysis::complete(first)) << first.start.message;
  ASSERT_FALSE(first.branches.empty());
  const auto& samples = first.branches[0].samples;
  ASSERT_GT(samples.size(), 4U);
  for (std::size_t row = 0; row < samples.size(); ++row)
    EXPECT_NEAR(value(first, row, "lambda"), held_limit_load(value(first, row, "d")), 1e-9);
  EXPECT_NEAR(value(first, 0, "d"), 0.1, 1e-9);
  EXPECT_NEAR(value(first, samples.size() - 1, "d"), 0.4, 1e-9);
}

TEST(HistoriesOfMembers, ADesignChangesTheStepBefore) {
  const double wanted = held_limit_load(0.3);
  const Ran ran =
      run(squeezed_frame(1, 0.4,
                         "[[study]]\nname = \"stronger\"\nkind = \"design\"\n" + held_and_pushed +
                             "[study.design]\nstarts = 1\nparameters = { d = [0.1, 0.4] }\n"
                             "critical_load = { at_least = " +
                             digits(wanted) + ", of = \"limit_point\" }\n"));
  const StudyResult& stronger = ran.of("stronger");
  ASSERT_TRUE(stronger.design) << stronger.start.message;
  EXPECT_EQ(stronger.design->status, analysis::DesignStatus::met) << stronger.design->message;
  EXPECT_TRUE(stronger.design->verified);
  EXPECT_NEAR(stronger.design->parameters.at(0).after, 0.3, 1e-9);
}

/// A spring kv acts on the apex along y alone: P(y) = 2 k (1/l - 1) y - kv (y - 1/2) has limit points as long as
/// kv < 2 k (1/a - 1).
std::string propped_frame(double kv, const std::string& studies, double d) {
  return squeezed_frame(1, 0.4, "", d) + R"toml(
[[chain]]
name = "prop"
to = "apex"
elements = [
  { joint = "prismatic", axis = "x", name = "across" },
  { joint = "prismatic", axis = "y", name = "up", role = "preloaded", spring = { law = "linear", stiffness = )toml" +
         digits(kv) + R"toml(, free = 0.5 } },
]
)toml" + studies;
}

TEST(HistoriesOfMembers, AThresholdIsTheLargestStepBefore) {
  const double kv = 40, a = 200 / (200 + kv);
  const Ran ran = run(propped_frame(kv, R"toml([[study]]
name = "largest"
kind = "threshold"
body = "apex"
control = "load"
direction = [0, -1]
start = { from = "drive", hold = ["foot.x"], loads = "own" }
until = { lambda = [-40, 60] }
threshold = { parameter = "d", range = [0, 0.3], value = "largest", of = "limit_point" }
)toml",
                                    0.2));
  const StudyResult& largest = ran.of("largest");
  ASSERT_TRUE(largest.threshold) << largest.start.message;
  EXPECT_TRUE(largest.threshold->found) << largest.threshold->message;
  EXPECT_TRUE(largest.threshold->verified);
  EXPECT_NEAR(largest.threshold->value, 2 * (std::sqrt(0.75) - a), 1e-9);
}

/// Fixed feet at half the span a: snaps from the limit load P to the other side.
const std::string pressed_truss = R"toml([parameters]
k = 100
a = 0.9
[[node]]
name = "left"
at = ["-a", 0]
fixed = true
[[node]]
name = "right"
at = ["a", 0]
fixed = true
[[node]]
name = "apex"
at = [0, "sqrt(1 - a^2)"]
fixed = ["x"]
[[bar]]
from = "left"
to = "apex"
stiffness = "k"
[[bar]]
from = "right"
to = "apex"
stiffness = "k"
[[study]]
name = "press"
kind = "snap_through"
body = "apex"
control = "load"
direction = [0, -1]
until = { apex.y = [-0.9, 0.9] }
snap = { starts = 0 }
trace = { maximum_step = 0.2 }
[[study]]
name = "pull back"
kind = "critical_curve"
body = "apex"
control = "load"
direction = [0, 1]
start = { from = "press", at = "J1" }
until = { apex.y = [-0.9, 0.9] }
critical_curve = { of = "LP1", parameter = "a", range = [0.88, 0.92] }
trace = { maximum_step = 0.2 }
)toml";

// The load P of the jump goes on acting: from the landing it takes 2 P to come back.
TEST(HistoriesOfMembers, ACurveBeginsAtTheLandingOfAJump) {
  const Ran ran = run(pressed_truss);
  const StudyResult& back = ran.of("pull back");
  ASSERT_TRUE(analysis::complete(back)) << back.start.message;
  const auto& samples = back.branches.at(0).samples;
  ASSERT_GT(samples.size(), 4U);
  for (std::size_t row = 0; row < samples.size(); ++row) {
    const double a = value(back, row, "a");
    EXPECT_NEAR(value(back, row, "lambda"), 400 * std::pow(1 - std::cbrt(a * a), 1.5), 1e-8);
    EXPECT_LT(value(back, row, "apex.y"), 0);
  }
}

// The mark y = 0.4 is reached under P = 2 k (1/l - 1) y, which is more than 14 where l < 1/1.175.
TEST(HistoriesOfMembers, ACurveEndsWhereTheStudyBeforeLosesItsPoint) {
  const Ran ran = run(squeezed_frame(1, 0.4, R"toml([[study]]
name = "press"
body = "apex"
control = "load"
direction = [0, -1]
start = { from = "drive", hold = ["foot.x"], loads = "own" }
until = { lambda = [0, 14], apex.y = [0.35, 0.9] }
mark = { apex.y = 0.4 }
trace = { maximum_step = 0.2 }
[[study]]
name = "onwards"
kind = "critical_curve"
body = "apex"
control = "mixed"
direction = [0, -1]
start = { from = "press", at = "UZ1" }
until = { lambda = [-0.01, 0.01] }
mark = { lambda = 0.001 }
critical_curve = { of = "UZ1", parameter = "d", range = [0.19, 0.3] }
trace = { maximum_step = 0.2 }
)toml"));
  const StudyResult& onwards = ran.of("onwards");
  ASSERT_TRUE(onwards.start.found) << onwards.start.message;
  const auto& branch = onwards.branches.at(0);
  EXPECT_FALSE(branch.forward.complete);
  EXPECT_THAT(branch.forward.reason,
              HasSubstr("there is no start: study \"press\", from which it starts, has no point "
                        "\"UZ1\"; it has start, end"));
  const double last = 2 * (std::sqrt(0.75) - std::sqrt(1 / (1.175 * 1.175) - 0.16));
  EXPECT_NEAR(value(onwards, branch.samples.size() - 1, "d"), last, 1e-3);
  EXPECT_LT(value(onwards, branch.samples.size() - 1, "d"), last);
}

/// Two drives with springs k behind them carry a point.
std::string table_on_drives(const std::string& studies) {
  return R"toml([parameters]
k = 10
F = 2
[[body]]
name = "table"
task_space = "xy"
[[chain]]
name = "x"
elements = [
  { joint = "prismatic", axis = "x", name = "drive", role = "actuated", value = 0 },
  { joint = "prismatic", axis = "x", name = "spring", role = "preloaded", spring = { law = "linear", stiffness = "k" } },
  { joint = "prismatic", axis = "y", name = "free" },
]
[[chain]]
name = "y"
elements = [
  { joint = "prismatic", axis = "y", name = "drive", role = "actuated", value = 0 },
  { joint = "prismatic", axis = "y", name = "spring", role = "preloaded", spring = { law = "linear", stiffness = "k" } },
  { joint = "prismatic", axis = "x", name = "free" },
]
[[study]]
name = "load"
control = "load"
direction = [1, 0]
until = { lambda = [0, "F"] }
)toml" + studies;
}

TEST(HistoriesOfMembers, CommandsBalanceTheLoadThatIsKept) {
  const Ran ran = run(table_on_drives(R"toml([[study]]
name = "hold still"
kind = "control"
targets = [[0, 0], [0.1, 0.2]]
start = { from = "load" }
)toml"));
  const StudyResult& still = ran.of("hold still");
  ASSERT_TRUE(analysis::complete(still)) << still.start.message;
  for (std::size_t row = 0; row < 2; ++row) {
    EXPECT_NEAR(value(still, row, "x.drive.rho"), value(still, row, "table.x") - 0.2, 1e-12);
    EXPECT_NEAR(value(still, row, "y.drive.rho"), value(still, row, "table.y"), 1e-12);
  }
}

TEST(HistoriesOfMembers, EveryNodeOfAMapHasItsOwnHistory) {
  const Ran ran = run(table_on_drives(R"toml([[study]]
name = "states"
kind = "map"
command = "given"
axes = [{ parameter = "F", from = 1, to = 3, points = 3 }, { parameter = "k", from = 10, to = 20, points = 2 }]
start = { from = "load" }
)toml"));
  const StudyResult& states = ran.of("states");
  ASSERT_TRUE(states.start.found) << states.start.message;
  ASSERT_EQ(states.branches.at(0).samples.size(), 6U);
  for (std::size_t row = 0; row < 6; ++row)
    EXPECT_NEAR(value(states, row, "table.x"), value(states, row, "F") / value(states, row, "k"),
                1e-12);
}

TEST(HistoriesOfMembers, ANodeWithoutAPointToStartFromSaysSo) {
  const Ran ran = run(table_on_drives(R"toml(mark = { lambda = 1.5 }
[[study]]
name = "states"
kind = "map"
command = "given"
axes = [{ parameter = "F", from = 1, to = 2, points = 2 }]
start = { from = "load", at = "UZ1" }
)toml"));
  const auto& samples = ran.of("states").branches.at(0).samples;
  EXPECT_THAT(samples.at(0).status,
              HasSubstr("no start: study \"load\", from which it starts, has no point \"UZ1\""));
  EXPECT_EQ(samples.at(1).status, "ok");
  EXPECT_NEAR(value(ran.of("states"), 1, "table.x"), 0.15, 1e-12);
}

}  // namespace
}  // namespace springfold::io
