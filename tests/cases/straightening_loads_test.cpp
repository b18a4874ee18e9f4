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
