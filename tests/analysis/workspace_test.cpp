// Study kind `workspace`.
#include <gmock/gmock.h>

#include "command_mechanisms.hpp"

namespace springfold::analysis {
namespace {

Study region(RegionShape shape, FactorBounds velocity, double up_to = 2) {
  Study study = command_study(StudyKind::workspace);
  study.workspace = {
      .shape = shape, .centre = {}, .velocity = velocity, .force = {}, .up_to = up_to};
  return study;
}

// On the diagonal the factors are 1/(1 - t) and 1/(1 + t), t = tan a = s/sqrt(1 - s^2): between 1/2
// and 2 until t = 1/2, s = 1/sqrt(5).
TEST(Workspace, OfTheOrthoglideIsASquareOfHalfWidthOneOverRootFive) {
  const StudyResult result =
      run_study(orthoglide(linear(0.05)), region(RegionShape::square, {0.5, 2}));
  ASSERT_TRUE(complete(result));
  EXPECT_NEAR(value(result, 0, "size"), 1 / std::sqrt(5), 1e-10);
  EXPECT_NEAR(value(result, 0, "width"), 2 / std::sqrt(5), 1e-10);
  EXPECT_NEAR(value(result, 0, "velocity_max"), 2, 1e-9);
  EXPECT_NEAR(std::abs(value(result, 0, "tool.x")), 1 / std::sqrt(5), 1e-10);
}

TEST(Workspace, TheSameInOtherUnits) {
  Study study = region(RegionShape::square, {0.5, 2}, 2000);
  const StudyResult result = run_study(orthoglide(linear(50), 1000), study);
  EXPECT_NEAR(value(result, 0, "size"), 1000 / std::sqrt(5), 1e-7);
}

// The factors of a point at angle phi and radius r are 1 and ... : the worst direction is the
// diagonal, where the disc touches the same points as the square's corners.
TEST(Workspace, TheDiscTouchesTheSameBoundOnTheDiagonal) {
  const StudyResult result = run_study(orthoglide(linear(0)), region(RegionShape::disc, {0.5, 2}));
  ASSERT_TRUE(complete(result));
  EXPECT_NEAR(value(result, 0, "size"), std::sqrt(0.4), 1e-10);
}

TEST(Workspace, BoundsOfTheForceFactorsGiveTheSameRegionAsTheirInverses) {
  Study study = region(RegionShape::square, {});
  study.workspace.force = {0.5, 2};
  const StudyResult result = run_study(orthoglide(linear(0)), study);
  ASSERT_TRUE(complete(result));
  EXPECT_NEAR(value(result, 0, "size"), 1 / std::sqrt(5), 1e-10);
}

TEST(Workspace, ACentreOutsideOfTheBoundsIsNoAnswer) {
  Study study = region(RegionShape::square, {0.5, 2});
  study.workspace.centre = Vector::Constant(2, 0.6);
  const StudyResult result = run_study(orthoglide(linear(0)), study);
  EXPECT_FALSE(result.start.found);
  EXPECT_THAT(result.start.message, testing::HasSubstr("centre is not within the bounds"));
}

TEST(Workspace, ASearchThatEndsBeforeAnyBoundGivesNoSize) {
  const StudyResult result =
      run_study(orthoglide(linear(0)), region(RegionShape::square, {0.5, 2}, 0.2));
  ASSERT_FALSE(result.branches.empty());
  EXPECT_TRUE(std::isnan(value(result, 0, "size")));
  EXPECT_THAT(result.branches[0].samples[0].status, testing::HasSubstr("no bound is reached"));
}

/// Three sliders with links of length 1 to a point in space (spherical bearings at both ends).
model::Mechanism delta() {
  using namespace model;
  Mechanism m;
  m.bodies = {{"tool", TaskSpace::xyz, Vector::Zero(3)}};
  for (int i = 0; i < 3; ++i) {
    const model::Vec3<double> axis = model::Vec3<double>::Unit(i);
    Chain chain{.name = "leg" + std::to_string(i + 1)};
    chain.elements = {Joint{.name = "drive",
                            .kind = JointKind::prismatic,
                            .axis = axis,
                            .role = JointRole::actuated,
                            .spring = LinearSpring{1, 0},
                            .command = 1},
                      Joint{.name = "first", .axis = model::Vec3<double>::Unit((i + 1) % 3)},
                      Joint{.name = "second", .axis = model::Vec3<double>::Unit((i + 2) % 3)},
                      RigidLink{{model::Mat3<double>::Identity(), -axis}}};
    m.chains.push_back(chain);
  }
  return m;
}

// On the space diagonal J^-1 = (1 + t) I - t (all ones), t = s/sqrt(1 - 2 s^2), with eigenvalues
// 1 + t (twice) and 1 - 2 t: the velocity factor reaches 2 where t = 1/4, s = 1/sqrt(18), on the side
// of s > 0; where t < 0, 1/(1 + t) reaches 2 later.
TEST(Workspace, TheCubeOfTheSpatialOrthoglideEndsOnTheSpaceDiagonal) {
  const StudyResult result = run_study(delta(), region(RegionShape::cube, {0.5, 2}, 1));
  ASSERT_TRUE(complete(result));
  EXPECT_NEAR(value(result, 0, "size"), 1 / std::sqrt(18), 1e-10);
  EXPECT_NEAR(value(result, 0, "tool.z"), 1 / std::sqrt(18), 1e-10);
}

}  // namespace
}  // namespace springfold::analysis
