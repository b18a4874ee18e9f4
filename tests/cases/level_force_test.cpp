// A force that rises, stands still and then falls: all of the level stretch is its extremum.
#include <gmock/gmock.h>

#include <cmath>

#include "case_runs.hpp"
#include "springfold/analysis/snap.hpp"

namespace springfold::io {
namespace {

using analysis::Event;
using analysis::EventKind;
using analysis::StudyResult;

/// A slide x whose force goes through these points in straight lines, and a spring of stiffness k along it.
std::string level_slide(const std::string& points, const std::string& study) {
  return R"toml([parameters]
k = 0
[[body]]
name = "t"
task_space = "xy"
pose = [0, 0]
[[chain]]
name = "c"
elements = [ { joint = "prismatic", axis = "x", name = "x", role = "preloaded", spring = { law = "table", interpolation = "straight", falling = true, points = )toml" +
         points + R"toml( } } ]
[[spring]]
name = "s"
from_at = [-10, 0]
to = "t"
stiffness = "k"
free = 10
[[study]]
name = "s"
direction = [1, 0]
)toml" + study;
}

const std::string yields_and_softens = "[[0, 0], [1, 1], [2, 1], [3, 0.2], [5, 3]]";
const std::string driven_slide = "control = \"mixed\"\nuntil = { t.x = [-0.5, 2.9] }\n";
const std::string loaded_slide = "control = \"load\"\nuntil = { t.x = [-0.5, 2.9] }\n";

std::vector<const Event*> level_limit_points(const StudyResult& result) {
  std::vector<const Event*> list;
  for (const Event& event : result.branches.at(0).events)
    if (event.kind == EventKind::corner_limit_point || event.kind == EventKind::limit_point)
      list.push_back(&event);
  return list;
}

TEST(LevelForce, HasALimitPointWhereItFallsBehindTheLevelStretch) {
  for (const std::string& study : {driven_slide, loaded_slide}) {
    const auto result = run(level_slide(yields_and_softens, study)).of("s");
    EXPECT_TRUE(complete(result));
    const auto found = level_limit_points(result);
    ASSERT_EQ(found.size(), 1U) << study;
    EXPECT_NEAR(value(result, found[0]->row, "t.x"), 2, 1e-10);
    EXPECT_NEAR(value(result, found[0]->row, "force"), 1, 1e-12);
  }
}

TEST(LevelForce, HasTheLimitPointAtTheEndSeenFromTheStartOnTheWayBackToo) {
  // The start stands where the force falls: backwards it rises to the level stretch and falls behind it.
  for (const std::string control : {"mixed", "load"}) {
    const auto result =
        run(level_slide("[[-3, -1], [-2, 0.5], [-1, 0.5], [0.5, -0.25], [1.5, 0.75]]",
                        "control = \"" + control + "\"\nuntil = { t.x = [-2.9, 0.4] }\n"))
            .of("s");
    const auto found = level_limit_points(result);
    ASSERT_EQ(found.size(), 1U) << control;
    EXPECT_NEAR(value(result, found[0]->row, "t.x"), -2, 1e-10);
  }
}

TEST(LevelForce, HasNoLimitPointWhereItRisesOn) {
  const auto result = run(level_slide("[[0, 0], [1, 1], [2, 1], [3, 1.5]]", driven_slide)).of("s");
  EXPECT_TRUE(complete(result));
  EXPECT_THAT(level_limit_points(result), testing::IsEmpty());
}

TEST(LevelForce, LeavesTheNumberOfUnstableModesOpenBetweenItsEnds) {
  for (const std::string& study : {driven_slide, loaded_slide}) {
    const auto result = run(level_slide(yields_and_softens, study)).of("s");
    const std::string count = "index_force";
    for (const Event& event : result.branches.at(0).events) {
      if (event.kind != EventKind::switching && event.kind != EventKind::corner_limit_point)
        continue;
      const bool begins = event.kind == EventKind::switching;
      const double before = value(result, event.row, count),
                   after = value(result, event.row + 1, count);
      EXPECT_EQ(begins ? before : after, begins ? 0 : 1) << study << event.label;
      EXPECT_TRUE(std::isnan(begins ? after : before)) << study << event.label;
    }
  }
}

TEST(LevelForce, HasNoLimitPointFromTheSpringOnThatBalancesItsFall) {
  // Behind the level stretch the force falls by 0.8 per length.
  const std::string keys =
      "kind = \"threshold\"\nthreshold = { of = \"limit_point\", index = \"dead_load\", parameter "
      "= \"k\", range = "
      "[0, 2] }\n";
  for (const std::string& study : {driven_slide, loaded_slide}) {
    const auto found = run(level_slide(yields_and_softens, study + keys)).of("s");
    ASSERT_TRUE(found.threshold && found.threshold->found) << study << found.start.message;
    EXPECT_NEAR(found.threshold->value, 0.8, 1e-9) << study;
  }
}

TEST(LevelForce, LosesItsStabilityToAJumpWhereTheLevelStretchEnds) {
  const auto result =
      run(level_slide(yields_and_softens,
                      "kind = \"snap_through\"\ncontrol = \"load\"\nuntil = { t.x = "
                      "[-0.5, 5], lambda = [-0.5, 1.5] }\n"))
          .of("s");
  ASSERT_TRUE(result.snap);
  ASSERT_EQ(result.snap->jumps.size(), 2U);
  for (const auto& jump : result.snap->jumps) {
    const double lands = jump.landing.values[column(result, "t.x")];
    // 0.2 + 1.4 (x - 3) = 1 rising, x = 0.2 falling.
    EXPECT_NEAR(lands, jump.loading > 0 ? 3 + 0.8 / 1.4 : 0.2, 1e-9);
  }
}

}  // namespace
}  // namespace springfold::io
