// The key `snap` of case files, and what expected values may say about jumps.
#include <gtest/gtest.h>

#include "io/case_files.hpp"
#include "io/jump_access.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/analysis/snap.hpp"
#include "springfold/io/results.hpp"

namespace springfold::io {
namespace {

using SnapKey = CaseFiles;

const std::string bar = R"(
[[body]]
name = "tip"
task_space = "xy"
pose = [0, 1]

[[chain]]
name = "bar"
elements = [
  { joint = "revolute", axis = "-z", name = "hinge", role = "preloaded", spring = { law = "linear", stiffness = 1 } },
  { rigid = [0, 1] },
]

[[study]]
name = "press"
control = "load"
direction = [0, -1]
until = { lambda = [0, 2], bar.hinge = [-2, 2] }
)";

TEST_F(SnapKey, AsKindTracesTheBranchesOfTheFirstSpecialPoints) {
  const Case c = load(bar + "kind = \"snap_through\"\n");
  EXPECT_TRUE(c.runs[0].plan.snap.has_value());
  EXPECT_EQ(c.runs[0].plan.branches.depth, 1);
  EXPECT_FALSE(load(bar).runs[0].plan.snap.has_value());
  EXPECT_TRUE(load(bar + "snap = true\n").runs[0].plan.snap.has_value());
  EXPECT_FALSE(load(bar + "snap = false\n").runs[0].plan.snap.has_value());
}

TEST_F(SnapKey, TakesSettings) {
  const Case c = load(bar + "snap = { starts = 5, seed = 7, damping = { \"bar.hinge\" = 0.5 } }\n");
  const analysis::SnapSettings& snap = c.runs[0].plan.snap.value();
  EXPECT_EQ(snap.starts, 5);
  EXPECT_EQ(snap.seed, 7u);
  ASSERT_EQ(snap.damping.size(), 1u);
  EXPECT_EQ(snap.damping[0].value, 0.5);
}

TEST_F(SnapKey, TakesDampersOfTheMotionWithMasses) {
  const Case ratio = load(bar + "snap = { inertia = { damping_ratio = 0.2 } }\n");
  EXPECT_EQ(ratio.runs[0].plan.snap.value().inertia.value().damping_ratio, 0.2);
  const Case named = load(bar + "snap = { inertia = { damping = { \"bar.hinge\" = 3 } } }\n");
  ASSERT_EQ(named.runs[0].plan.snap.value().inertia.value().damping.size(), 1u);
  EXPECT_TRUE(load(bar + "snap = { inertia = true }\n").runs[0].plan.snap.value().inertia);
  EXPECT_FALSE(load(bar + "snap = { inertia = false }\n").runs[0].plan.snap.value().inertia);
  EXPECT_EQ(messages(bar + "snap = { inertia = 2 }\n").size(), 1u);
  EXPECT_EQ(messages(bar + "snap = { inertia = { damping = { \"bar.nothing\" = 1 } } }\n").size(),
            1u);
  EXPECT_EQ(messages(bar + "snap = { inertia = { damping_ratio = 0.1, damping = { "
                           "\"bar.hinge\" = 3 } } }\n")
                .size(),
            1u);
}

TEST_F(SnapKey, TakesLevelsOfALoadCycle) {
  const std::string kind = bar + "kind = \"load_cycle\"\n";
  const Case c = load(kind + "cycle = { levels = [1.5, 0.5], times = 3 }\n");
  const analysis::CycleSettings& cycle = c.runs[0].plan.snap.value().cycle.value();
  EXPECT_EQ(cycle.levels, (std::vector<double>{1.5, 0.5}));
  EXPECT_EQ(cycle.times, 3);
  EXPECT_EQ(messages(kind).size(), 1u);
  EXPECT_EQ(messages(kind + "cycle = { times = 2 }\n").size(), 1u);
  EXPECT_EQ(messages(kind + "cycle = { levels = [3] }\n").size(),
            1u);  // beyond the limits of lambda
  EXPECT_EQ(messages(bar + "cycle = { levels = [1] }\n").size(), 1u);
}

TEST_F(SnapKey, TakesLevelsFromAFile) {
  const std::string kind = bar + "kind = \"load_cycle\"\n";
  write("levels.csv", "load\n1.5\n0.5  # back\n\n+1.25\n");
  const Case c = load(kind + "cycle = { file = \"levels.csv\", times = 2 }\n");
  const analysis::CycleSettings& cycle = c.runs[0].plan.snap.value().cycle.value();
  EXPECT_EQ(cycle.levels, (std::vector<double>{1.5, 0.5, 1.25}));
  EXPECT_EQ(cycle.times, 2);
  EXPECT_EQ(messages(kind + "cycle = { file = \"levels.csv\", levels = [1] }\n").size(), 1u);
  EXPECT_EQ(messages(kind + "cycle = { file = \"nothing.csv\" }\n").size(), 1u);
  write("empty.csv", "# none\n");
  EXPECT_EQ(messages(kind + "cycle = { file = \"empty.csv\" }\n").size(), 1u);
  write("words.csv", "1\nmore\n1, 2\n");
  EXPECT_EQ(messages(kind + "cycle = { file = \"words.csv\" }\n").size(), 2u);
  write("far.csv", "3\n");
  EXPECT_EQ(messages(kind + "cycle = { file = \"far.csv\" }\n").size(), 1u);
}

TEST_F(SnapKey, TakesWhereStatesAreSearchedFor) {
  const std::string kind = bar + "kind = \"transitions\"\n";
  const Case c =
      load(kind + "transitions = { search_at = [0.5], barriers_at = [1], starts = 9 }\n");
  const analysis::SnapSettings& snap = c.runs[0].plan.snap.value();
  EXPECT_EQ(snap.transitions.value().search_at, std::vector<double>{0.5});
  EXPECT_EQ(snap.transitions.value().barriers_at, std::vector<double>{1});
  EXPECT_EQ(snap.transitions.value().starts, 9);
  EXPECT_EQ(snap.starts, 0);
  EXPECT_EQ(messages(kind + "transitions = { search_at = [5] }\n").size(), 1u);
  EXPECT_EQ(messages(bar + "transitions = { search_at = [1] }\n").size(), 1u);
}

/// The pitchfork of a bar on a torsion spring: upright below its load, bent to either side beyond.
TEST_F(SnapKey, FindsTheStatesToWhichABranchPointHandsOver) {
  const Case c = load(bar + "kind = \"transitions\"\n");
  const auto result = run_study(c.runs[0].mechanism, c.runs[0].plan);
  ASSERT_TRUE(result.snap && result.snap->transitions);
  const analysis::TransitionReport& report = *result.snap->transitions;
  ASSERT_EQ(report.states.size(), 3u);
  EXPECT_NEAR(report.states[0].high, 1, 1e-10);
  EXPECT_NEAR(report.states[1].low, 1, 1e-6);
  EXPECT_TRUE(report.is_closed);
  EXPECT_TRUE(result.snap->jumps.empty());
  int down = 0;
  for (const auto& t : report.transitions) down += t.loading < 0 && t.to == 1 ? 1 : 0;
  EXPECT_EQ(down, 2);
}

TEST_F(SnapKey, RefusesWhatItIsNot) {
  EXPECT_EQ(messages(bar + "snap = 3\n").size(), 1u);
  EXPECT_EQ(messages(bar + "snap = { damping = { \"bar.nothing\" = 1 } }\n").size(), 1u);
  EXPECT_EQ(messages(bar + "snap = { damping = { \"bar.hinge\" = 0 } }\n").size(), 1u);
  EXPECT_EQ(messages(bar + "snap = true\npath = \"davidenko\"\n").size(), 1u);
}

/// A bar on a torsion spring bends at its branch point and jumps nowhere.
TEST_F(SnapKey, NamesTheSideToWhichASupercriticalBranchPointHandsOver) {
  const Case c = load(bar + "kind = \"snap_through\"\n");
  auto result = run_study(c.runs[0].mechanism, c.runs[0].plan);
  result.study = "press";
  ASSERT_TRUE(result.snap);
  EXPECT_TRUE(result.snap->jumps.empty());
  ASSERT_EQ(result.snap->handovers.size(), 1u);
  EXPECT_EQ(result.snap->handovers[0].at, "BP1");
  EXPECT_FALSE(result.snap->handovers[0].towards.empty());
  EXPECT_NE(jump_lines(result, c.units).find("hands over"), std::string::npos);
}

TEST(JumpPlace, IsALabelWithANumberAndMaybeThatOfAnotherLanding) {
  EXPECT_TRUE(is_jump_place("J"));
  EXPECT_TRUE(is_jump_place("J1"));
  EXPECT_TRUE(is_jump_place("J12.3"));
  EXPECT_FALSE(is_jump_place("J0"));
  EXPECT_FALSE(is_jump_place("J1."));
  EXPECT_FALSE(is_jump_place("JX"));
  EXPECT_FALSE(is_jump_place("LP1"));
}

}  // namespace
}  // namespace springfold::io
