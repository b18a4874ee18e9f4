// Peaks of motions with masses lie between the integrator's steps.
#include <gtest/gtest.h>

#include "io/case_files.hpp"
#include "snap/damped_truss.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/analysis/snap.hpp"

namespace springfold::analysis {
namespace {

using MotionPeaks = io::CaseFiles;

/// Slowed by the damper under the apex alone.
std::string slowed_truss(double damping) {
  return damped_truss("[0, -1]", "apex.y = [-1.5, 1.5]",
                      "\"damper.along\" = " + std::to_string(damping));
}

/// The damper's force is its constant times the speed, and both are largest at one moment. No bar is pressed as hard:
/// less than by its own shortening to the half span, sqrt(2) - 1.
TEST_F(MotionPeaks, OfADampersForceAreThoseOfTheSpeed) {
  constexpr double damping = 1.5;
  const io::Case c = load(slowed_truss(damping));
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
