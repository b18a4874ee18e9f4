// A post of length 1 on a torsion spring, bent by a weight W on its tip, that a load P upwards straightens:
// E = k a^2 / 2 + (W - P) cos a. It is bent while W - P > k and straight from P = W - k on, stable all the way: the
// branch point there is no loss of stability.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "case_runs.hpp"
#include "springfold/analysis/design.hpp"

namespace springfold::io {
namespace {

using analysis::EventKind;
using analysis::StudyResult;

/// @param bar  what lies between the foot and the tip
std::string post(const std::string& bar) {
  return R"toml(
[parameters]
k = 1
W = 1.5
e = 0.01

[[body]]
name = "tip"
task_space = "xy"
pose = [0.99, 0.09]

[[chain]]
name = "bar"
elements = [
  { joint = "revolute", axis = "-z", name = "foot", role = "preloaded", initial = 1.49, spring = { law = "linear", stiffness = "k" } },
  )toml" +
         bar + "\n]\n\n";
}

const char* const rigid = "{ rigid = [0, 1] },";

/// Its load is 100 times the stretch, and falls from a stretch of e on: then P = W + 100 e, and a limit point is there.
const char* const tears =
    R"toml({ joint = "prismatic", axis = "y", name = "slide", initial = 1, role = "preloaded", spring = { law = "piecewise_linear", breakpoints = ["1 + e"], stiffnesses = [100, -50], falling = true, free = 1 } },)toml";

std::string study(const std::string& kind, const std::string& rest) {
  return "[[study]]\nname = \"" + kind + "\"\nkind = \"" + kind +
         "\"\ncontrol = \"load\"\ndirection = [0, 1]\nload = [0, \"-W\"]\n"
         "until = { lambda = [-1, 5] }\n" +
         rest + "\n";
}

TEST(StraighteningLoads, LoseNoStabilityWhereTheyHaveStraightenedWhatWasBent) {
  for (const std::string of : {"loss_of_stability", "limit_point"}) {
    SCOPED_TRACE(of);
    const StudyResult result =
        run(post(rigid) + study("critical_load", "critical_load = { of = \"" + of +
                                                     "\", parameter = \"k\", range = [0.8, 1.3], "
                                                     "values = 6 }"))
            .of("critical_load");
    EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
    EXPECT_TRUE(result.branches.empty());
  }
}

TEST(StraighteningLoads, HaveNoThresholdBelowWhichTheyStraighten) {
  const StudyResult result =
      run(post(rigid) + study("threshold",
                              "threshold = { of = \"loss_of_stability\", parameter = \"W\", value "
                              "= \"largest\", range = [1.2, 2] }"))
          .of("threshold");
  ASSERT_TRUE(result.threshold);
  EXPECT_TRUE(result.threshold->found);
  EXPECT_EQ(result.threshold->value, 2);
}

/// Rows of marks and extrema lie at the straight state, or so near that the load between is rounding.
TEST(StraighteningLoads, LoseNothingWhateverElseIsAskedForThere) {
  for (const std::string rest :
       {"mark = { tip.x = [0] }\n", "mark = { bar.foot = [0] }\n", "extrema = [\"tip.y\"]\n",
        "extrema = [\"energy\"]\n", "mark = { bar.foot = [1e-8] }\n",
        "mark = { bar.foot = [1e-9] }\n", "mark = { bar.foot = [-1e-12] }\n"}) {
    SCOPED_TRACE(rest);
    const StudyResult result =
        run(post(rigid) + study("critical_load",
                                rest + "critical_load = { of = \"loss_of_stability\", parameter = "
                                       "\"W\", range = [1.2, 2], values = 5 }"))
            .of("critical_load");
    EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
    EXPECT_TRUE(result.branches.empty());
  }
}

/// The path ends just behind the branch point, before the load at which the straight one loses its stability.
TEST(StraighteningLoads, EndAtLimitsJustBehindTheBranchPoint) {
  for (const std::string gap : {"1e-8", "1e-6", "1e-4", "2e-4", "1e-3"}) {
    SCOPED_TRACE(gap);
    // N (1 - N / 100) = 1
    std::string text =
        post(tears) +
        study("critical_load",
              "critical_load = { of = \"loss_of_stability\", parameter = \"k\", range "
              "= [0.999, 1], values = 2 }");
    const std::string whole = "lambda = [-1, 5]";
    text.replace(text.find(whole), whole.size(),
                 "lambda = [-1, \"W - 50*(1 - sqrt(1 - 0.04*k)) + " + gap + "\"]");
    const StudyResult result = run(text).of("critical_load");
    EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
    EXPECT_TRUE(result.branches.empty());
  }
}

TEST(StraighteningLoads, LoseStabilityWhereTheStraightOneLosesIt) {
  const StudyResult result =
      run(post(tears) + study("critical_load",
                              "critical_load = { of = \"loss_of_stability\", parameter = \"W\", "
                              "range = [1.2, 2], values = 6 }"))
          .of("critical_load");
  EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
  ASSERT_EQ(result.branches.size(), 1u);
  for (const auto& sample : result.branches[0].samples)
    EXPECT_NEAR(sample.values[column(result, "lambda")], sample.values.back() + 1, 1e-9);
}

TEST(StraighteningLoads, AreDesignedForTheLossOfTheStraightOne) {
  const StudyResult result =
      run(post(tears) + study("design",
                              "design = { parameters = { e = [0.001, 0.05] }, critical_load = { "
                              "at_least = 3 } }"))
          .of("design");
  EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
  ASSERT_TRUE(result.design);
  EXPECT_TRUE(result.design->verified);
  EXPECT_NEAR(result.design->parameters.at(0).after, 0.015, 1e-9);
}

/// The post on a foot that is stiffer or softer to the other side: it rests at the threshold when it is straight.
std::string post_on_two_stiffnesses(const std::string& left, const std::string& right) {
  std::string text = post(rigid);
  const std::string linear = "{ law = \"linear\", stiffness = \"k\" }";
  return text.replace(text.find(linear), linear.size(),
                      "{ law = \"piecewise_linear\", breakpoints = [0], stiffnesses = [\"" + left +
                          "\", \"" + right + "\"] }");
}

const char* const loss_over_weight =
    "critical_load = { of = \"loss_of_stability\", parameter = \"W\", range = [1.2, 2], values = 5 "
    "}";

TEST(StraighteningLoads, LoseNothingWhereASpringRestsThatIsStifferToTheOtherSide) {
  const StudyResult result =
      run(post_on_two_stiffnesses("k + 2", "k") + study("critical_load", loss_over_weight))
          .of("critical_load");
  EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
  EXPECT_TRUE(result.branches.empty());
}

/// The straight post stands only from W - k + 0.5 on: it falls to the other side.
TEST(StraighteningLoads, LoseStabilityWhereASpringRestsThatIsSofterToTheOtherSide) {
  const StudyResult result =
      run(post_on_two_stiffnesses("k - 0.5", "k") + study("critical_load", loss_over_weight))
          .of("critical_load");
  EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
  ASSERT_EQ(result.branches.size(), 1u);
  EXPECT_EQ(result.branches[0].samples.front().values.back(), 1.2);
  EXPECT_EQ(result.branches[0].samples.back().values.back(), 2);
  for (const auto& sample : result.branches[0].samples)
    EXPECT_NEAR(sample.values[column(result, "lambda")], sample.values.back() - 1, 1e-9);
}

/// Straight from the start, and bent away from it to the side on which the spring is soft: there is nothing to lose.
TEST(StraighteningLoads, LoseNoStabilityThatIsNotThereWhereASpringRestsAtTheStart) {
  const StudyResult result =
      run(post_on_two_stiffnesses("k", "k + 2") + study("critical_load", loss_over_weight))
          .of("critical_load");
  EXPECT_TRUE(result.branches.empty());
  ASSERT_EQ(result.doubts.size(), 1u);
  EXPECT_NE(result.doubts[0].find("the start is unstable itself"), std::string::npos);
}

/// Two links of length 1 on springs of stiffness 1, bent by a weight W; a load lifts the tip by lambda and presses the
/// joint between them down by 2 lambda. Upright its first link leans under W - lambda + 2 lambda, its second under
/// W - lambda: it stands while (2 - W - lambda) (1 - W + lambda) > 1, which is so from lambda_1 on up to lambda_2.
/// There the chain is stretched.
std::string two_links(const std::string& foot) {
  return R"toml(
[parameters]
W = 0.4
[[body]]
name = "tip"
task_space = "xy"
pose = [1.68, 1.03]
[[chain]]
name = "c"
elements = [
  { joint = "revolute", axis = "z", name = "j0", role = "preloaded", initial = 0.4, spring = )toml" +
         foot + R"toml( },
  { rigid = [1, 0] },
  { point = "mid" },
  { joint = "revolute", axis = "z", name = "j1", role = "preloaded", initial = 0.3, spring = { law = "linear", stiffness = 1 } },
  { rigid = [1, 0] },
]
[[load]]
on = "tip"
force = ["-W", 0]
[[study]]
name = "first"
kind = "critical_load"
body = "tip"
control = "load"
loads = [{ on = "tip", force = [1, 0], scale = "lambda" }, { on = "c.mid", force = [-2, 0], scale = "lambda" }]
until = { lambda = [-0.5, 3], "c.j0" = [-3, 3], "c.j1" = [-3, 3] }
critical_load = { of = "loss_of_stability", parameter = "W", range = [0.39, 0.42], values = 4 }
)toml";
}

/// @param side  +1: lambda_2, -1: lambda_1
double load_of_two_links(double W, double side) {
  const double b = 1 - (2 - W) * (1 - W);
  return 0.5 * (1 + side * std::sqrt(1 - 4 * b));
}

void expect_two_links(const std::string& foot, double side) {
  const StudyResult result = run(two_links(foot)).of("first");
  EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
  ASSERT_EQ(result.branches.size(), 1u);
  const auto& samples = result.branches[0].samples;
  EXPECT_NEAR(samples.front().values.back(), 0.39, 1e-12);
  EXPECT_NEAR(samples.back().values.back(), 0.42, 1e-12);
  for (const auto& sample : samples)
    EXPECT_NEAR(sample.values[column(result, "lambda")],
                load_of_two_links(sample.values.back(), side), 1e-9);
}

TEST(StraighteningLoads, OfStretchedChainsAreFollowedBeyondTheStraightState) {
  expect_two_links("{ law = \"linear\", stiffness = 1 }", 1);
}

TEST(StraighteningLoads, MeetTheStretchedChainAtABranchPointThatIsFollowedOverAParameter) {
  std::string text = two_links("{ law = \"linear\", stiffness = 1 }");
  const std::string kind = "kind = \"critical_load\"",
                    key =
                        "critical_load = { of = \"loss_of_stability\", parameter = \"W\", range = "
                        "[0.39, 0.42], values = 4 }";
  text.replace(text.find(kind), kind.size(), "kind = \"critical_curve\"");
  text.replace(text.find(key), key.size(),
               "critical_curve = { of = \"KS1\", parameter = \"W\", range = [0.39, 0.42] }");
  const StudyResult result = run(text).of("first");
  EXPECT_TRUE(complete(result)) << testing::PrintToString(result.doubts);
  ASSERT_EQ(result.branches.size(), 1u);
  for (const auto& sample : result.branches[0].samples)
    EXPECT_NEAR(sample.values[column(result, "lambda")],
                load_of_two_links(sample.values.back(), -1), 1e-9);
}

/// A spring that is stiffer on one side makes the branch point a crossing: the path goes on unstable.
TEST(StraighteningLoads, LoseStabilityWhereTheStretchedChainIsACrossing) {
  expect_two_links(
      "{ law = \"polynomial\", coefficients = [0, 1, 0.3], falling = true, range = [-1.5, 3] }",
      -1);
}

TEST(StraighteningLoads, AreFollowedBeyondTheStraightStateAtTheNodesOfMaps) {
  const std::string map =
      "[[study]]\nname = \"map\"\nkind = \"map\"\ncommand = \"given\"\nload = [0, \"-W\"]\n"
      "axes = [ { parameter = \"W\", from = 1.2, to = 2, points = 3 } ]\n"
      "critical = { direction = [0, 1], up_to = 5 }\n";
  const StudyResult torn = run(post(tears) + map).of("map"),
                    never = run(post(rigid) + map).of("map");
  for (std::size_t row = 0; row < 3; ++row) {
    EXPECT_NEAR(value(torn, row, "critical_load"), value(torn, row, "W") + 1, 1e-9);
    EXPECT_TRUE(std::isinf(value(never, row, "critical_load")));
  }
}

}  // namespace
}  // namespace springfold::io
