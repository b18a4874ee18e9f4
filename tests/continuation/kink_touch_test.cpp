// Surfaces that are touched, crossed twice, or crossed without slope.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "continuation/kinks/kink.hpp"
#include "kink_problems.hpp"
#include "tracing.hpp"

namespace springfold::continuation {
namespace {

using testing::HasSubstr;

Curve follow_over(const OverSurface& path, double from, double to, double longest = 0.05) {
  const double direction = to > from ? 1 : -1;
  const StartPoint start{Vector{{path.path(from) * (path.path(from) > 0 ? 2.0 / 3 : 1), from}},
                         from,
                         above({path.path(from) > 0}),
                         {Vector{{0, direction}}, direction}};
  return follow(path, start, {lambda_reaches(to)}, steps_up_to(longest));
}

bool log_has(const Curve& curve, const std::string& words) {
  return std::any_of(curve.log.begin(), curve.log.end(), [&](const StepNote& note) {
    return note.reason.find(words) != std::string::npos;
  });
}

TEST(KinkTouch, WithoutCrossingIsNoKink) {
  for (const double bend : {-1.0, 1.0, -0.01, 30.0})
    for (const double from : {-1.0, -0.8123, 0.77})
      for (const double longest : {0.05, 0.01, 0.2}) {
        SCOPED_TRACE(std::to_string(bend) + " " + std::to_string(from));
        const Curve curve = follow_over({.bend = bend}, from, -from, longest);
        ASSERT_EQ(curve.stop, StopReason::event) << curve.stop_detail;
        EXPECT_EQ(curve.hits.size(), 1u);
        EXPECT_TRUE(log_has(curve, "touched, not crossed"));
        for (const CurvePoint& p : curve.points) EXPECT_EQ(p.piece[0], bend > 0 ? 1 : -1);
      }
}

TEST(KinkTouch, JustBeyondOrShortOfTheSurfaceIsToldApart) {
  for (const double height : {1e-8, 1e-9, 1e-10, 2e-11}) {
    SCOPED_TRACE(height);
    const Curve over = follow_over({.height = height}, -1, 1);
    ASSERT_EQ(over.stop, StopReason::event) << over.stop_detail;
    ASSERT_EQ(over.hits.size(), 3u);
    const double place = std::sqrt(height);
    EXPECT_NEAR(over.hits[0].point.lambda, -place, 2e-13 / place);
    EXPECT_NEAR(over.hits[1].point.lambda, place, 2e-13 / place);
    EXPECT_EQ(over.hits[0].kind, HitKind::kink);
    const Curve under = follow_over({.height = -height}, -1, 1);
    ASSERT_EQ(under.stop, StopReason::event) << under.stop_detail;
    EXPECT_EQ(under.hits.size(), 1u);
  }
}

TEST(KinkTouch, BeforeACrossingLeavesTheCrossing) {
  // (s + 0.03)^2 (s - 0.02): touches from below, then crosses
  const OverSurface path{.height = -1.8e-5, .slope = -3e-4, .bend = 0.04, .twist = 1};
  for (const double longest : {0.01, 0.05, 0.2}) {
    const Curve curve = follow_over(path, -0.6, 0.6, longest);
    ASSERT_EQ(curve.stop, StopReason::event) << curve.stop_detail;
    ASSERT_EQ(curve.hits.size(), 2u);
    EXPECT_EQ(curve.hits[0].kind, HitKind::kink);
    EXPECT_NEAR(curve.hits[0].point.lambda, 0.02, 1e-11);
    EXPECT_EQ(curve.points.back().piece, Piece{1});
  }
}

TEST(KinkTouch, ThreeCrossingsWithinAStepAreThree) {
  for (const double d : {0.02, 1e-3, 3e-4}) {  // s (s^2 - d^2)
    const OverSurface path{.slope = -d * d, .bend = 0, .twist = 1};
    const Curve curve = follow_over(path, -0.61, 0.6, 0.2);
    ASSERT_EQ(curve.stop, StopReason::event) << curve.stop_detail;
    ASSERT_EQ(curve.hits.size(), 4u) << d;
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(curve.hits[static_cast<std::size_t>(i)].point.lambda, (i - 1) * d,
                  1e-12 / (d * d));
  }
}

TEST(KinkTouch, ACrossingWithoutSlopeIsOneKink) {
  for (const double from : {-0.6, 0.6}) {
    const Curve curve = follow_over({.bend = 0, .twist = 1}, from, -from);
    ASSERT_EQ(curve.stop, StopReason::event) << curve.stop_detail;
    ASSERT_EQ(curve.hits.size(), 2u);
    EXPECT_EQ(curve.hits[0].kind, HitKind::kink);
    EXPECT_NEAR(curve.hits[0].point.x[0], 0, 1e-10);
    EXPECT_EQ(curve.points.back().piece, above({from < 0}));
  }
}

TEST(KinkTouch, AsStartHasTheTwoWaysOfItsPiece) {
  for (const double bend : {-1.0, 1.0}) {
    const Rays rays = rays_from(OverSurface{.bend = bend}, Vector::Zero(2), 0, {-1}, {});
    EXPECT_TRUE(rays.complete) << rays.why;
    ASSERT_EQ(rays.rays.size(), 2u);
    for (const Ray& ray : rays.rays) EXPECT_EQ(ray.piece, above({bend > 0}));
    EXPECT_NEAR(rays.rays[0].tangent.dlambda + rays.rays[1].tangent.dlambda, 0, 1e-15);
  }
  const Rays rays = rays_from(OverSurface{.bend = 0, .twist = 1}, Vector::Zero(2), 0, {-1}, {});
  EXPECT_TRUE(rays.complete) << rays.why;
  ASSERT_EQ(rays.rays.size(), 2u);
  for (const Ray& ray : rays.rays) EXPECT_EQ(ray.piece[0] > 0, ray.tangent.dlambda > 0);
}

TEST(KinkTouch, AsStartIsLeftWithoutAKink) {
  const OverSurface path;
  for (const double direction : {1.0, -1.0}) {
    const Curve curve = follow(path, {Vector::Zero(2), 0, {1}, {Vector{{0, direction}}, direction}},
                               {lambda_reaches(0.5 * direction)});
    EXPECT_EQ(curve.stop, StopReason::event) << curve.stop_detail;
    EXPECT_EQ(curve.hits.size(), 1u);
  }
}

}  // namespace
}  // namespace springfold::continuation
