// Landings in which a leg stands where it is not meant to.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "io/case_files.hpp"
#include "io/jump_access.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/analysis/snap.hpp"

namespace springfold::analysis {
namespace {

using LegWarnings = io::CaseFiles;

/// One leg: a driven slide along x and a link of length 1, whose hinge has the torque f(u), u counted from the dead
/// point where the link stands across the slide. The load pushes the link's end.
std::string leg(const std::string& torque, const std::string& angle, const std::string& direction) {
  return "[parameters]\nstart = \"" + angle + R"toml("

[[body]]
name = "tool"
task_space = "xy"
pose = ["cos(start)", "sin(start)"]

[[chain]]
name = "leg"
elements = [
  { joint = "prismatic", axis = "x", name = "drive", role = "actuated", value = 0 },
  { joint = "revolute", axis = "z", name = "knee", role = "preloaded", initial = "start", spring = { law = "polynomial", coefficients = )toml" +
         torque + R"toml(, free = "pi/2", falling = true } },
  { rigid = [1, 0] },
]

[[study]]
name = "push"
kind = "snap_through"
control = "load"
direction = )toml" +
         direction + R"toml(
until = { lambda = [-2, 2], leg.knee = ["5*deg", "175*deg"] }
)toml";
}

const Jump* rising(const StudyResult& result) {
  for (const Jump& jump : result.snap->jumps)
    if (jump.loading > 0) return &jump;
  return nullptr;
}

TEST_F(LegWarnings, NameALegThatLandsBeyondARightAngle) {
  const io::Case c = load(leg("[0, -0.5, 0, 1]", "pi/2 - sqrt(0.5)", "[-1, 0]"));
  const StudyResult result = run_study(c.runs.at(0).mechanism, c.runs.at(0).plan);
  const Jump* jump = rising(result);
  ASSERT_NE(jump, nullptr);
  ASSERT_EQ(jump->warnings.size(), 1u);
  EXPECT_EQ(jump->warnings[0].kind, SnapWarning::Kind::turned_beyond);
  EXPECT_EQ(jump->warnings[0].coordinate, "leg.knee");
  EXPECT_GT(jump->warnings[0].angle, std::numbers::pi / 2);
  EXPECT_NE(io::jump_lines(result, {}).find("leg.knee lands beyond 90 degrees"), std::string::npos);
}

/// Torque and load both vanish across the slide: the link is upright to rounding.
TEST_F(LegWarnings, NameALegThatLandsAtItsDeadPoint) {
  const io::Case c =
      load(leg("[0, 0.2, 0, -1.5, 0, 1.5]", "pi/2 - sqrt(0.5 + sqrt(0.25 - 0.2/1.5))", "[0, 1]"));
  const StudyResult result = run_study(c.runs.at(0).mechanism, c.runs.at(0).plan);
  const Jump* jump = rising(result);
  ASSERT_NE(jump, nullptr);
  ASSERT_EQ(jump->warnings.size(), 1u);
  EXPECT_EQ(jump->warnings[0].kind, SnapWarning::Kind::dead_point);
  EXPECT_NEAR(jump->warnings[0].angle, std::numbers::pi / 2, 1e-6);
  EXPECT_NE(io::jump_lines(result, {}).find("leg.knee lands at a dead point"), std::string::npos);
}

}  // namespace
}  // namespace springfold::analysis
