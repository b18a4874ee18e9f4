// Peaks of motions with masses lie between the integrator's steps.
#include <gtest/gtest.h>

#include "io/case_files.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/analysis/snap.hpp"

namespace springfold::analysis {
namespace {

using MotionPeaks = io::CaseFiles;

/// A truss with a mass at its apex, slowed by a damper under it alone.
std::string damped_truss(double damping) {
  return R"toml(
[[body]]
name = "apex"
task_space = "xy"
pose = [0, 1]
mass = 1

[[chain]]
name = "left"
from_at = [-1, 0]
elements = [
  { joint = "revolute", axis = "z", name = "foot", initial = "pi/4" },
  { joint = "prismatic", axis = "x", name = "bar", role = "virtual", stiffness = 1 },
  { rigid = ["sqrt(2)", 0] },
]

[[chain]]
name = "right"
from_at = [1, 0]
elements = [
  { joint = "revolute", axis = "z", name = "foot", initial = "3*pi/4" },
  { joint = "prismatic", axis = "x", name = "bar", role = "virtual", stiffness = 1 },
  { rigid = ["sqrt(2)", 0] },
]

[[chain]]
name = "damper"
elements = [
  { joint = "prismatic", axis = "x", name = "across" },
  { joint = "prismatic", axis = "y", name = "along", initial = 1 },
]

[[study]]
name = "press"
kind = "snap_through"
control = "load"
direction = [0, -1]
until = { apex.y = [-1.5, 1.5] }
snap = { inertia = { damping = { "damper.along" = )toml" +
         std::to_string(damping) + " } } }\n";
}

/// The damper's force is its constant times the speed, and both are largest at one moment. No bar is pressed as hard: less
/// than by its own shortening to the half span, sqrt(2) - 1.
TEST_F(MotionPeaks, OfADampersForceAreThoseOfTheSpeed) {
  constexpr double damping = 1.5;
  const io::Case c = load(damped_truss(damping));
  const StudyResult result = run_study(c.runs.at(0).mechanism, c.runs.at(0).plan);
  ASSERT_FALSE(result.snap->jumps.empty());
  for (const Jump& jump : result.snap->jumps) {
    ASSERT_TRUE(jump.inertial.has_value());
    EXPECT_EQ(jump.inertial->end, InertialMotion::End::rest);
    EXPECT_EQ(jump.inertial->peak_force_of, "damper.Fy");
    EXPECT_GT(jump.inertial->peak_force, std::sqrt(2.0) - 1);
    EXPECT_NEAR(jump.inertial->peak_force, damping * jump.inertial->peak_speed, 1e-9);
    EXPECT_LT(jump.inertial->closure, 1e-12);
  }
}

}  // namespace
}  // namespace springfold::analysis
