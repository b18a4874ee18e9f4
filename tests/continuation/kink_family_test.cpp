// Dead bands: equilibria at one load fill a whole piece of the curve.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kink_problems.hpp"
#include "springfold/continuation/diagram.hpp"
#include "tracing.hpp"

namespace springfold::continuation {
namespace {

using testing::ElementsAre;

std::vector<HitKind> kinds_of(const Curve& curve) {
  std::vector<HitKind> kinds;
  for (const Hit& hit : curve.hits) kinds.push_back(hit.kind);
  return kinds;
}

Curve follow_backlash(const Backlash& problem, double from, double to,
                      const TraceOptions& options = {}) {
  const Piece piece = above({from > problem.gap, from > -problem.gap});
  const double x2 = problem.buckles ? 0 : from * from, towards = to > from ? 1 : -1;
  return follow(problem,
                {Vector{{from, x2}}, problem.force(from, piece), piece, {Vector{{towards, 0}}, 0}},
                {x_reaches(to)}, options);
}

TEST(KinkFamily, OfADeadBandIsReportedOnceWithItsExtent) {
  for (const double direction : {1.0, -1.0})
    for (const double longest : {0.05, 0.01, 0.2}) {
      const Curve curve = follow_backlash({}, -direction, direction, steps_up_to(longest));
      ASSERT_EQ(curve.stop, StopReason::event) << curve.stop_detail;
      ASSERT_THAT(kinds_of(curve),
                  ElementsAre(HitKind::kink, HitKind::family, HitKind::kink, HitKind::user));
      const Hit& family = curve.hits[1];
      EXPECT_NEAR(family.point.x[0], -0.3 * direction, 1e-12);
      EXPECT_NEAR(family.point.lambda, 0, 1e-12);
      EXPECT_EQ(family.s_before, curve.hits[0].point.s);
      EXPECT_EQ(family.s_after, curve.hits[2].point.s);
      EXPECT_NEAR(curve.hits[2].point.x[0], 0.3 * direction, 1e-12);
    }
}

TEST(KinkFamily, HasNoNumberOfNegativeEigenvaluesInside) {
  const Curve curve = follow_backlash({}, -1, 1);
  for (const CurvePoint& p : curve.points)
    EXPECT_EQ(p.negative, std::abs(p.x[0]) < 0.3 ? std::optional<Index>() : 0) << p.x[0];
  EXPECT_EQ(curve.hits[0].point.negative, 0);
  EXPECT_FALSE(curve.hits[0].leaving.at(0).negative);
  EXPECT_FALSE(curve.hits[2].point.negative);
  EXPECT_EQ(curve.hits[2].leaving.at(0).negative, 0);
}

TEST(KinkFamily, EndsInACornerWhereLambdaComesBack) {
  for (const double direction : {1.0, -1.0}) {
    const Curve curve = follow_backlash({.above = -1}, -direction, direction);
    EXPECT_THAT(kinds_of(curve),
                ElementsAre(HitKind::kink, HitKind::family, HitKind::corner, HitKind::user));
    EXPECT_EQ(curve.points.back().negative, direction > 0 ? 1 : 0);
  }
}

TEST(KinkFamily, MayBeginAtTheStart) {
  for (const double direction : {1.0, -1.0}) {
    const Curve curve = follow_backlash({}, 0.1, direction);
    ASSERT_THAT(kinds_of(curve), ElementsAre(HitKind::family, HitKind::kink, HitKind::user));
    EXPECT_EQ(curve.hits[0].s_before, 0);
    EXPECT_EQ(curve.hits[0].s_after, curve.hits[1].point.s);
  }
}

TEST(KinkFamily, EndsWhereTheTraceEndsInside) {
  const Curve curve = follow_backlash({}, -1, 0.2);
  ASSERT_THAT(kinds_of(curve), ElementsAre(HitKind::kink, HitKind::family, HitKind::user));
  EXPECT_EQ(curve.hits[1].s_after, curve.hits[2].point.s);
}

TEST(KinkFamily, WithoutSlopeElsewhereIsStillOne) {  // one unknown, dF/dx = 0 in the band
  const PiecewiseLine line{0, {{1, 0.3, 1}, {2, -0.3, -1}}};
  const Curve curve = follow(line, at(-1, -1.4, 1, 0, {-1, -1}), {x_reaches(1)});
  EXPECT_THAT(kinds_of(curve),
              ElementsAre(HitKind::kink, HitKind::family, HitKind::kink, HitKind::user));
}

TEST(KinkFamily, InWhichAnotherEigenvalueChangesHasABranchPointThere) {
  const Backlash problem{.buckles = true, .cross = 0.07};
  const Curve curve = follow_backlash(problem, -1, 0.2);
  const auto crossed = hits_of(curve, HitKind::branch_point);
  ASSERT_EQ(crossed.size(), 1u);
  EXPECT_NEAR(crossed[0].point.x[0], 0.07, 1e-10);
  EXPECT_EQ(hits_of(curve, HitKind::family).size(), 1u);
  EXPECT_TRUE(hits_of(curve, HitKind::unresolved).empty());
}

TEST(KinkFamily, NarrowerThanIsToldApartIsNotLeftWithoutAWord) {
  for (const double gap : {2e-13, 5e-13, 2e-12, 1e-11}) {
    const Diagram diagram =
        trace_diagram(LooseColumn{gap}, {{.x = Vector::Zero(1), .lambda = 0, .piece = {-1, 1}}},
                      {lambda_reaches(1.5), lambda_reaches(-1.5)}, {});
    EXPECT_FALSE(diagram.doubts.empty()) << gap;
  }
}

}  // namespace
}  // namespace springfold::continuation
