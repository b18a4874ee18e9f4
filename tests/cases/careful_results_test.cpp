// What users stumble over: coupled preloads, rigid chains, thresholds met exactly, guided bodies, slopes and
// marks at the start, counts that change while a body is held, starts that fail.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "case_runs.hpp"
#include "springfold/analysis/equilibrium_notes.hpp"
#include "springfold/io/results.hpp"
#include "springfold/io/start_text.hpp"

namespace springfold::io {
namespace {

using analysis::Event;
using analysis::EventKind;
using analysis::StudyResult;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::vector<Event> events_of(const StudyResult& result, EventKind kind) {
  std::vector<Event> list;
  for (const Event& event : result.branches.at(0).events)
    if (event.kind == kind) list.push_back(event);
  return list;
}

std::vector<double> values_at(const StudyResult& result, EventKind kind, const std::string& name) {
  std::vector<double> list;
  for (const Event& event : events_of(result, kind)) list.push_back(value(result, event.row, name));
  return list;
}

const std::string forearm = R"toml(
[[body]]
name = "hand"
task_space = "planar"
pose = ["cos(0.4) + 0.8*cos(0.9)", "sin(0.4) + 0.8*sin(0.9)", 0.9]
[[chain]]
name = "arm"
)toml";

const std::string lift = R"toml(
[[study]]
name = "lift"
control = "load"
direction = [0.6, 0.8, 0]
until = { lambda = [-0.5, 2] }
mark = { arm.shoulder = [0.1, 0.15, 0.2] }
)toml";

TEST(CoupledPreload, GivesTheSameCurveForRelativeAndForAbsoluteAngles) {
  // The springs act on the angles against the base, 3 (q1 - 0.1) and 2 (q1 + q2 - 0.3).
  const Ran relative = run(forearm + R"toml(
elements = [
  { joint = "revolute", axis = "z", name = "shoulder", role = "preloaded", initial = 0.4 },
  { rigid = [1, 0] },
  { joint = "revolute", axis = "z", name = "elbow", role = "preloaded", initial = 0.5 },
  { rigid = [0.8, 0] },
]
coupled_springs = [{ joints = ["elbow", "shoulder"], stiffness = [[2, 2], [2, 5]], free = [0.2, 0.1] }]
)toml" + lift);
  const Ran absolute = run(forearm + R"toml(
elements = [
  { joint = "revolute", axis = "z", name = "shoulder", role = "preloaded", initial = 0.4, spring = { law = "linear", stiffness = 3, free = 0.1 } },
  { rigid = [1, 0] },
  { joint = "revolute", axis = "z", name = "elbow", initial = 0.5 },
  { rigid = [0.8, 0] },
]
[[chain]]
name = "level"
elements = [
  { joint = "prismatic", axis = "x", name = "x", initial = "cos(0.4) + 0.8*cos(0.9)" },
  { joint = "prismatic", axis = "y", name = "y", initial = "sin(0.4) + 0.8*sin(0.9)" },
  { joint = "revolute", axis = "z", name = "angle", role = "preloaded", initial = 0.9, spring = { law = "linear", stiffness = 2, free = 0.3 } },
]
)toml" + lift);
  const auto a = values_at(relative.of("lift"), EventKind::user_value, "lambda");
  const auto b = values_at(absolute.of("lift"), EventKind::user_value, "lambda");
  ASSERT_THAT(a, SizeIs(testing::Ge(1u)));
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-10);
}

/// Two bars with a spring between them, pressed; `more` chains and bodies.
std::string careful_column(const std::string& more) {
  return R"toml(
[[body]]
name = "mid"
task_space = "planar"
pose = [0, 0.5, "90*deg"]
[[body]]
name = "tip"
task_space = "xy"
pose = [0, 1]
)toml" + more +
         R"toml(
[[chain]]
name = "lower"
to = "mid"
elements = [{ joint = "revolute", axis = "z", name = "foot", initial = "90*deg" }, { rigid = [0.5, 0] }]
[[chain]]
name = "upper"
from = "mid"
to = "tip"
elements = [{ joint = "revolute", axis = "z", name = "h", role = "preloaded", spring = { law = "linear", stiffness = 1 } }, { rigid = [0.5, 0] }]
[[chain]]
name = "guide"
to = "tip"
elements = [{ joint = "prismatic", axis = "y", name = "s", initial = 1 }]
[[study]]
name = "press"
body = "tip"
control = "load"
direction = [0, -1]
until = { lambda = [0, 10] }
[[study]]
name = "all"
body = "tip"
kind = "equilibria"
search = { starts = 25 }
load = [0, -5]
)toml";
}

TEST(ChainWithoutJoints, HoldsABodyRigidlyToAnother) {
  const Ran plain = run(careful_column(""));
  const Ran welded = run(careful_column(R"toml(
[[body]]
name = "twin"
task_space = "xy"
pose = [0, 0.5]
[[chain]]
name = "same"
from = "mid"
to = "twin"
elements = [{ rigid = [0, 0] }]
)toml"));
  // Two hinged bars of 1/2 turn by t each: P t^2/2 against k (2 t)^2/2, so P = 4 k/l = 4.
  const auto critical = lambdas(welded.of("press"), EventKind::branch_point);
  ASSERT_THAT(critical, SizeIs(1));
  EXPECT_NEAR(critical[0], 4, 1e-9);
  EXPECT_EQ(lambdas(plain.of("press"), EventKind::branch_point).size(), 1u);
  // 4 t = 5 sin t has three solutions, and hanging is the fourth. Folded bars turn about the foot as they like.
  for (const Ran* ran : {&plain, &welded}) {
    ASSERT_TRUE(ran->of("all").equilibria.has_value());
    EXPECT_EQ(std::ranges::count_if(ran->of("all").equilibria->list,
                                    [](const analysis::Equilibrium& e) {
                                      return !e.note.starts_with(analysis::family_note);
                                    }),
              4);
  }
}

/// A point that slides freely, or is held by as many bars, on springs from three feet.
std::string three_springs(bool as_bars, int starts) {
  std::string text = R"toml(
[[body]]
name = "p"
task_space = "xy"
pose = [0.1, 0.2]
)toml";
  const double feet[3][2] = {{-1, 0}, {1, 0.1}, {0.1, 1.4}};
  for (int i = 0; i < 3; ++i) {
    const std::string name(1, static_cast<char>('a' + i));
    const std::string at = std::to_string(feet[i][0]) + ", " + std::to_string(feet[i][1]);
    if (as_bars)
      text += "[[chain]]\nname = \"" + name + "\"\nfrom_at = [" + at + R"toml(]
elements = [
  { joint = "revolute", axis = "z", name = "foot" },
  { joint = "prismatic", axis = "x", name = "bar", role = "virtual", initial = 1, spring = { law = "linear", stiffness = 1, free = 1.9 } },
]
)toml";
    else
      text += "[[spring]]\nname = \"" + name + "\"\nfrom_at = [" + at +
              "]\nto = \"p\"\nstiffness = 1\nfree = 1.9\n";
  }
  if (!as_bars)
    text += R"toml(
[[chain]]
name = "guide"
elements = [{ joint = "prismatic", axis = "x", name = "x" }, { joint = "prismatic", axis = "y", name = "y" }]
)toml";
  return text + "[[study]]\nname = \"all\"\nkind = \"equilibria\"\nsearch = { starts = " +
         std::to_string(starts) + " }\nload = [0.02, -0.03]\n";
}

TEST(MorseCount, AppliesToPointsOnLineSpringsAsItDoesToBars) {
  const Ran springs = run(three_springs(false, 100)), bars = run(three_springs(true, 100));
  const auto& a = *springs.of("all").equilibria;
  const auto& b = *bars.of("all").equilibria;
  ASSERT_TRUE(a.morse.applies) << a.morse.why;
  ASSERT_TRUE(b.morse.applies) << b.morse.why;
  EXPECT_EQ(a.morse.expected, b.morse.expected);
  EXPECT_EQ(a.morse.found, a.morse.expected);
  // Bars have more equilibria: those with negative lengths.
  EXPECT_LE(a.list.size(), b.list.size());
}

TEST(MorseCount, MakesTheSearchTakeMoreStartsWhereSomeAreMissing) {
  const Ran few = run(three_springs(false, 1));
  const StudyResult& result = few.of("all");
  ASSERT_TRUE(result.equilibria->morse.applies);
  const bool agrees = result.equilibria->morse.found == result.equilibria->morse.expected;
  EXPECT_EQ(result.doubts.empty(), agrees);
  EXPECT_TRUE(agrees || result.equilibria->starts >= 16) << result.equilibria->starts;
}

/// A point between two drives of stiffness 10; a stop of stiffness 5 acts beyond x = 1/2.
const std::string stopped = R"toml(
[[body]]
name = "p"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "ax"
elements = [{ joint = "prismatic", axis = "x", name = "d", role = "actuated", value = 0, stiffness = 10 }, { joint = "prismatic", axis = "y", name = "f" }]
[[chain]]
name = "ay"
elements = [{ joint = "prismatic", axis = "y", name = "d", role = "actuated", value = 0, stiffness = 10 }, { joint = "prismatic", axis = "x", name = "f" }]
[[chain]]
name = "stop"
elements = [{ joint = "prismatic", axis = "x", name = "s", role = "preloaded", spring = { law = "one_sided", stiffness = 5, from = 0.5 } }, { joint = "prismatic", axis = "y", name = "f" }]
[[study]]
name = "go"
kind = "control"
direction = [1, 0]
targets = [[0.2, 0], [0.5, 0], [0.8, 0]]
[[study]]
name = "stand"
kind = "equilibrium"
direction = [1, 0]
start = { pose = [0.5, 0], solve = "wrench" }
[[study]]
name = "push"
control = "load"
direction = [1, 0]
until = { lambda = [0, 10] }
mark = { lambda = [0, 7], p.x = [0] }
)toml";

TEST(SwitchAtATarget, IsReportedThereWithTheStiffnessOnBothSides) {
  const Ran ran = run(stopped);
  const StudyResult& go = ran.of("go");
  EXPECT_TRUE(complete(go));
  const auto switches = events_of(go, EventKind::switching);
  ASSERT_THAT(switches, SizeIs(1));
  EXPECT_THAT(switches[0].detail, HasSubstr("stop.s"));
  EXPECT_NEAR(value(go, switches[0].row, "path"), 2, 1e-9);
  EXPECT_NEAR(value(go, switches[0].row, "stiffness"), 10, 1e-9);
  EXPECT_NEAR(value(go, switches[0].row + 1, "stiffness"), 15, 1e-9);
}

TEST(EquilibriumOnAThreshold, HasOneStiffnessForEachSide) {
  const Ran ran = run(stopped);
  const StudyResult& stand = ran.of("stand");
  ASSERT_THAT(stand.start.sides, SizeIs(2));
  EXPECT_NEAR(stand.start.sides[0].stiffness(0, 0), 10, 1e-9);
  EXPECT_NEAR(stand.start.sides[1].stiffness(0, 0), 15, 1e-9);
  EXPECT_THAT(stand.start.situation, HasSubstr("threshold"));
  EXPECT_THAT(summary_table(ran.read, ran.results), HasSubstr("springs on their thresholds"));
}

TEST(MarksAtTheStart, AreMarkedValues) {
  const Ran ran = run(stopped);
  const auto marked = values_at(ran.of("push"), EventKind::user_value, "lambda");
  ASSERT_THAT(marked, SizeIs(3));
  EXPECT_NEAR(marked[0], 0, 1e-12);
  EXPECT_NEAR(marked[1], 0, 1e-12);
  EXPECT_NEAR(marked[2], 7, 1e-9);
}

TEST(ExpectedValues, AreTakenOnTheSideThatIsAskedFor) {
  const Ran ran = run(stopped);
  const auto ours = [&](const std::string& study, const std::string& at, Side side,
                        const std::string& quantity, const std::string& per = "") {
    ExpectedValue value;
    value.study = study;
    value.at = at;
    value.side = side;
    value.quantity = quantity;
    value.per = per;
    return compare({{value}, {}}, ran.results).front().ours;
  };
  EXPECT_NEAR(ours("push", "SA1", Side::unsaid, "stiffness"), 10, 1e-9);
  EXPECT_NEAR(ours("push", "SA1", Side::before, "stiffness"), 10, 1e-9);
  EXPECT_NEAR(ours("push", "SA1", Side::after, "stiffness"), 15, 1e-9);
  EXPECT_NEAR(ours("push", "start", Side::unsaid, "force", "deflection"), 10, 1e-9);
  EXPECT_NEAR(ours("go", "target 3", Side::unsaid, "ax.d.rho"), 0.8 + 0.15, 1e-9);
}

TEST(GuidedBody, HasAStiffnessAlongItsGuide) {
  const Ran ran = run(R"toml(
[[body]]
name = "p"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "spring"
elements = [{ joint = "prismatic", axis = "x", name = "s", role = "virtual", stiffness = 4 }]
[[study]]
name = "push"
control = "load"
direction = [0.6, 0.8]
until = { lambda = [0, 1] }
)toml");
  const StudyResult& push = ran.of("push");
  // The body moves along x only: a unit force along n moves it by 0.6 * 0.6 / 4 along n.
  EXPECT_NEAR(value(push, push.branches[0].start_row, "stiffness"), 4 / 0.36, 1e-9);
}

TEST(HeldBody, ShowsWhereStabilityUnderDeadLoadIsLost) {
  const Ran ran = run(R"toml(
[[body]]
name = "tip"
task_space = "xy"
pose = [1, 0]
[[chain]]
name = "strut"
elements = [
  { joint = "revolute", axis = "z", name = "hinge", role = "preloaded", spring = { law = "linear", stiffness = 1 } },
  { joint = "prismatic", axis = "x", name = "length", role = "virtual", stiffness = 10 },
  { rigid = [1, 0] },
]
[[study]]
name = "press"
control = "pose"
direction = [-1, 0]
until = { lambda = [-0.1, 0.3] }
)toml");
  const StudyResult& press = ran.of("press");
  // Sideways stiffness k/r^2 - N/r with N = 10 (1 - r) is zero where 10 (1 - r) r = 1.
  const auto places = lambdas(press, EventKind::stability_change);
  ASSERT_THAT(places, SizeIs(1));
  EXPECT_NEAR(places[0], 1 - (1 + std::sqrt(0.6)) / 2, 1e-11);
  EXPECT_TRUE(complete(press));
}

std::string start_message(const std::string& text) {
  const Ran ran = run(text);
  return start_problem(ran.results.front().start, &ran.read.runs.front());
}

const std::string rod = R"toml(
[[body]]
name = "p"
task_space = "xy"
pose = [1, 0]
[[chain]]
name = "rod"
elements = [{ joint = "revolute", axis = "z", name = "foot", role = "preloaded", spring = { law = "linear", stiffness = 1 } }, { rigid = [1, 0] }]
[[study]]
name = "s"
)toml";

TEST(StartMessages, NameTheChainThatIsShortAndAPoseThatIsReached) {
  EXPECT_THAT(
      start_message(rod +
                    "kind = \"equilibrium\"\nstart = { pose = [1.5, 0], solve = \"wrench\" }\n"),
      AllOf(ContainsRegex("toml:[0-9]+:[0-9]+: study.1..start.pose: "),
            HasSubstr("the pose [1.5, 0] cannot be reached: chain rod is short by 0.5;"),
            HasSubstr("is [1, 0]")));
}

TEST(StartMessages, GiveValueAndLimitsWhereTheStartIsOutside) {
  EXPECT_THAT(
      start_message(rod + "control = \"load\"\ndirection = [0, 1]\nuntil = { lambda = [1, 2] }\n"),
      AllOf(ContainsRegex("study.1..until.lambda: "),
            HasSubstr("lambda is 0 at the start, outside of its limits 1 to 2")));
}

TEST(StartMessages, NameTheMotionThatNothingResists) {
  const Ran ran = run(R"toml(
[[body]]
name = "p"
task_space = "xy"
pose = [1, 0]
[[chain]]
name = "rod"
elements = [{ joint = "revolute", axis = "z", name = "foot" }, { rigid = [1, 0] }]
[[study]]
name = "s"
control = "load"
direction = [0, 1]
until = { lambda = [0, 1] }
)toml");
  EXPECT_THAT(ran.of("s").start.free_motions, HasSubstr("p.y"));
  EXPECT_THAT(ran.of("s").start.free_motions, HasSubstr("rod.foot"));
}

}  // namespace
}  // namespace springfold::io
