// Load cycles and graphs of stable states as texts and files.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "io/case_files.hpp"
#include "io/cycle_access.hpp"
#include "io/jump_access.hpp"
#include "io/outline.hpp"
#include "io/result_access.hpp"
#include "io/transition_access.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {
namespace {

analysis::StudyResult run(const std::string& file, const std::string& study) {
  const Case c = load_case(std::string{SPRINGFOLD_SOURCE_DIR} + "/cases/" + file);
  for (const PlannedRun& planned : c.runs)
    if (planned.study == study) {
      auto result = analysis::run_study(planned.mechanism, planned.plan);
      result.study = study;
      return result;
    }
  throw std::out_of_range(study);
}

std::size_t lines_in(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A truss pushed through a spring of 0.5: the force turns back at LP1, the way only at LP2.
const std::string pushed_truss = R"(
[[node]]
name = "left"
at = [-1, 0]
fixed = true

[[node]]
name = "right"
at = [1, 0]
fixed = true

[[node]]
name = "apex"
at = [0, 0.9]
fixed = ["x"]

[[node]]
name = "hand"
at = [0, 1.9]
fixed = ["x"]

[[bar]]
from = "left"
to = "apex"
stiffness = 1.3

[[bar]]
from = "right"
to = "apex"
stiffness = 1.3

[[bar]]
name = "push"
from = "apex"
to = "hand"
stiffness = 0.5

[[study]]
name = "press"
kind = "snap_through"
control = "mixed"
body = "hand"
direction = [0, -1]
until = { lambda = [-0.5, 2.3] }
)";

using DrivenTruss = CaseFiles;

TEST_F(DrivenTruss, IsOutlinedAsItIsDriven) {
  const Case c = load(pushed_truss);
  auto result = analysis::run_study(c.runs.at(0).mechanism, c.runs.at(0).plan);
  result.study = c.runs.at(0).study;
  const std::vector<std::string> lines = outline_of(c, result);
  ASSERT_FALSE(lines.empty());
  EXPECT_TRUE(has(lines[0], "stable as it is driven up to LP2 at ")) << lines[0];
  EXPECT_TRUE(has(lines[0], ", where it snaps; and so on, 2 changes")) << lines[0];
}

TEST(TransitionText, HasAnArrowForEachJumpOfASwitch) {
  const auto result = run("snap-through/case-switch.toml", "states");
  const std::string dot = transitions_dot(result), graphml = transitions_graphml(result);
  EXPECT_TRUE(has(dot, "\"S1\" -> \"S2\" [label="));
  EXPECT_TRUE(has(dot, "\"S2\" -> \"S1\""));
  EXPECT_TRUE(has(graphml, "<edge source=\"S1\" target=\"S2\">"));
  EXPECT_TRUE(has(graphml, "<node id=\"S2\">"));
  EXPECT_EQ(lines_in(states_csv({result})), 3u);
  EXPECT_EQ(lines_in(transitions_csv({result})), 3u);
  // Between the two states, and over the dead point of the sleeves out of the range.
  EXPECT_EQ(lines_in(barriers_csv({result})), 3u);
  EXPECT_EQ(lines_in(escapes_csv({result})), 3u);
  EXPECT_TRUE(has(graphml, "<data key=\"kind\">barrier</data>"));
  EXPECT_TRUE(has(graphml, "<data key=\"escape\">"));
  EXPECT_EQ(graph_names({result}), std::vector<std::string>{"states-1"});
  EXPECT_EQ(jumps_json(result)["transitions"]["memory"], "holds");
}

TEST(TransitionText, ExplainsTheSignsThatOccur) {
  const std::string plain = transitions_dot(run("snap-through/case-switch.toml", "states"));
  EXPECT_TRUE(has(plain, "\\lblue: a jump where the load grows"));
  EXPECT_TRUE(has(plain, "\\lorange: a jump where the load falls"));
  EXPECT_FALSE(has(plain, "dashed"));
}

/// Both states of the switch lie 0.05 below the saddle in the middle, with the energy 0.25 there.
TEST(TransitionText, HasEnergiesAndBarriersInItsFigure) {
  const auto result = run("snap-through/case-switch.toml", "states");
  const std::string dot = transitions_dot(result);
  EXPECT_TRUE(has(dot, "\\nE = "));
  EXPECT_TRUE(has(dot, "\"S1\" -> \"S2\" [dir=none, style=dotted"));
  EXPECT_TRUE(has(dot, "taillabel=\"0.05\", headlabel=\"0.05\""));
  EXPECT_TRUE(has(dot, "  0.1162  \\n  (0.1502)  "));  // its load and the energy released
  EXPECT_TRUE(has(dot, "\\ldotted: a barrier at lambda = 0"));
  EXPECT_TRUE(has(dot, "\"outside\""));
}

/// The oblique springs of cases/snap-through/case-switch.toml are straight at the saddle: its pose is the middle.
TEST(TransitionText, GivesTheSaddlesPose) {
  const auto result = run("snap-through/case-switch.toml", "states");
  const std::string csv = barriers_csv({result});
  EXPECT_TRUE(has(csv.substr(0, csv.find('\n')), "mass.x"));
  const auto& barrier = result.snap->transitions->barriers.at(0);
  EXPECT_NEAR(column_value(result, barrier.saddle, "mass.x"), 0, 1e-12);
  EXPECT_NEAR(barrier.from_first, 0.05, 1e-12);
}

TEST(TransitionText, IsThereForItsOwnKindOnly) {
  const auto result = run("snap-through/case-switch.toml", "push");
  EXPECT_EQ(states_csv({result}), "");
  EXPECT_EQ(cycles_csv({result}), "");
  EXPECT_EQ(transitions_dot(result), "");
  EXPECT_EQ(graph_names({result}), std::vector<std::string>{""});
}

TEST(CycleText, HasARowForTheStartEveryLevelAndEveryJump) {
  const auto result = run("load-cycle/case-truss.toml", "press");
  EXPECT_EQ(lines_in(cycles_csv({result})), 1u + 1 + 4 + 4);
  EXPECT_EQ(jumps_json(result)["cycle"]["end"], "complete");
}

TEST(CyclePlace, IsTheWholeOrALevel) {
  EXPECT_TRUE(is_cycle_place("cycle"));
  EXPECT_TRUE(is_cycle_place("level 12"));
  EXPECT_FALSE(is_cycle_place("level 0"));
  EXPECT_FALSE(is_cycle_place("level"));
  EXPECT_TRUE(is_transition_place("S3"));
  EXPECT_TRUE(is_transition_place("S3-S12"));
  EXPECT_FALSE(is_transition_place("SA1"));
  EXPECT_FALSE(is_transition_place("S0"));
}

}  // namespace
}  // namespace springfold::io
