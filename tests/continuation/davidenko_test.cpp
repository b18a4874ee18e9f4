// Two ways along one curve that share only the corrector must agree: the path follower and the
// integrated flow.
#include "springfold/continuation/davidenko.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "kink_problems.hpp"
#include "tracing.hpp"
#include "von_mises.hpp"

namespace springfold::continuation {
namespace {

using testing::HasSubstr;

Curve flow_along(ProblemView problem, const StartPoint& start, const std::vector<Event>& events,
                 const TraceOptions& options = {}, const StepObserver& observer = {}) {
  const Ray ray = ray_of(problem, start, options);
  Curve curve = davidenko(problem, start.x, start.lambda, ray, events, options, observer);
  expect_laws(problem, curve);
  return curve;
}

/// Distance from a point to a curve: from the nearest point of the curve, corrected across the
/// direction to it.
double distance_to(ProblemView problem, const Curve& curve, const CurvePoint& point) {
  const Vector weights = problem.metric();
  const auto apart = [&](const CurvePoint& p) {
    return std::hypot((p.x - point.x).norm(), p.lambda - point.lambda);
  };
  const CurvePoint& near = *std::min_element(
      curve.points.begin(), curve.points.end(),
      [&](const CurvePoint& p, const CurvePoint& q) { return apart(p) < apart(q); });
  // Along the tangent of the curve to the height of the point, then back onto the curve.
  const Direction towards{point.x - near.x, point.lambda - near.lambda};
  const double t = metric_product(weights, near.tangent, towards);
  const NewtonResult there =
      correct(problem, weights, near.x + t * near.tangent.dx,
              near.lambda + t * near.tangent.dlambda, point.piece, near.tangent, {});
  EXPECT_TRUE(converged(there));
  return std::hypot((there.x - point.x).norm(), there.lambda - point.lambda);
}

/// Same ends, same special points, and each goes through the points of the other.
void expect_agreement(ProblemView problem, const StartPoint& start,
                      const std::vector<Event>& events, const TraceOptions& options = {}) {
  const Curve one = follow(problem, start, events, options);
  const Curve two = flow_along(problem, start, events, options);
  EXPECT_EQ(one.stop, two.stop) << one.stop_detail << " / " << two.stop_detail;
  std::vector<Hit> expected;
  std::copy_if(one.hits.begin(), one.hits.end(), std::back_inserter(expected),
               [](const Hit& hit) { return hit.kind != HitKind::branch_point; });
  expect_same_hits(expected, two.hits, 1e-10);
  for (const CurvePoint& point : two.points)
    EXPECT_LT(distance_to(problem, one, point), 1e-9) << "s = " << point.s;
  for (const CurvePoint& point : one.points)
    EXPECT_LT(distance_to(problem, two, point), 1e-9) << "s = " << point.s;
}

TEST(Davidenko, GoesRoundACircleByItsArcLength) {
  const double angle = 1;
  const StartPoint start = at(std::cos(angle), std::sin(angle), -1, 1);
  const Curve curve = flow_along(circle(), start, {x_reaches(-0.5)});
  ASSERT_EQ(curve.stop, StopReason::event);
  for (const CurvePoint& p : curve.points) {
    EXPECT_NEAR(p.x[0], std::cos(angle + p.s), 1e-9);
    EXPECT_NEAR(p.lambda, std::sin(angle + p.s), 1e-9);
  }
  ASSERT_EQ(curve.hits.size(), 2u);
  EXPECT_EQ(curve.hits[0].kind, HitKind::limit_point);
  EXPECT_NEAR(curve.hits[0].point.x[0], 0, 1e-12);
  EXPECT_NEAR(curve.hits[0].point.s, std::numbers::pi / 2 - angle, 1e-9);
  EXPECT_NEAR(curve.hits[1].point.x[0], -0.5, 1e-12);
}

TEST(Davidenko, AgreesWithThePathFollowerOnACircle) {
  expect_agreement(circle(), at(std::cos(1.0), std::sin(1.0), -1, 1), {x_reaches(0.9)});
}

TEST(Davidenko, AgreesWithThePathFollowerOnCubics) {
  for (const double a : {3.0, 1.0, 0.01, -0.5}) {
    const double x = -2, lambda = x * (x * x - a);
    expect_agreement(cusp(a), at(x, lambda, 1, 0), {x_reaches(2)});
  }
}

TEST(Davidenko, AgreesWithThePathFollowerOnManyFolds) {
  const double lambda = 2 * std::sin(-3.0) - 1;
  expect_agreement(fold_ladder(), at(-1, lambda, 1, 0), {x_reaches(4)});
}

TEST(Davidenko, AgreesWithThePathFollowerOnTheVonMisesTruss) {
  const VonMises truss{};
  const StartPoint start{Vector{{0, 0.9}}, truss.upright_load(0.9), {}, {Vector{{0, -1}}, 0}};
  expect_agreement(truss, start, {x_reaches(-0.9, 1)});
  const Curve curve = flow_along(truss, start, {x_reaches(-0.9, 1)});
  ASSERT_EQ(curve.hits.size(), 3u);
  EXPECT_NEAR(curve.hits[0].point.x[1], truss.height_at_limit_point(), 1e-12);
  EXPECT_NEAR(curve.hits[1].point.x[1], -truss.height_at_limit_point(), 1e-12);
}

TEST(Davidenko, PassesBranchPointsOnItsBranchWithoutReportingThem) {
  const VonMises steep{.a = 0.4};  // (a/L0)^2 < 4/27: it sways before it snaps
  const StartPoint start{Vector{{0, 1.18}}, steep.upright_load(1.18), {}, {Vector{{0, -1}}, 0}};
  expect_agreement(steep, start, {x_reaches(-1.18, 1)});
  const Curve curve = flow_along(steep, start, {x_reaches(-1.18, 1)});
  for (const CurvePoint& p : curve.points) EXPECT_LT(std::abs(p.x[0]), 1e-12);
  EXPECT_EQ(curve.hits.size(), 3u);
}

TEST(Davidenko, AgreesWithThePathFollowerOnBrokenLines) {
  // Slopes 1, -2, 0.5, -0.5, 1.5, 2.5: four corners and a kink.
  const PiecewiseLine line{1, {{-3, 0, 1}, {2.5, 0.5, 1}, {-1, 1, 1}, {2, 1.5, 1}, {1, 1.7, 1}}};
  const Piece piece = line.piece_at(-1);
  expect_agreement(line, at(-1, -1, 1, 1, piece), {x_reaches(2)});
  const Curve curve = flow_along(line, at(-1, -1, 1, 1, piece), {x_reaches(2)});
  ASSERT_EQ(hits_of(curve, HitKind::corner).size(), 4u);
  ASSERT_EQ(hits_of(curve, HitKind::kink).size(), 1u);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(curve.hits[i].point.x[0], line.springs[i].from, 1e-13);
}

TEST(Davidenko, StopsAtAKinkWithSeveralWaysOut) {
  const BarsInSeries bars{.after = -0.5};
  const StartPoint start{Vector{{0.2, 0.2}}, 0.4, Piece{-1, -1}, {Vector{{1, 1}}, 2}};
  const Curve curve = flow_along(bars, start, {lambda_reaches(3)});
  EXPECT_EQ(curve.stop, StopReason::several_ways);
  EXPECT_THAT(curve.stop_detail, HasSubstr("3 ways out"));
  ASSERT_EQ(curve.hits.size(), 1u);
  EXPECT_EQ(curve.hits[0].kind, HitKind::branching_kink);
  EXPECT_EQ(curve.hits[0].leaving.size(), 3u);
  EXPECT_NEAR(curve.hits[0].point.lambda, 2, 1e-12);
}

TEST(Davidenko, MeetsASurfaceTwiceWhereItIsCrossedAndCrossedBackWithinAStep) {
  for (const double height : {0.1, 1e-3, 1e-5, 1e-7}) {
    const StartPoint start{Vector{{height - 1, -1}}, -1, {-1}, {Vector{{2, 1}}, 1}};
    const Curve curve = flow_along(OverSurface{height}, start, {lambda_reaches(1)});
    ASSERT_EQ(curve.stop, StopReason::event) << "height " << height << ": " << curve.stop_detail;
    const auto kinks = hits_of(curve, HitKind::kink);
    ASSERT_EQ(kinks.size(), 2u) << "height " << height;
    EXPECT_NEAR(kinks[0].point.lambda, -std::sqrt(height), 1e-11);
    EXPECT_NEAR(kinks[1].point.lambda, std::sqrt(height), 1e-11);
  }
}

TEST(Davidenko, MeetsNoSurfaceWhereItIsMissed) {
  for (const double gap : {1e-3, 1e-5, 1e-7}) {
    const StartPoint start{Vector{{-gap - 1, -1}}, -1, {-1}, {Vector{{2, 1}}, 1}};
    const Curve curve = flow_along(OverSurface{-gap}, start, {lambda_reaches(1)});
    EXPECT_EQ(curve.stop, StopReason::event) << "gap " << gap << ": " << curve.stop_detail;
    EXPECT_EQ(curve.hits.size(), 1u);
  }
}

TEST(Davidenko, StaysOnItsStrandAmongNeighboursMuchCloserThanAStep) {
  // sin(pi (x - tanh lambda)/d) = 0: curves at distance d from each other.
  for (const double d : {1e-1, 1e-3, 1e-5}) {
    const double pi = std::numbers::pi;
    const auto phase = [=](double x, double l) { return pi * (x - std::tanh(l)) / d; };
    const ScalarProblem strands{
        [=](double x, double l) { return d / pi * std::sin(phase(x, l)); },
        [=](double x, double l) { return std::cos(phase(x, l)); },
        [=](double x, double l) { return -std::cos(phase(x, l)) / (std::cosh(l) * std::cosh(l)); }};
    const Curve curve = flow_along(strands, at(std::tanh(-2.0), -2, 0, 1), {lambda_reaches(2)});
    ASSERT_EQ(curve.stop, StopReason::event) << "d = " << d << ": " << curve.stop_detail;
    for (const CurvePoint& p : curve.points) EXPECT_NEAR(p.x[0], std::tanh(p.lambda), 1e-10);
  }
}

TEST(Davidenko, EndsWithAReasonWhereTheProblemIsNotDefinedAnyMore) {
  ScalarProblem half = graph([](double x) { return x * x; }, [](double x) { return 2 * x; });
  half.inside = [](double x, double) { return x < 1; };
  const Curve curve = flow_along(half, at(0.5, 0.25, 1, 0), {});
  EXPECT_EQ(curve.stop, StopReason::step_too_small);
  EXPECT_NEAR(curve.points.back().x[0], 1, 1e-6);
  EXPECT_FALSE(curve.log.empty());
  EXPECT_FALSE(curve.stop_detail.empty());
}

TEST(Davidenko, StopsWhenTheObserverAsksOrThePointsAreUp) {
  int calls = 0;
  const Curve asked = flow_along(circle(), at(1, 0, 0, 1), {}, {},
                                 [&calls](const CurvePoint&) { return ++calls < 7; });
  EXPECT_EQ(asked.stop, StopReason::observer);
  EXPECT_EQ(asked.points.size(), 8u);
  TraceOptions options;
  options.maximum_points = 12;
  const Curve full = flow_along(circle(), at(1, 0, 0, 1), {}, options);
  EXPECT_EQ(full.stop, StopReason::max_points);
  EXPECT_EQ(full.points.size(), 12u);
}

TEST(Davidenko, GivesAnEventOnTheEndOfAStepOnce) {
  // The first step of the flow ends at s = step.initial exactly on lambda = step.initial.
  const ScalarProblem level{[](double x, double) { return x; }, [](double, double) { return 1.0; },
                            [](double, double) { return 0.0; }};
  const Event event{"here",
                    [](const CurvePoint& p) { return p.lambda - TraceOptions{}.step.initial; }};
  const Curve curve = flow_along(level, at(0, 0, 0, 1), {event, lambda_reaches(0.3)});
  ASSERT_EQ(curve.hits.size(), 2u);
  EXPECT_EQ(curve.hits[0].name, "here");
  EXPECT_NEAR(curve.hits[0].point.lambda, 0.01, 1e-14);
}

}  // namespace
}  // namespace springfold::continuation
