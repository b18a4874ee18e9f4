#include <gmock/gmock.h>

#include <cmath>

#include "drawing/mechanisms.hpp"

namespace springfold::drawing {
namespace {

using testing::Contains;
using testing::Field;

TEST(Scene, TheEndOfTwoLinksIsWhereTrigonometrySays) {
  const statics::System system = statics::prepare(two_links());
  const double a = 0.7, b = -1.1;
  const double x = 2 * std::cos(a) + std::cos(a + b), y = 2 * std::sin(a) + std::sin(a + b);
  const Scene scene = scene_of(system, posture_of(system, a, b, x, y));
  ASSERT_EQ(scene.gaps.size(), 1U);
  const model::Vec3<double> end = scene.points[scene.gaps[0].end];
  EXPECT_NEAR(end.x(), x, 1e-15);
  EXPECT_NEAR(end.y(), y, 1e-15);
  EXPECT_LT(largest_gap(scene), 1e-15);
  EXPECT_TRUE(scene.is_planar);
}

TEST(Scene, AGuessThatDoesNotCloseShowsHowFarApartTheEndsAre) {
  const statics::System system = statics::prepare(two_links());
  // Stretched along x the end is at (3, 0); the tool is 4 to the left of it.
  const Scene scene = scene_of(system, posture_of(system, 0, 0, -1, 0));
  const GapPart& gap = scene.gaps.at(0);
  EXPECT_NEAR((scene.points[gap.end] - scene.points[gap.attachment]).norm(), 4, 1e-15);
  EXPECT_NEAR(largest_gap(scene) * size_of(scene), 4, 1e-15);
}

TEST(Scene, AOneSidedSpringActsAboveItsThresholdOnly) {
  const statics::System system = statics::prepare(two_links());
  const Scene below = scene_of(system, posture_of(system, 0, 0.4, 0, 0));
  const Scene above = scene_of(system, posture_of(system, 0, 0.8, 0, 0));
  ASSERT_EQ(below.springs.size(), 1U);
  EXPECT_TRUE(below.springs[0].is_one_sided);
  EXPECT_FALSE(below.springs[0].acts);
  EXPECT_EQ(below.springs[0].force, 0);
  EXPECT_TRUE(above.springs[0].acts);
  EXPECT_NEAR(above.springs[0].force, 4 * 0.3, 1e-15);
  EXPECT_NEAR(above.springs[0].energy, 0.5 * 4 * 0.3 * 0.3, 1e-15);
}

TEST(Scene, TheMarkOfAThresholdLiesOnTheLinkThatReachesIt) {
  const statics::System system = statics::prepare(two_links());
  const Scene scene = scene_of(system, posture_of(system, 0.2, 0.5, 0, 0));
  ASSERT_EQ(scene.stops.size(), 1U);
  const model::Vec3<double> along =
      scene.points[scene.stops[0].tip] - scene.points[scene.stops[0].at];
  EXPECT_NEAR(std::atan2(along.y(), along.x()), 0.7, 1e-15);
}

TEST(Scene, PartsComeInTheSameOrderInEveryPosture) {
  const statics::System system = statics::prepare(two_links());
  const Scene a = scene_of(system, posture_of(system, 0, 0, 0, 0));
  const Scene b = scene_of(system, posture_of(system, 1, 2, 3, 4));
  ASSERT_EQ(a.points.size(), b.points.size());
  ASSERT_EQ(a.links.size(), b.links.size());
  for (std::size_t i = 0; i < a.links.size(); ++i) {
    EXPECT_EQ(a.links[i].from, b.links[i].from);
    EXPECT_EQ(a.links[i].to, b.links[i].to);
  }
}

TEST(Scene, TurningJointsAtOnePointAreUniversalOrSpherical) {
  model::Mechanism mechanism = two_links();
  auto& elements = mechanism.chains[0].elements;
  elements[0] = model::Joint{.name = "foot.1", .axis = model::Vec3<double>::UnitX()};
  elements.insert(elements.begin() + 1,
                  model::Joint{.name = "foot.2", .axis = model::Vec3<double>::UnitY()});
  const auto universal =
      scene_of(statics::prepare(mechanism), guess_posture(statics::prepare(mechanism)));
  EXPECT_THAT(universal.joints,
              Contains(testing::AllOf(Field(&JointPart::shape, JointShape::universal),
                                      Field(&JointPart::name, "arm.foot"))));
  elements.insert(elements.begin() + 2,
                  model::Joint{.name = "foot.3", .axis = model::Vec3<double>::UnitZ()});
  const auto spherical =
      scene_of(statics::prepare(mechanism), guess_posture(statics::prepare(mechanism)));
  EXPECT_THAT(spherical.joints, Contains(Field(&JointPart::shape, JointShape::spherical)));
}

TEST(Scene, TwoTurnsAboutOneAxisAreARevoluteJoint) {
  model::Mechanism mechanism = two_links();
  mechanism.chains[0].elements.insert(mechanism.chains[0].elements.begin() + 1,
                                      model::Joint{.name = "again"});
  const statics::System system = statics::prepare(mechanism);
  EXPECT_EQ(scene_of(system, guess_posture(system)).joints[0].shape, JointShape::revolute);
}

TEST(Scene, ALineSpringPullsByItsStiffnessTimesWhatItIsLonger) {
  model::Mechanism mechanism = two_links();
  mechanism.line_springs.push_back({.name = "rope",
                                    .from = {.body = 0, .at = {0, 5, 0}},
                                    .to = {.body = 1},
                                    .stiffness = 3,
                                    .free = 1});
  const statics::System system = statics::prepare(mechanism);
  const Scene scene = scene_of(system, posture_of(system, 0, 0, 3, 1));
  const SpringPart& rope = scene.springs.back();
  EXPECT_NEAR(rope.force, 3 * (5 - 1), 1e-14);  // from (0, 5) to (3, 1): 3, 4, 5
  EXPECT_NEAR(rope.energy, 0.5 * 3 * 16, 1e-14);
}

TEST(Scene, ACableIsDrawnLegByLegAndAGasByItsOutline) {
  model::Mechanism mechanism = two_links();
  const model::Anchor left{.at = {0, 5, 0}}, right{.at = {6, 5, 0}}, tip{.body = 1};
  mechanism.shape_springs = {
      {"cable", {.points = {left, tip, right}}, model::LinearSpring{.stiffness = 2, .free = 4}},
      {"gas",
       {.kind = model::ShapeKind::area, .points = {left, tip, right}},
       {},
       model::Gas{.nRT = 1, .initial = 12}}};
  const statics::System system = statics::prepare(mechanism);
  const std::size_t before =
      scene_of(statics::prepare(two_links()), posture_of(statics::prepare(two_links()), 0, 0, 3, 1))
          .springs.size();
  const Scene scene = scene_of(system, posture_of(system, 0, 0, 3, 1));
  ASSERT_EQ(scene.springs.size(), before + 2);
  EXPECT_NEAR(scene.springs.back().force, 2 * (10 - 4), 1e-14);  // two legs of length 5
  EXPECT_NEAR(scene.springs.back().energy, 0.5 * 36, 1e-14);     // half of all
  ASSERT_EQ(scene.outlines.size(), 1U);
  EXPECT_EQ(scene.outlines[0].corners.size(), 3U);
}

/// A wall from (4, 0) to (4, 1) that pushes what comes behind it, to the right of that way: the first tip stands 1
/// before it, the second one 0.5 behind.
TEST(Scene, AWallIsACoilToTheNearestPointOfItsLineThatShowsWhetherItActs) {
  for (const double x : {3.0, 4.5}) {
    model::Mechanism mechanism = two_links();
    const model::Anchor tip{.body = 1}, low{.at = {4, 0, 0}}, high{.at = {4, 1, 0}};
    mechanism.shape_springs = {
        {"wall",
         {.kind = model::ShapeKind::line, .points = {tip, low, high}},
         model::OneSidedSpring{
             .stiffness = 8, .from = 0, .side = model::OneSidedSpring::Side::below}}};
    const statics::System system = statics::prepare(mechanism);
    const Scene scene = scene_of(system, posture_of(system, 0, 0, x, 3));
    const SpringPart& wall = scene.springs.back();
    EXPECT_EQ(wall.name, "wall");
    EXPECT_EQ(wall.acts, x > 4);
    EXPECT_TRUE(wall.is_one_sided);
    EXPECT_NEAR(std::abs(wall.force), x > 4 ? 8 * 0.5 : 0, 1e-14);
    EXPECT_LT((scene.points[wall.to] - model::Vec3<double>{4, 3, 0}).norm(), 1e-14);
  }
}

/// The triangle (0, 5), (6, 5), (3, y) has the area 3 (5 - y): a bladder that pushes where it is below 12.
TEST(Scene, AnAreaShowsWhetherItsSpringActs) {
  for (const double y : {0.5, 3.0}) {
    model::Mechanism mechanism = two_links();
    const model::Anchor left{.at = {0, 5, 0}}, right{.at = {6, 5, 0}}, tip{.body = 1};
    mechanism.shape_springs = {
        {"bladder",
         {.kind = model::ShapeKind::area, .points = {left, tip, right}},
         model::OneSidedSpring{
             .stiffness = 1, .from = 12, .side = model::OneSidedSpring::Side::below}}};
    const statics::System system = statics::prepare(mechanism);
    EXPECT_EQ(scene_of(system, posture_of(system, 0, 0, 3, y)).outlines.at(0).acts, y > 1);
  }
}

TEST(Scene, AFollowerForceTurnsWithItsBodyAndGrowsWithLambda) {
  model::Mechanism mechanism = two_links();
  mechanism.bodies[0].task_space = model::TaskSpace::planar;
  mechanism.bodies[0].pose = Vector::Zero(3);
  mechanism.bodies[0].pose[2] = 0.5;
  mechanism.loads.push_back({.name = "push",
                             .on = {.body = 1},
                             .follows = true,
                             .with_lambda = true,
                             .vector = {2, 0, 0}});
  const statics::System system = statics::prepare(mechanism);
  Posture posture = guess_posture(system);
  posture.lambda = 3;
  const model::Vec3<double> force = scene_of(system, posture).loads.at(0).vector;
  EXPECT_NEAR(force.x(), 6 * std::cos(0.5), 1e-14);
  EXPECT_NEAR(force.y(), 6 * std::sin(0.5), 1e-14);
}

}  // namespace
}  // namespace springfold::drawing
