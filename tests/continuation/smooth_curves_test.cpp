// Limit points and branch points of curves with closed forms: all of them, exactly, nothing else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tracing.hpp"

namespace springfold::continuation {
namespace {

using std::numbers::pi;

TEST(Circle, HasItsLimitPointsAtMinusOneAndOne) {
  const Event once_round = stop_where("s", [](const CurvePoint& p) { return p.s - 6; });
  const Curve curve = follow(circle(), at(std::cos(0.1), std::sin(0.1), 0, 1), {once_round});
  ASSERT_EQ(curve.stop, StopReason::event);
  const auto limits = hits_of(curve, HitKind::limit_point);
  ASSERT_EQ(limits.size(), 2u);
  EXPECT_EQ(curve.hits.size(), 3u);
  for (const double side : {1.0, -1.0}) {
    const CurvePoint& p = limits[side > 0 ? 0 : 1].point;
    EXPECT_NEAR(p.lambda, side, 1e-12);
    EXPECT_NEAR(p.x[0], 0, 1e-12);
    EXPECT_NEAR(p.tangent.dlambda, 0, 1e-12);
    EXPECT_FALSE(p.negative.has_value()) << "an eigenvalue is zero there";
  }
}

TEST(Cusp, HasBothLimitPointsOfItsUnfolding) {
  for (const double a : {1.0, 0.1, 0.01}) {
    const double fold = std::sqrt(a / 3);
    const Curve curve = follow(cusp(a), at(-1.5, cusp(a).F(-1.5, 0), 1, 0), {x_reaches(1.5)});
    ASSERT_EQ(curve.stop, StopReason::event);
    const auto limits = hits_of(curve, HitKind::limit_point);
    ASSERT_EQ(limits.size(), 2u) << "a = " << a;
    EXPECT_EQ(curve.hits.size(), 3u) << "nothing else but the end";
    EXPECT_NEAR(limits[0].point.x[0], -fold, 1e-12 / fold);
    EXPECT_NEAR(limits[1].point.x[0], fold, 1e-12 / fold);
    EXPECT_NEAR(limits[0].point.lambda, 2 * fold * fold * fold, 1e-13);
  }
}

TEST(Cusp, HasNoLimitPointWhereLambdaOnlyPauses) {
  for (const double a : {-1.0, -0.1, -0.01}) {
    const Curve curve = follow(cusp(a), at(-1.5, cusp(a).F(-1.5, 0), 1, 0), {x_reaches(1.5)});
    ASSERT_EQ(curve.stop, StopReason::event);
    EXPECT_EQ(curve.hits.size(), 1u) << "a = " << a;
  }
}

TEST(Cusp, ReportsNoLimitPointInTheDegenerateCase) {
  const Curve curve = follow(cusp(0), at(-1.5, cusp(0).F(-1.5, 0), 1, 0), {x_reaches(1.5)});
  ASSERT_EQ(curve.stop, StopReason::event);
  EXPECT_TRUE(hits_of(curve, HitKind::limit_point).empty());
  EXPECT_TRUE(hits_of(curve, HitKind::branch_point).empty());
  EXPECT_TRUE(hits_of(curve, HitKind::unresolved).empty());
}

TEST(FoldLadder, HasAllItsLimitPointsAndNothingElse) {
  std::vector<double> folds;
  for (int k = -2; k <= 2; ++k)
    for (const double side : {-1.0, 1.0}) {
      const double x = (side * std::acos(-1.0 / 6) + 2 * pi * k) / 3;
      if (std::abs(x) < 3) folds.push_back(x);
    }
  std::sort(folds.begin(), folds.end());
  const ScalarProblem ladder = fold_ladder();
  const Curve curve = follow(ladder, at(-3, ladder.F(-3, 0), 1, 0), {x_reaches(3)});
  ASSERT_EQ(curve.stop, StopReason::event);
  const auto limits = hits_of(curve, HitKind::limit_point);
  ASSERT_EQ(limits.size(), folds.size());
  EXPECT_EQ(curve.hits.size(), folds.size() + 1);
  for (std::size_t i = 0; i < folds.size(); ++i) {
    EXPECT_NEAR(limits[i].point.x[0], folds[i], 1e-12);
    EXPECT_NEAR(limits[i].point.lambda, folds[i] + 2 * std::sin(3 * folds[i]), 1e-12);
  }
}

TEST(Strut, StraightBucklesAtOne) {
  const Curve curve = follow(strut(), at(0, 0.2, 0, 1), {lambda_reaches(1.5)});
  ASSERT_EQ(curve.stop, StopReason::event);
  const auto branches = hits_of(curve, HitKind::branch_point);
  ASSERT_EQ(branches.size(), 1u);
  EXPECT_EQ(curve.hits.size(), 2u);
  EXPECT_NEAR(branches[0].point.lambda, 1, 1e-10);
  EXPECT_NEAR(branches[0].point.x[0], 0, 1e-10);
  EXPECT_EQ(branches[0].multiplicity, 1);
}

TEST(Strut, BentFollowsItsClosedFormThroughTheBranchPoint) {
  const Curve curve = follow(strut(), at(-2, 2 / std::sin(2), 1, 0), {x_reaches(2)});
  ASSERT_EQ(curve.stop, StopReason::event);
  for (const CurvePoint& p : curve.points)
    EXPECT_NEAR(p.lambda, p.x[0] == 0 ? 1 : p.x[0] / std::sin(p.x[0]), 1e-11);
  // lambda has its minimum where the straight branch crosses.
  ASSERT_EQ(curve.hits.size(), 2u) << "one special point and the end";
  EXPECT_NEAR(curve.hits[0].point.lambda, 1, 1e-10);
  EXPECT_NEAR(curve.hits[0].point.x[0], 0, 1e-6);
}

TEST(Strut, CrookedHasNoSpecialPointOnItsNaturalBranch) {
  for (const double theta_0 : {0.001, 0.05, 0.3}) {
    const Curve curve = follow(strut(theta_0), at(theta_0, 0, 1, 1), {x_reaches(2.5)});
    ASSERT_EQ(curve.stop, StopReason::event);
    EXPECT_EQ(curve.hits.size(), 1u) << "theta_0 = " << theta_0;
    for (const CurvePoint& p : curve.points)
      EXPECT_NEAR(p.lambda * std::sin(p.x[0]), p.x[0] - theta_0, 1e-12) << "s = " << p.s;
  }
}

TEST(Strut, CrookedHasItsComplementaryLimitPoint) {
  // tan t = t - theta_0, lambda = 1 / cos t: tabulated roots.
  for (const auto& [theta_0, t, lambda] : {std::tuple{0.001, -0.143826025138, 1.010432866428},
                                           {0.01, -0.306772547185, 1.048973234477},
                                           {0.05, -0.512039814316, 1.147121943333},
                                           {0.1, -0.631659472661, 1.239082557352}}) {
    const Curve curve =
        follow(strut(theta_0), at(-2, (-2 - theta_0) / std::sin(-2.0), 1, 0), {lambda_reaches(8)});
    const auto limits = hits_of(curve, HitKind::limit_point);
    ASSERT_EQ(limits.size(), 1u) << "theta_0 = " << theta_0;
    EXPECT_NEAR(limits[0].point.x[0], t, 2e-12);
    EXPECT_NEAR(limits[0].point.lambda, lambda, 2e-12);
    EXPECT_EQ(curve.hits.size(), 2u);
  }
}

TEST(Pitchfork, HasItsBranchPointOnTheTrivialBranch) {
  const Curve curve = follow(pitchfork(), at(0, -0.9, 0, 1), {lambda_reaches(1)});
  const auto branches = hits_of(curve, HitKind::branch_point);
  ASSERT_EQ(branches.size(), 1u);
  EXPECT_NEAR(branches[0].point.lambda, 0, 1e-10);
  EXPECT_EQ(curve.hits.size(), 2u);
}

TEST(Transcritical, HasItsBranchPointOnBothBranches) {
  for (const double slope : {0.0, 1.0}) {
    const Curve curve =
        follow(transcritical(), at(-0.9 * slope, -0.9, slope, 1), {lambda_reaches(1)});
    ASSERT_EQ(curve.stop, StopReason::event);
    const auto branches = hits_of(curve, HitKind::branch_point);
    ASSERT_EQ(branches.size(), 1u) << "slope " << slope;
    EXPECT_NEAR(branches[0].point.lambda, 0, 1e-10);
    EXPECT_NEAR(branches[0].point.x[0], 0, 1e-10);
    EXPECT_EQ(curve.hits.size(), 2u);
    EXPECT_NEAR(curve.points.back().x[0], slope * curve.points.back().lambda, 1e-12)
        << "the trace must not change over to the other branch";
  }
}

StartPoint straight(double lambda) { return {Vector::Zero(2), lambda, {}, {Vector::Zero(2), 1}}; }

TEST(TwoModes, BuckleTogetherAtADoublePoint) {
  const Curve curve = follow(TwoModes{1, 1}, straight(0.1), {lambda_reaches(2)});
  ASSERT_EQ(curve.stop, StopReason::event);
  const auto branches = hits_of(curve, HitKind::branch_point);
  ASSERT_EQ(branches.size(), 1u);
  EXPECT_EQ(branches[0].multiplicity, 2);
  EXPECT_NEAR(branches[0].point.lambda, 1, 1e-10);
  EXPECT_EQ(curve.points.back().negative, Index{2});
}

TEST(TwoModes, BuckleOneByOneHoweverCloseTheyAre) {
  for (const double gap : {0.3, 0.01, 1e-3, 1e-4}) {
    const Curve curve = follow(TwoModes{1, 1 + gap}, straight(0.1), {lambda_reaches(2)});
    ASSERT_EQ(curve.stop, StopReason::event);
    const auto branches = hits_of(curve, HitKind::branch_point);
    ASSERT_EQ(branches.size(), 2u) << "gap " << gap;
    EXPECT_NEAR(branches[0].point.lambda, 1, 1e-10);
    EXPECT_NEAR(branches[1].point.lambda, 1 + gap, 1e-10);
    EXPECT_EQ(curve.hits.size(), 3u);
  }
}

TEST(TwoModes, HaveTheirSecondBranchPointOnTheBuckledBranch) {
  // x_1^2 = lambda - 1, x_2 = 0: the second eigenvalue is c_2 - lambda + x_1^2 = c_2 - 1 there.
  const TwoModes modes{1, 1.4};
  const StartPoint start{Vector{{-1, 0}}, 2, {}, {Vector{{1, 0}}, -1}};
  const Curve curve = follow(modes, start, {x_reaches(1)});
  ASSERT_EQ(curve.stop, StopReason::event);
  for (const CurvePoint& p : curve.points) {
    EXPECT_NEAR(p.lambda, 1 + p.x[0] * p.x[0], 1e-12);
    EXPECT_EQ(p.x[1], 0);
  }
}

TEST(Index, ChangesByOneAtEverySpecialPointOfTheLadder) {
  const ScalarProblem ladder = fold_ladder();
  const Curve curve = follow(ladder, at(-3, ladder.F(-3, 0), 1, 0), {x_reaches(3)});
  for (const CurvePoint& p : curve.points) {
    const Index expected = 1 + 6 * std::cos(3 * p.x[0]) < 0 ? 1 : 0;
    EXPECT_EQ(p.negative, expected) << "x = " << p.x[0];
  }
}

TEST(LimitPoints, AreNotLookedForWhereNotWanted) {
  TraceOptions options;
  options.limit_points = false;
  options.branch_points = false;
  const Curve curve =
      follow(cusp(1), at(-1.5, cusp(1).F(-1.5, 0), 1, 0), {x_reaches(1.5)}, options);
  EXPECT_EQ(curve.hits.size(), 1u);
}

}  // namespace
}  // namespace springfold::continuation
