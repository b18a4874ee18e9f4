// Ends of critical curves at the start, jumps of families beside them, and events that stand still, against closed
// forms.
#include <gtest/gtest.h>

#include <cmath>

#include "parameters/families.hpp"

namespace springfold::continuation {
namespace {

/// lambda = mu x - x^3, with a limit point at mu = 3 x^2, lambda = 2 x^3.
Family cubic() {
  return graphs([](double x, double mu) { return mu * x - x * x * x; },
                [](double x, double mu) { return mu - 3 * x * x; });
}
CriticalStart fold_of_cubic(double x) {
  return start_at(CriticalKind::limit_point, single(x), 2 * x * x * x, 3 * x * x);
}

TEST(CriticalRanges, AJumpOfTheFamilyIsNotSeenByTheCurveBeforeIt) {
  const Family family =
      graphs([](double x, double mu) { return mu * x - x * x * x + (mu < 0.5 ? 1 + 3 * x : 0); },
             [](double x, double mu) { return mu - 3 * x * x + (mu < 0.5 ? 3 : 0); });
  const auto curve = follow_critical(family, fold_of_cubic(std::sqrt(0.3)), false,
                                     {stop_at(0.5 + 0x1p-10, 2)}, {});
  EXPECT_EQ(curve.stop_detail, "end");
  ASSERT_FALSE(curve.hits.empty());
  EXPECT_NEAR(curve.hits.back().point.mu, 0.5 + 0x1p-10, 1e-12);
  for (const auto& p : curve.points)
    EXPECT_NEAR(p.lambda, 2 * std::pow(p.mu / 3, 1.5), 1e-11) << p.mu;
}

CriticalEvent lower_end(double low) {
  return {"lower end", [=](const CriticalPoint& p) { return p.mu - low; }, EventAction::stop, true,
          1};
}

TEST(CriticalRanges, ACurveThatStartsAtTheEndOfItsRangeIsFollowedInwardsOnly) {
  const double low = 0.75;
  const auto out = follow_critical(cubic(), fold_of_cubic(0.5), false, {lower_end(low)}, {});
  EXPECT_EQ(out.points.size(), 1U);
  EXPECT_EQ(out.stop, StopReason::event);
  EXPECT_EQ(out.stop_detail, "lower end");
  const auto in =
      follow_critical(cubic(), fold_of_cubic(0.5), true, {lower_end(low), stop_at(0, 3)}, {});
  EXPECT_EQ(in.stop_detail, "end");
  EXPECT_NEAR(in.hits.back().point.lambda, 2, 1e-10);
}

TEST(CriticalRanges, AtATurnOnTheEndOfItsRangeACurveIsFollowedInwardsBothWays) {
  std::vector<double> ends;
  for (const bool growing : {true, false}) {
    const auto curve =
        follow_critical(cubic(), fold_of_cubic(0), growing, {lower_end(0), stop_at(-1, 3)}, {});
    EXPECT_EQ(curve.stop_detail, "end");
    ASSERT_FALSE(curve.hits.empty());
    ends.push_back(curve.hits.back().point.lambda);
  }
  EXPECT_NEAR(ends[0] * ends[1], -4, 1e-9);
}

TEST(CriticalRanges, WhatDefinesACurveIsNoEventOnIt) {
  // Zero along lambda = mu x - x^3 is x = 1: lambda = mu - 1.
  CriticalStart start = start_at(CriticalKind::zero, single(1), 1, 2);
  start.value = [](const Vector& x, double, double) { return x[0] - 1; };
  const CriticalEvent mark{"mark", [](const CriticalPoint& p) { return p.x[0] - 1; }};
  const auto curve = follow_critical(cubic(), start, true, {stop_at(0, 5), mark}, {});
  EXPECT_EQ(curve.stop_detail, "end");
  ASSERT_EQ(curve.hits.size(), 1U);
  EXPECT_NEAR(curve.hits[0].point.lambda, 4, 1e-11);
}

TEST(CriticalRanges, AMarkThatIsPassedIsStillLocatedWhereTheCurveBeginsOnIt) {
  // On mu = 3 x^2 the mark (x - 0.5)(x - 1) is zero at the start and at mu = 3.
  const CriticalEvent mark{"mark",
                           [](const CriticalPoint& p) { return (p.x[0] - 0.5) * (p.x[0] - 1); }};
  const auto curve = follow_critical(cubic(), fold_of_cubic(0.5), true, {stop_at(0, 5), mark}, {});
  ASSERT_EQ(curve.hits.size(), 2U);
  EXPECT_EQ(curve.hits[0].name, "mark");
  EXPECT_NEAR(curve.hits[0].point.mu, 3, 1e-10);
}

}  // namespace
}  // namespace springfold::continuation
