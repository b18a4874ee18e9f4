// The mechanism seen from near: laws of the central projection.
#include <gmock/gmock.h>

#include <cmath>

#include "drawing/mechanisms.hpp"
#include "drawing/projection.hpp"
#include "drawing/sheet.hpp"
#include "springfold/drawing/illustration.hpp"

namespace springfold::drawing {
namespace {

using Vec = model::Vec3<double>;

/// Looks along -z at the origin, from a distance of 10.
Sheet from_ten() { return {.eye = 10}; }

TEST(Perspective, SizesGoWithTheInverseOfTheDistanceFromTheEye) {
  const Sheet sheet = from_ten();
  for (const double z : {-5.0, 0.0, 2.0, 5.0}) {
    const Place a = seen_at(sheet, {1, -2, z}), b = seen_at(sheet, {3, 1, z});
    EXPECT_NEAR(b.x - a.x, 2 * 10 / (10 - z), 1e-14);
    EXPECT_NEAR(b.y - a.y, 3 * 10 / (10 - z), 1e-14);
  }
}

TEST(Perspective, LinesAlongTheViewMeetInOnePoint) {
  const Sheet sheet = from_ten();
  for (const Vec& begin : {Vec(1, 0, 0), Vec(-2, 3, 0)}) {
    const Place far = seen_at(sheet, begin - 1e9 * Vec::UnitZ());
    EXPECT_NEAR(far.x, 0, 1e-7);
    EXPECT_NEAR(far.y, 0, 1e-7);
  }
}

TEST(Perspective, StraightLinesStayStraight) {
  const Sheet sheet = from_ten();
  const Vec a(1, 2, -3), b(-2, 1, 4);
  const Place begin = seen_at(sheet, a), middle = seen_at(sheet, 0.3 * a + 0.7 * b),
              end = seen_at(sheet, b);
  EXPECT_NEAR((end.x - begin.x) * (middle.y - begin.y), (end.y - begin.y) * (middle.x - begin.x),
              1e-13);
}

TEST(Perspective, ASmallStepIsTheDerivativeOfThePlace) {
  const Sheet sheet = from_ten();
  const Vec p(1, -2, 3), way(0.3, 0.5, -0.8);
  constexpr double h = 1e-5;  // error of the order of its square
  const Place ahead = seen_at(sheet, p + h * way), behind = seen_at(sheet, p - h * way);
  const Place step = seen_step(sheet, p, way);
  EXPECT_NEAR(step.x, (ahead.x - behind.x) / (2 * h), 1e-9);
  EXPECT_NEAR(step.y, (ahead.y - behind.y) / (2 * h), 1e-9);
}

Panel arm_panel(double out_of_plane) {
  const statics::System system = statics::prepare(two_links());
  Panel panel{.scene = scene_of(system, posture_of(system, 0.4, 0.7, 1, 1))};
  for (Vec& p : panel.scene.points) p.z() = out_of_plane * p.x();
  panel.scene.is_planar = out_of_plane == 0;
  return panel;
}

std::vector<Place> places_in(const Picture& picture) {
  std::vector<Place> places;
  for (const Mark& mark : picture.marks) {
    if (const auto* path = std::get_if<Path>(&mark))
      places.insert(places.end(), path->places.begin(), path->places.end());
    if (const auto* disc = std::get_if<Disc>(&mark)) places.push_back(disc->centre);
  }
  return places;
}

double farthest_apart(const Picture& a, const Picture& b) {
  const auto first = places_in(a), second = places_in(b);
  EXPECT_EQ(first.size(), second.size());
  double farthest = 0;
  for (std::size_t i = 0; i < std::min(first.size(), second.size()); ++i)
    farthest = std::max(farthest, std::hypot(first[i].x - second[i].x, first[i].y - second[i].y));
  return farthest;
}

TEST(Perspective, WhatStaysInThePlaneThatIsLookedAtIsDrawnAsBefore) {
  const Panel flat = arm_panel(0);
  EXPECT_LT(farthest_apart(illustrate({flat}, {.is_perspective = true}), illustrate({flat}, {})),
            1e-9);
}

TEST(Perspective, FromVeryFarIsOrthographic) {
  const Panel deep = arm_panel(1);
  View far = natural_view(deep.scene);
  const Picture orthographic = illustrate({deep}, {.view = far});
  far.eye = 1e7;
  EXPECT_LT(farthest_apart(illustrate({deep}, {.view = far}), orthographic), 1e-3);
  EXPECT_GT(farthest_apart(illustrate({deep}, {.is_perspective = true}), orthographic), 1);
}

TEST(Perspective, TheMechanismFillsTheSameRoom) {
  const Panel deep = arm_panel(1);
  const Picture picture = illustrate({deep}, {.is_perspective = true});
  for (const Place p : places_in(picture)) {
    EXPECT_TRUE(p.x > 0 && p.x < picture.width);
    EXPECT_TRUE(p.y > 0 && p.y < picture.height);
  }
}

}  // namespace
}  // namespace springfold::drawing
