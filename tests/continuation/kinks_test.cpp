// Piecewise-smooth curves: switching surfaces are met exactly, passed where there is one way out,
// and never passed by chance where there are several.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "continuation/kinks/kink.hpp"
#include "kink_problems.hpp"
#include "tracing.hpp"

namespace springfold::continuation {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// From x = -1 upwards to x = 2.
Curve follow_line(const PiecewiseLine& line, const TraceOptions& options = {}) {
  const Piece piece = line.piece_at(-1);
  Vector F;
  line.residual(Vector::Constant(1, -1), 0, piece, F);
  return follow(line, at(-1, F[0], 1, 0, piece), {x_reaches(2)}, options);
}

double force_of(const PiecewiseLine& line, double x) {
  double force = line.k0 * x;
  for (const OneSided& s : line.springs)
    force += s.stiffness * s.side * std::max(0.0, s.side * (x - s.from));
  return force;
}

TEST(Kink, LeadsOntoAStopThatIsManyTimesAsStiffAsTheRest) {
  for (const double stiffness : {1e3, 1e5, 1e6, 1e9}) {
    const PiecewiseLine line{1, {{stiffness, 0.3, 1}}};
    const StartPoint start = at(-1, -1, 1, 0, line.piece_at(-1));
    const TraceOptions options;
    const Curve curve = trace(line, start.x, start.lambda, ray_of(line, start, options),
                              {x_reaches(0.3 + 10 / stiffness)}, options);
    ASSERT_EQ(curve.stop, StopReason::event) << stiffness << ": " << to_string(curve.stop);
    ASSERT_EQ(curve.hits.size(), 2u);  // the kink and the end
    EXPECT_EQ(curve.hits[0].kind, HitKind::kink);
    EXPECT_NEAR(curve.hits[0].point.x[0], 0.3, 1e-13);
    for (const CurvePoint& p : curve.points)
      EXPECT_NEAR(p.lambda, force_of(line, p.x[0]), 4e-15 * std::max(1.0, stiffness)) << stiffness;
  }
}

TEST(Kink, LiesExactlyOnItsBreakpointWithBothTangents) {
  const PiecewiseLine line{1, {{2, 0.3, 1}, {0.5, -0.4, -1}, {4, 1.1, 1}}};
  const Curve curve = follow_line(line);
  ASSERT_EQ(curve.stop, StopReason::event);
  ASSERT_EQ(curve.hits.size(), 4u);  // three kinks and the end
  const std::vector<double> places{-0.4, 0.3, 1.1}, slopes{1.5, 1, 3, 7};
  const std::vector<Index> order{1, 0, 2};
  for (std::size_t i = 0; i < 3; ++i) {
    const Hit& kink = curve.hits[i];
    EXPECT_EQ(kink.kind, HitKind::kink);
    EXPECT_THAT(kink.switches, ElementsAre(order[i]));
    EXPECT_EQ(kink.name, "stop " + std::to_string(order[i] + 1));
    EXPECT_NEAR(kink.point.x[0], places[i], 1e-13);
    EXPECT_NEAR(kink.point.lambda, force_of(line, places[i]), 1e-12);
    ASSERT_EQ(kink.leaving.size(), 1u);
    const CurvePoint& leaving = kink.leaving[0];
    EXPECT_NEAR(kink.point.tangent.dlambda / kink.point.tangent.dx[0], slopes[i], 1e-12);
    EXPECT_NEAR(leaving.tangent.dlambda / leaving.tangent.dx[0], slopes[i + 1], 1e-12);
    EXPECT_EQ(leaving.x, kink.point.x);
    EXPECT_NE(leaving.piece, kink.point.piece);
  }
  for (const CurvePoint& p : curve.points)
    EXPECT_NEAR(p.lambda, force_of(line, p.x[0]), 1e-12) << "x = " << p.x[0];
}

TEST(Kink, IsFoundWhereAStepEndsOnItToRounding) {
  const PiecewiseLine plain{1, {{2, 1.9, 1}}};
  const Curve curve = follow_line(plain);
  int tried = 0;
  for (const CurvePoint& p : curve.points) {
    if (p.x[0] < -0.9 || p.x[0] > 1.5) continue;
    for (int units = -4; units <= 4; ++units) {
      const double place = p.x[0] * (1 + units * std::numeric_limits<double>::epsilon());
      const Curve with_spring = follow_line({1, {{0.5, place, 1}, {2, 1.9, 1}}});
      EXPECT_EQ(with_spring.stop, StopReason::event) << with_spring.stop_detail;
      ASSERT_EQ(with_spring.hits.size(), 3u) << place << ", " << units << " units";
      EXPECT_NEAR(with_spring.hits[0].point.x[0], place, 1e-13);
      ++tried;
    }
  }
  EXPECT_GT(tried, 100);
}

TEST(Kink, IsACornerWhereLambdaTurnsBack) {
  // Slopes 1, -2, 0.5, -0.5, 1.5: turns at 0, 0.5, 1, 1.5.
  const PiecewiseLine line{1, {{-3, 0, 1}, {2.5, 0.5, 1}, {-1, 1, 1}, {2, 1.5, 1}, {1, 1.7, 1}}};
  const Curve curve = follow_line(line);
  ASSERT_EQ(curve.stop, StopReason::event);
  std::vector<HitKind> kinds;
  for (const Hit& hit : curve.hits) kinds.push_back(hit.kind);
  EXPECT_THAT(kinds, ElementsAre(HitKind::corner, HitKind::corner, HitKind::corner, HitKind::corner,
                                 HitKind::kink, HitKind::user));
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(curve.hits[i].point.x[0], line.springs[i].from, 1e-13);
  EXPECT_TRUE(hits_of(curve, HitKind::limit_point).empty()) << "both sides are regular";
}

TEST(Kink, MayFollowCloselyOnAnother) {
  const PiecewiseLine line{1, {{1, 0.5, 1}, {1, 0.5 + 1e-3, 1}, {1, 0.5 + 1e-6, 1}}};
  const Curve curve = follow_line(line);
  ASSERT_EQ(curve.stop, StopReason::event);
  ASSERT_EQ(curve.hits.size(), 4u);
  EXPECT_NEAR(curve.hits[0].point.x[0], 0.5, 1e-12);
  EXPECT_NEAR(curve.hits[1].point.x[0], 0.5 + 1e-6, 1e-12);
  EXPECT_NEAR(curve.hits[2].point.x[0], 0.5 + 1e-3, 1e-12);
}

TEST(Kink, TakesSwitchesAtOnePointTogether) {
  const PiecewiseLine line{1, {{1, 0.5, 1}, {2, 0.5, 1}, {3, 0.5, -1}}};
  const Curve curve = follow_line(line);
  ASSERT_EQ(curve.stop, StopReason::event);
  ASSERT_EQ(curve.hits.size(), 2u);
  EXPECT_EQ(curve.hits[0].kind, HitKind::kink);
  EXPECT_THAT(curve.hits[0].switches, ElementsAre(0, 1, 2));
  EXPECT_EQ(curve.hits[0].name, "stop 1, stop 2, stop 3");
  EXPECT_THAT(curve.points.back().piece, ElementsAre(1, 1, 1));
}

StartPoint unstretched() { return {Vector{{0.2, 0.2}}, 0.4, Piece{-1, -1}, {Vector{{1, 1}}, 2}}; }

TEST(Kink, OfTwoSymmetricBarsThatHardenHasOneWayOut) {
  const BarsInSeries bars{.after = 2};
  const Curve curve = follow(bars, unstretched(), {lambda_reaches(3)});
  ASSERT_EQ(curve.stop, StopReason::event);
  ASSERT_EQ(curve.hits.size(), 2u);
  EXPECT_EQ(curve.hits[0].kind, HitKind::kink);
  EXPECT_THAT(curve.hits[0].switches, ElementsAre(0, 1));
  EXPECT_NEAR(curve.hits[0].point.lambda, 2, 1e-12);
  EXPECT_NEAR(curve.hits[1].point.x[0], 1.5, 1e-12);
  EXPECT_NEAR(curve.hits[1].point.x[1], 1.5, 1e-12);
}

TEST(BranchingKink, OfTwoSymmetricBarsThatSoftenHasAllThreeWaysOut) {
  // Beyond the limit both may soften, or one softens and the other springs back.
  const BarsInSeries bars{.after = -0.5};
  const Curve curve = follow(bars, unstretched(), {lambda_reaches(3)});
  EXPECT_EQ(curve.stop, StopReason::several_ways);
  EXPECT_THAT(curve.stop_detail, HasSubstr("3 ways out"));
  ASSERT_EQ(curve.hits.size(), 1u);
  const Hit& kink = curve.hits[0];
  EXPECT_EQ(kink.kind, HitKind::branching_kink);
  EXPECT_NEAR(kink.point.lambda, 2, 1e-12);
  ASSERT_EQ(kink.leaving.size(), 3u);
  int together = 0, alone = 0;
  for (const CurvePoint& way : kink.leaving) {
    const Vector dx = way.tangent.dx;
    EXPECT_GT(way.tangent.dlambda, 0);
    if (way.piece == Piece{1, 1}) {
      EXPECT_NEAR(dx[0], dx[1], 1e-12);
      ++together;
    } else {
      const Index soft = way.piece[0] > 0 ? 0 : 1;
      EXPECT_NEAR(dx[1 - soft], -0.5 * dx[soft], 1e-12);  // equal forces: -0.5 dx = dx'
      ++alone;
    }
  }
  EXPECT_EQ(together, 1);
  EXPECT_EQ(alone, 2);
}

TEST(BranchingKink, OfUnequalBarsIsNone) {
  // The weaker bar softens first and alone; the force falls and the other springs back.
  const BarsInSeries bars{.after = -0.5, .limit_2 = 1.2};
  const Curve curve = follow(bars, unstretched(), {lambda_reaches(3)});
  ASSERT_EQ(curve.stop, StopReason::event);
  ASSERT_EQ(curve.hits.size(), 2u);
  EXPECT_EQ(curve.hits[0].kind, HitKind::kink);
  EXPECT_NEAR(curve.hits[0].point.x[0], 1, 1e-12);
  EXPECT_GT(curve.hits[1].point.x[0], 1);
  EXPECT_LT(curve.hits[1].point.x[1], 1);
}

/// |x| = |lambda|: four half lines meet at the origin.
struct Cross {
  static Index size() { return 1; }
  static bool residual(const Vector& x, double lambda, const Piece& piece, Vector& F) {
    F = Vector::Constant(1, piece[0] * x[0] - piece[1] * lambda);
    return true;
  }
  static bool derivatives(const Vector&, double, const Piece& piece, Matrix& dF_dx,
                          Vector& dF_dlambda) {
    dF_dx = Matrix::Constant(1, 1, piece[0]);
    dF_dlambda = Vector::Constant(1, -piece[1]);
    return true;
  }
  static Index switch_count() { return 2; }
  static bool switches(const Vector& x, double lambda, Vector& g) {
    g = Vector{{x[0], lambda}};
    return true;
  }
  static bool switch_gradients(const Vector&, double, Matrix& dg_dx, Vector& dg_dlambda) {
    dg_dx = Vector{{1, 0}};
    dg_dlambda = Vector{{0, 1}};
    return true;
  }
};

TEST(Rays, AreFoundInEveryPieceAroundAPoint) {
  const Rays rays = rays_from(Cross{}, Vector::Zero(1), 0, {1, 1}, {});
  EXPECT_TRUE(rays.complete);
  ASSERT_EQ(rays.rays.size(), 4u);
  for (const Ray& ray : rays.rays) {
    EXPECT_EQ(ray.tangent.dx[0] > 0, ray.piece[0] > 0);
    EXPECT_EQ(ray.tangent.dlambda > 0, ray.piece[1] > 0);
  }
}

TEST(Rays, ArrivingAtACrossingThreeAreLeft) {
  const Curve curve = follow(Cross{}, at(-1, -1, 1, 1, {-1, -1}), {});
  EXPECT_EQ(curve.stop, StopReason::several_ways);
  ASSERT_EQ(curve.hits.size(), 1u);
  EXPECT_EQ(curve.hits[0].leaving.size(), 3u);
}

/// Falls apart at x = 0: lambda = x on the left, and no solution on the right.
struct OneWay : PiecewiseLine {
  OneWay() : PiecewiseLine{1, {{1, 0, 1}}} {}
  bool residual(const Vector& x, double lambda, const Piece& piece, Vector& F) const {
    if (piece[0] > 0) return false;
    return PiecewiseLine::residual(x, lambda, piece, F);
  }
  bool derivatives(const Vector& x, double lambda, const Piece& piece, Matrix& dF_dx,
                   Vector& dF_dlambda) const {
    return piece[0] < 0 && PiecewiseLine::derivatives(x, lambda, piece, dF_dx, dF_dlambda);
  }
};

TEST(Kink, WithoutAWayOutEndsTheCurve) {
  const Curve curve = follow(OneWay{}, at(-1, -1, 1, 1, {-1}), {});
  EXPECT_EQ(curve.stop, StopReason::no_way_out);
  EXPECT_THAT(curve.stop_detail, HasSubstr("stop 1"));
  ASSERT_EQ(curve.hits.size(), 1u);
  EXPECT_NEAR(curve.hits[0].point.x[0], 0, 1e-13);
}

TEST(Kink, IsFoundTwiceWhereASurfaceIsCrossedAndCrossedBackWithinAStep) {
  for (const double height : {0.1, 1e-3, 1e-5, 1e-7}) {
    const OverSurface path{height};
    const StartPoint start{Vector{{height - 1, -1}}, -1, {-1}, {Vector{{2, 1}}, 1}};
    const Curve curve = follow(path, start, {lambda_reaches(1)}, steps_up_to(0.2));
    ASSERT_EQ(curve.stop, StopReason::event) << "height " << height << ": " << curve.stop_detail;
    const auto kinks = hits_of(curve, HitKind::kink);
    ASSERT_EQ(kinks.size(), 2u) << "height " << height;
    EXPECT_NEAR(kinks[0].point.lambda, -std::sqrt(height), 1e-11);
    EXPECT_NEAR(kinks[1].point.lambda, std::sqrt(height), 1e-11);
  }
}

TEST(Kink, IsNoneWhereTheSurfaceIsMissed) {
  for (const double gap : {0.1, 1e-3, 1e-5, 1e-7}) {
    const OverSurface path{-gap};
    const StartPoint start{Vector{{-gap - 1, -1}}, -1, {-1}, {Vector{{2, 1}}, 1}};
    const Curve curve = follow(path, start, {lambda_reaches(1)}, steps_up_to(0.2));
    EXPECT_EQ(curve.stop, StopReason::event) << "gap " << gap << ": " << curve.stop_detail;
    EXPECT_EQ(curve.hits.size(), 1u);
  }
}

TEST(Kink, TheStepLogSaysWhereStepsWereCut) {
  const Curve curve = follow_line({1, {{2, 0.3, 1}}});
  ASSERT_EQ(curve.log.size(), 1u);
  EXPECT_EQ(curve.log[0].reason, "cut: stop 1");
  EXPECT_NEAR(curve.log[0].s + curve.log[0].step, curve.hits[0].point.s, 1e-15);
}

}  // namespace
}  // namespace springfold::continuation
