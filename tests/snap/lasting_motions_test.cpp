// Motions with masses that swing for long: what is known of them before they are at rest.
#include <gtest/gtest.h>

#include <cmath>

#include "io/case_files.hpp"
#include "snap/damped_truss.hpp"
#include "springfold/analysis/run.hpp"
#include "springfold/analysis/snap.hpp"

namespace springfold::analysis {
namespace {

using LastingMotions = io::CaseFiles;

/// The load pulls a little to the side.
std::string truss(double aside, const std::string& dampers) {
  return damped_truss("[" + std::to_string(aside) + ", -1]",
                      "lambda = [-0.1, 0.5], apex.y = [-1.5, 1.5]", dampers);
}

StudyResult run_of(const io::Case& c) {
  return run_study(c.runs.at(0).mechanism, c.runs.at(0).plan);
}

/// The damper of the sway is next to nothing beside the other one.
TEST_F(LastingMotions, WhoseSwayIsHardlyDampedEndWhereTheyAreKnownToLand) {
  const StudyResult result =
      run_of(load(truss(0.1, "\"damper.along\" = 0.3, \"damper.across\" = 1e-6")));
  ASSERT_FALSE(result.snap->jumps.empty());
  EXPECT_FALSE(complete(result));
  for (const Jump& jump : result.snap->jumps) {
    ASSERT_TRUE(jump.inertial.has_value());
    const InertialMotion& motion = *jump.inertial;
    ASSERT_EQ(motion.end, InertialMotion::End::swings_on);
    ASSERT_EQ(jump.verdict, SnapVerdict::unambiguous);
    EXPECT_EQ(motion.landing.values, jump.landing.values);
    EXPECT_TRUE(std::isnan(motion.duration));
    EXPECT_GT(motion.would_last, motion.followed);
    // What is released is either dissipated or still there.
    EXPECT_NEAR(motion.dissipated + motion.left, motion.released, 1e-5 * motion.released);
  }
  ASSERT_FALSE(result.doubts.empty());
  EXPECT_NE(result.doubts.front().find("more damping"), std::string::npos) << result.doubts.front();
}

/// Energy fades as exp(-c t/m) where dampers take little: half of the damping lasts twice as long.
TEST_F(LastingMotions, ThatFadeSlowlyDissipateAllThatIsReleasedInATimeThatGoesWithTheDamping) {
  const auto motion_of = [this](double c) {
    const std::string value = std::to_string(c);
    const StudyResult result =
        run_of(load(truss(0, "\"damper.along\" = " + value + ", \"damper.across\" = " + value)));
    EXPECT_TRUE(complete(result));
    return result.snap->jumps.at(0).inertial.value_or(InertialMotion{});
  };
  const InertialMotion fast = motion_of(0.01), slow = motion_of(0.005);
  for (const InertialMotion& motion : {fast, slow}) {
    ASSERT_EQ(motion.end, InertialMotion::End::rest);
    EXPECT_NEAR(motion.dissipated, motion.released, 1e-5 * motion.released);
  }
  EXPECT_NEAR(slow.duration / fast.duration, 2, 0.1);  // the first swings are large
}

}  // namespace
}  // namespace springfold::analysis
