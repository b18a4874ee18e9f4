// What is said where a study cannot do what it was asked for.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "case_runs.hpp"
#include "springfold/analysis/snap.hpp"
#include "springfold/io/results.hpp"

namespace springfold::io {
namespace {

using analysis::StudyResult;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A bar of length 1 on a hinge of stiffness c under a load along it: it buckles at lambda = c.
const std::string upright = R"toml(
[parameters]
c = 1
[[body]]
name = "tip"
task_space = "xy"
pose = [0, 1]
[[chain]]
name = "bar"
elements = [
  { joint = "revolute", axis = "z", name = "q", role = "preloaded", spring = { law = "linear", stiffness = "c" } },
  { rigid = [0, 1] },
]
)toml";

std::string upright_study(const std::string& keys) {
  return upright + "[[study]]\nname = \"s\"\ncontrol = \"load\"\ndirection = [0, -1]\n" + keys;
}

TEST(StartOutsideOfLimits, IsSaidInTheSameWordsByAllKindsThatTrace) {
  const std::string outside = "lambda is 0 at the start, outside of its limits 0.5 to 2";
  const std::string until = "until = { lambda = [0.5, 2] }\n";
  EXPECT_EQ(run(upright_study(until)).of("s").start.outside, outside);
  for (const char* keys :
       {"kind = \"critical_curve\"\ncritical_curve = { of = \"BP1\", parameter = \"c\", range = "
        "[0.8, 1.2] }\n",
        "kind = \"sensitivity\"\nsensitivity = { parameters = [\"c\"] }\n"}) {
    const StudyResult result = run(upright_study(until + keys)).of("s");
    EXPECT_FALSE(result.start.found);
    EXPECT_EQ(result.start.message, outside);
    EXPECT_EQ(result.start.where, "until.lambda");
  }
  const StudyResult threshold =
      run(upright_study(
              until + "kind = \"threshold\"\nthreshold = { of = \"loss_of_stability\", parameter = "
                      "\"c\", range = [0.8, 1.2] }\n"))
          .of("s");
  EXPECT_THAT(threshold.doubts, ElementsAre(HasSubstr(outside)));
}

TEST(StartOutsideOfLimits, IsKnownBeforeAnythingIsTraced) {
  const std::string outside = "lambda is 0 at the start, outside of its limits 0.5 to 2";
  const std::string range = "parameter = \"c\", range = [0.8, 1.2] }\n";
  for (const std::string& keys :
       {"kind = \"critical_curve\"\ncritical_curve = { of = \"BP1\", " + range,
        "kind = \"threshold\"\nthreshold = { of = \"loss_of_stability\", " + range,
        "kind = \"critical_load\"\ncritical_load = { of = \"loss_of_stability\", values = 3, " +
            range}) {
    const Ran ran = run(upright_study("until = { lambda = [0.5, 2] }\n" + keys));
    const auto& planned = ran.read.runs.front();
    EXPECT_EQ(analysis::solve_start(planned.mechanism, planned.plan, nullptr)->outside, outside);
  }
}

TEST(CriticalCurve, SaysThatThePathToItsPointStoppedEarlyAndWhy) {
  const StudyResult result =
      run(upright_study(
              "until = { lambda = [-1, 2] }\ntrace = { maximum_points = 3, maximum_step = "
              "0.01 }\nkind = \"critical_curve\"\ncritical_curve = { of = \"BP1\", "
              "parameter = \"c\", range = [0.8, 1.2] }\n"))
          .of("s");
  EXPECT_FALSE(result.start.found);
  EXPECT_THAT(result.start.message,
              AllOf(HasSubstr("the curve has no BP1; its special points: none; "
                              "it stopped early: "),
                    HasSubstr("number of points")));
}

/// A slider along x, whose body has the pose x, y.
std::string slider(const std::string& control) {
  return R"toml(
[[body]]
name = "p"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "g"
elements = [{ joint = "prismatic", axis = "x", name = "q", role = "preloaded", spring = { law = "linear", stiffness = 2 } }]
[[study]]
name = "s"
direction = [1, 0]
until = { lambda = [-1, 1] }
control = ")toml" +
         control + "\"\n";
}

TEST(PoseControl, SaysWhereTheJointsHoldADirectionOfThePoseAlready) {
  const StudyResult result = run(slider("pose")).of("s");
  EXPECT_FALSE(result.start.found);
  EXPECT_EQ(result.start.where, "control");
  EXPECT_THAT(result.start.message, HasSubstr("holds a direction that the joints hold already"));
  EXPECT_THAT(result.start.advice, HasSubstr("control = \"mixed\""));
  EXPECT_TRUE(complete(run(slider("mixed")).of("s")));
}

/// A point on two springs of free length 1, from (0, 0) and (1, 0.3).
const std::string between_springs = R"toml(
[[body]]
name = "p"
task_space = "xy"
pose = [-0.5, 0.4]
[[spring]]
name = "a"
from_at = [0, 0]
to = "p"
stiffness = 1
free = 1
[[spring]]
name = "b"
from_at = [1, 0.3]
to = "p"
stiffness = 1
free = 1
[[study]]
name = "s"
control = "load"
direction = [0.1, -1]
until = { lambda = [-3, 3] }
)toml";

TEST(CurveThatEndsWhereASpringHasNoLength, NamesTheSpringAndWhatIsLeftOfIt) {
  const StudyResult result = run(between_springs).of("s");
  const analysis::Branch& branch = result.branches.front();
  for (const analysis::Stop& stop : {branch.backward, branch.forward}) {
    EXPECT_FALSE(stop.complete);
    EXPECT_THAT(stop.reason, AllOf(HasSubstr("the length of a has come down to "),
                                   HasSubstr("at the length 0 its force has no direction"),
                                   Not(HasSubstr("another branch"))));
  }
  // At (0, 0) spring a pushes with the force 1, in any direction: |load + force of b| = 1 there.
  const double length = std::hypot(1, 0.3), pull = (length - 1) / length;
  const double along = pull * (0.1 * 1 - 1 * 0.3) / std::hypot(0.1, 1);
  const double root = std::sqrt(along * along + 1 - (length - 1) * (length - 1));
  const std::vector<double> ends = lambdas(result, analysis::EventKind::unresolved);
  ASSERT_EQ(ends.size(), 2U);
  EXPECT_NEAR(ends[0], -along - root, 1e-5);
  EXPECT_NEAR(ends[1], -along + root, 1e-5);
}

// Together F = 2/7 x: without a force at the length 0, and still the two coordinates turn back there.
TEST(CurveThatEndsWhereASpringHasNoLength, NamesSpringsInSeriesThatPullNowhereThere) {
  const StudyResult result = run(R"toml(
[[node]]
name = "t"
at = [0.05, 0]
fixed = ["y"]
[[spring]]
name = "s"
to = "t"
series = [{ law = "linear", stiffness = 1 }, { law = "linear", stiffness = 0.4 }]
initial = 0.01
[[study]]
name = "through"
control = "mixed"
direction = [1, 0]
until = { t.x = [-1, 3] }
)toml")
                                 .of("through");
  const analysis::Stop& stop = result.branches.front().forward;
  EXPECT_FALSE(stop.complete);
  EXPECT_THAT(stop.reason, AllOf(HasSubstr("the length of s has come down to "),
                                 HasSubstr("at the length 0 its springs in series turn back")));
}

/// A bar of length 4 on a hinge between two cables that rest, r and l.
const std::string guyed = R"toml(
[[body]]
name = "tip"
task_space = "xy"
pose = [0, 4]
[[chain]]
name = "bar"
elements = [
  { joint = "revolute", axis = "-z", name = "q", role = "preloaded", spring = { law = "linear", stiffness = 0.5 } },
  { rigid = [0, 4] },
]
[[bar]]
name = "r"
from = "base"
from_at = [3, 0]
to = "tip"
stiffness = 1
tension_only = true
[[bar]]
name = "l"
from = "base"
from_at = [-3, 0]
to = "tip"
stiffness = 2
tension_only = true
[[study]]
name = "s"
kind = "snap_through"
control = "load"
direction = [0, -1]
until = { lambda = [-0.2, 6], bar.q = [-3, 3] }
)toml";

TEST(SwitchesOfAJump, LeaveOutCablesThatRestedAndAreSlackWhereItLands) {
  const Ran ran = run(guyed);
  const StudyResult& result = ran.of("s");
  ASSERT_FALSE(result.snap->jumps.empty());
  const auto& jump = result.snap->jumps.front();
  ASSERT_EQ(jump.switches.size(), 1U);
  EXPECT_THAT(jump.switches.front(), HasSubstr("spring r"));
}

TEST(RefusedQuestions, AboutStableStatesAreDoubtsWhoseReasonTheScreenShows) {
  const Ran ran =
      run(upright +
          "[[study]]\nname = \"t\"\nkind = \"transitions\"\ncontrol = \"load\"\nload = [0, -2]\n"
          "direction = [1, 0]\nuntil = { lambda = [-1, 1] }\n");
  const StudyResult& result = ran.of("t");
  EXPECT_FALSE(complete(result));
  EXPECT_THAT(result.doubts, ElementsAre(HasSubstr("the start is not stable")));
  EXPECT_THAT(summary_table(ran.read, ran.results),
              HasSubstr("UNRESOLVED: jumps: the start is not"));
}

TEST(UnreachableStart, FromWhichSpringsAreCountedNamesChainGapAndPlaceAsAnyOther) {
  // Links of 1 and 0.8 reach 1.8; the pose is 2.2 away.
  const auto start = [](const std::string& counted) {
    const Ran ran = run(
        "[[body]]\nname = \"tool\"\ntask_space = \"xy\"\npose = [2.2, 0]\n[[chain]]\nname = "
        "\"leg\"\n"
        "elements = [{ joint = \"revolute\", axis = \"z\", name = \"foot\" }, { rigid = [1, 0] }, "
        "{ "
        "joint = \"revolute\", axis = \"z\", name = \"knee\", role = \"preloaded\", initial = 0.9, "
        "spring = { law = \"linear\", stiffness = 1, " +
        counted +
        " } }, { rigid = [0.8, 0] }]\n[[study]]\nname = \"s\"\ncontrol = \"pose\"\ndirection = [0, "
        "-1]\nstart = { solve = \"wrench\" }\nuntil = { lambda = [-1, 1] }\n");
    return ran.of("s").start;
  };
  const auto counted = start("origin = \"start\""), plain = start("free = 0.9");
  EXPECT_FALSE(counted.found);
  EXPECT_THAT(counted.message, AllOf(HasSubstr("origin = \"start\""), HasSubstr(plain.message),
                                     HasSubstr("chain leg is short by 0.4")));
  EXPECT_EQ(counted.where, "body.tool");
  EXPECT_EQ(counted.advice, plain.advice);
}

TEST(EndOfTheReach, OfACrankIsItsDeadCentreWhereTheForceHasNoBound) {
  // F = c (1 - t)/sin t with cos t the place of its tip: it grows all the way to t = 0, and there is nothing else.
  const StudyResult result =
      run("[[body]]\nname = \"tip\"\ntask_space = \"xy\"\npose = [\"cos(1)\", \"sin(1)\"]\n"
          "[[chain]]\nname = \"c\"\nelements = [{ joint = \"revolute\", axis = \"z\", name = "
          "\"u\", "
          "role = \"preloaded\", initial = 1, spring = { law = \"linear\", stiffness = 1, free = 1 "
          "} "
          "}, { rigid = [1, 0] }]\n[[study]]\nname = \"s\"\ncontrol = \"mixed\"\ndirection = [1, 0]"
          "\nuntil = { deflection = [-1, 1] }\n")
          .of("s");
  EXPECT_TRUE(complete(result));
  const analysis::Branch& branch = result.branches[0];
  EXPECT_THAT(branch.forward.reason, HasSubstr("end of the reach"));
  for (std::size_t row = 0; row < branch.samples.size(); ++row) {
    const double t = value(result, row, "c.u");
    EXPECT_NEAR(value(result, row, "force"), (1 - t) / std::sin(t), 1e-9 / (t * t));
  }
}

/// A bar of length l under a moment, 3 q - q^3 at its hinge: a limit point at q = 1. Its tip is highest at q = 1/2, as
/// high as l, and may not rise above 1: from l = 1 on the path ends before its limit point.
const std::string bar_below_a_ceiling = R"toml(
[parameters]
l = 0.95
[[body]]
name = "tip"
task_space = "planar"
pose = ["l*sin(0.5)", "l*cos(0.5)", 0]
[[chain]]
name = "bar"
elements = [
  { joint = "revolute", axis = "z", name = "q", role = "preloaded", spring = { law = "polynomial", coefficients = [0, 3, 0, -1], falling = true } },
  { rigid = ["l*sin(0.5)", "l*cos(0.5)"] },
]
[[study]]
name = "s"
control = "load"
direction = [0, 0, 1]
until = { tip.y = [-2, 1], bar.q = [-1.2, 1.2] }
)toml";

TEST(EndsOfCriticalLoads, NameTheLimitThatThePathComesToFirst) {
  const std::string limit = "as the path ends first: tip.y reaches its upper limit";
  const StudyResult threshold =
      run(bar_below_a_ceiling +
          "kind = \"threshold\"\nthreshold = { of = \"limit_point\", parameter = \"l\", range = "
          "[0.9, 1.1] }\n")
          .of("s");
  ASSERT_TRUE(threshold.threshold && threshold.threshold->found);
  EXPECT_NEAR(threshold.threshold->value, 1, 1e-9);
  EXPECT_THAT(threshold.threshold->decides, HasSubstr(limit));
  EXPECT_TRUE(threshold.threshold->verified);

  const StudyResult loads =
      run(bar_below_a_ceiling +
          "kind = \"critical_load\"\ncritical_load = { of = \"limit_point\", parameter = \"l\", "
          "range = [0.9, 1.1], values = 6 }\n")
          .of("s");
  ASSERT_EQ(loads.branches.size(), 1U);
  const analysis::Branch& branch = loads.branches[0];
  EXPECT_NEAR(value(loads, branch.samples.size() - 1, "l"), 1, 1e-9);
  const auto named = [&](const analysis::Event& event) {
    return event.detail.find("ends: there is no critical point behind, " + limit) !=
           std::string::npos;
  };
  EXPECT_TRUE(std::any_of(branch.events.begin(), branch.events.end(), named));
}

TEST(EndsOfCriticalLoads, NameTheCrossingWhereThePathGoesAnotherWay) {
  // c q - e = lambda sin q, with a limit point to the right only: for e < 0 the path turns to the left.
  const std::string path = upright_study("until = { bar.q = [-1.2, 1.2], lambda = [-1, 5] }\n");
  const std::string law = "law = \"linear\", stiffness = \"c\"";
  std::string text = path;
  text.replace(text.find(law), law.size(),
               "law = \"polynomial\", coefficients = [\"-c\", 1, 0, 1, -1], falling = true");
  text.replace(text.find("c = 1"), 5, "c = 0.05");
  const StudyResult loads =
      run(text +
          "kind = \"critical_load\"\ncritical_load = { of = \"limit_point\", parameter = "
          "\"c\", range = [-0.1, 0.1], values = 6 }\n")
          .of("s");
  ASSERT_EQ(loads.branches.size(), 1U);
  EXPECT_NEAR(value(loads, 0, "c"), 0, 1e-10);
  const std::string crossing = ", as branches cross on the way to it, at lambda = 1";
  EXPECT_EQ(loads.branches[0].events.front().detail,
            "begins: there is no critical point before" + crossing);
  const StudyResult threshold =
      run(text +
          "kind = \"threshold\"\nthreshold = { of = \"limit_point\", parameter = \"c\", "
          "range = [-0.1, 0.09], value = \"largest\" }\n")
          .of("s");
  ASSERT_TRUE(threshold.threshold && threshold.threshold->found);
  EXPECT_NEAR(threshold.threshold->value, 0, 1e-10);
  EXPECT_THAT(threshold.threshold->decides, HasSubstr(crossing));
}

/// Both cables of an elastic mast become taut at one height: the mast stays upright there, or leans to either side.
TEST(ToldReasons, NameTheKeyThatFollowsSeveralWaysOutOfAKink) {
  const auto mast = [](const char* depth) {
    return std::string{R"toml(
[[body]]
name = "top"
task_space = "xy"
pose = [0, 1]
[[chain]]
name = "mast"
elements = [ { joint = "revolute", axis = "z", name = "foot", role = "preloaded", spring = { law = "linear", stiffness = 0.0156 } }, { joint = "prismatic", axis = "y", name = "ax", role = "virtual", stiffness = 27, initial = 0 }, { rigid = [0, 1] } ]
[[spring]]
name = "c1"
from_at = [0.7, 1.6]
to = "top"
law = { law = "one_sided", stiffness = 1.16, from = 0.92288 }
[[spring]]
name = "c2"
from_at = [-0.7, 1.6]
to = "top"
law = { law = "one_sided", stiffness = 1.16, from = 0.92288 }
[[study]]
name = "press"
control = "load"
direction = [0, -1]
until = { lambda = [-2.5, 1.5], top.y = [0.5, 1.4], top.x = [-0.5, 0.5] }
branches = { depth = )toml"} +
           depth + " }\n";
  };
  const auto stays = run(mast("0")), goes_on = run(mast("1"));
  const auto& branch = stays.of("press").branches.at(0);
  EXPECT_FALSE(branch.forward.complete);
  EXPECT_THAT(branch.forward.reason, HasSubstr("branches.depth = 1"));
  EXPECT_TRUE(complete(goes_on.of("press")));
}

}  // namespace
}  // namespace springfold::io
