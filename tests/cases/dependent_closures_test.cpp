// Loops some of whose closures depend on the others wherever all hold, and only there: states in which the chains have
// a gap are none, and jumps are followed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "case_runs.hpp"
#include "springfold/analysis/snap.hpp"

namespace springfold::io {
namespace {

using analysis::StudyResult;

/// Bennett's linkage with the lengths 1 and 2 and the twists 30 and 90 degrees, a bistable spring in its first joint:
/// tan(t1/2) tan(t2/2) = sin 60 / sin 30 (Bennett 1914). Three of its twelve closures depend on the others.
std::string bennett(const std::string& study) {
  return R"toml(
[[body]]
name = "coupler"
task_space = "spatial"
pose = [-1.2699, 0, 0.6834, 0, -1.4933, -2.0367]
[[chain]]
name = "A"
elements = [
  { joint = "revolute", axis = "z", name = "t1", initial = 1.2, role = "preloaded", spring = { law = "polynomial", coefficients = [0, -1, 0, 4], free = 1.7, falling = true } },
  { rigid = { at = [1, 0, 0], rotate = { axis = "x", angle = "30*deg" } } },
  { joint = "revolute", axis = "z", name = "t2", initial = 2.38924 },
  { rigid = { at = [2, 0, 0], rotate = { axis = "x", angle = "90*deg" } } },
]
[[chain]]
name = "B"
elements = [
  { rigid = { rotate = { axis = "x", angle = "-90*deg" } } },
  { rigid = [-2, 0, 0] },
  { joint = "revolute", axis = "-z", name = "t4", initial = -2.38924 },
  { rigid = { rotate = { axis = "x", angle = "-30*deg" } } },
  { rigid = [-1, 0, 0] },
  { joint = "revolute", axis = "-z", name = "t3", initial = -1.2 },
]
)toml" + study;
}

double bennett_ratio(double t1, double t2) { return std::tan(t1 / 2) * std::tan(t2 / 2); }

TEST(DependentClosures, OfBennettsLinkageHoldInAllEquilibria) {
  const Ran ran = run(bennett(R"toml(
[[study]]
name = "all"
kind = "equilibria"
loads = [{ on = "coupler", at = [0.3, 0.9, -0.4], force = [0.04, -0.015, -0.035], scale = "constant" }]
until = { A.t1 = [0.6, 2.8] }
search = { starts = 60 }
)toml"));
  const StudyResult& result = ran.of("all");
  std::vector<std::pair<double, double>> states;  // t1, index
  for (const analysis::Equilibrium& one : result.equilibria->list) {
    const auto at = [&](const char* name) {
      return one.sample.values[analysis::column(result, name)];
    };
    states.emplace_back(at("A.t1"), at("index"));
    EXPECT_NEAR(bennett_ratio(at("A.t1"), at("A.t2")), std::sqrt(3.0), 1e-9);
    EXPECT_NEAR(at("A.t1"), -at("B.t3"), 1e-9);
    EXPECT_NEAR(at("A.t2"), -at("B.t4"), 1e-9);
  }
  std::sort(states.begin(), states.end());
  // One freedom: stable states and unstable ones in turn.
  ASSERT_EQ(states.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(states[i].second, i == 1 ? 1 : 0) << i;
}

TEST(DependentClosures, OfBennettsLinkageLetItJumpThereAndBack) {
  const Ran ran = run(bennett(R"toml(
[[study]]
name = "snap"
kind = "snap_through"
control = "load"
loads = [{ on = "coupler", at = [0.3, 0.9, -0.4], force = [0.8, -0.3, -0.7], scale = "lambda" }]
until = { lambda = [-2, 2], A.t1 = [0.6, 2.8] }
)toml"));
  const StudyResult& result = ran.of("snap");
  EXPECT_TRUE(result.doubts.empty());
  ASSERT_TRUE(result.snap != nullptr);
  ASSERT_EQ(result.snap->jumps.size(), 2u);
  for (const analysis::Jump& jump : result.snap->jumps) {
    EXPECT_EQ(jump.verdict, analysis::SnapVerdict::unambiguous);
    ASSERT_FALSE(jump.landing.values.empty());
    const double t1 = jump.landing.values[analysis::column(result, "A.t1")],
                 t2 = jump.landing.values[analysis::column(result, "A.t2")];
    EXPECT_NEAR(bennett_ratio(t1, t2), std::sqrt(3.0), 1e-9);
  }
}

/// A coupler on three equal parallel cranks: the third one repeats what the others say.
TEST(DependentClosures, OfThreeParallelCranksHoldInAllEquilibria) {
  std::string text = R"toml(
[[body]]
name = "coupler"
task_space = "planar"
pose = ["1.5*cos(0.4)", "1.5*sin(0.4)", 0]
)toml";
  const double feet[] = {0, 0.6, 3.5};
  const char* const free[] = {"-0.8", "0.2", "1.1"};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string number = std::to_string(i), at = std::to_string(feet[i]);
    text +=
        "[[chain]]\nname = \"c" + number + "\"\nfrom_at = [" + at + ", 0]\nto_at = [" + at +
        ", 0]\nelements = [{ joint = \"revolute\", axis = \"z\", name = \"foot\", initial = 0.4, "
        "role = \"preloaded\", spring = { law = \"linear\", stiffness = 0.3, free = " +
        free[i] +
        " } }, { rigid = [1.5, 0] }, { joint = \"revolute\", axis = \"z\", name = \"head\", "
        "initial = -0.4 }]\n";
  }
  const Ran ran = run(text + R"toml(
[[study]]
name = "all"
kind = "equilibria"
loads = [{ on = "coupler", force = [-0.7, -0.5], scale = "constant" }]
search = { starts = 40 }
)toml");
  const StudyResult& result = ran.of("all");
  ASSERT_FALSE(result.equilibria->list.empty());
  for (const analysis::Equilibrium& one : result.equilibria->list) {
    const auto at = [&](const std::string& name) {
      return one.sample.values[analysis::column(result, name)];
    };
    for (std::size_t i = 0; i < 3; ++i) {
      const double foot = at("c" + std::to_string(i) + ".foot"), turned = at("coupler.phi");
      EXPECT_NEAR(feet[i] + 1.5 * std::cos(foot), at("coupler.x") + feet[i] * std::cos(turned),
                  1e-9);
      EXPECT_NEAR(1.5 * std::sin(foot), at("coupler.y") + feet[i] * std::sin(turned), 1e-9);
    }
  }
}

}  // namespace
}  // namespace springfold::io
