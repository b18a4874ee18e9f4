// The tools that special points are found with, one by one.
#include "continuation/points/locate.hpp"

#include <gtest/gtest.h>

#include "continuation/locating/branch_point.hpp"
#include "continuation/locating/evidence.hpp"
#include "tracing.hpp"

namespace springfold::continuation {
namespace {

const ScalarProblem round_curve = circle();
const Walker on_round{round_curve, Vector::Ones(1), {}};

CurvePoint on_circle(double angle) {
  CurvePoint p;
  p.s = 3;
  p.x = Vector::Constant(1, std::cos(angle));
  p.lambda = std::sin(angle);
  p.tangent = {Vector::Constant(1, -std::sin(angle)), std::cos(angle)};
  return p;
}

TEST(PointAt, IsOnTheCurveAtTheAskedDistanceAlongTheTangent) {
  const CurvePoint from = on_circle(0.2);
  for (const double ds : {0.0, 1e-9, 0.05, 0.4}) {
    const auto p = point_at(on_round, from, ds);
    ASSERT_TRUE(p.has_value());
    EXPECT_NEAR(p->x[0], std::cos(0.2 + std::asin(ds)), 1e-14);
    EXPECT_NEAR(p->lambda, std::sin(0.2 + std::asin(ds)), 1e-14);
    EXPECT_EQ(p->s, 3 + ds);
  }
}

TEST(PointAt, DoesNotExistWhereTheCurveDoesNotReach) {
  EXPECT_FALSE(point_at(on_round, on_circle(0.2), 1.5).has_value());
}

TEST(Locate, FindsTheZeroOfAnyQuantityAndProvesItByABracket) {
  const auto value = [](const CurvePoint& p) { return std::exp(p.x[0]) - std::exp(0.8); };
  const auto found = locate(on_round, on_circle(0.5), 0, 0.3, value);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(found->point.x[0], 0.8, 1e-13);
  EXPECT_LE(found->before, found->point.s - 3);
  EXPECT_GE(found->after, found->point.s - 3);
  EXPECT_LT(found->after - found->before, 1e-13);
}

TEST(Locate, TakesAZeroAtTheEndOfItsInterval) {
  const auto value = [](const CurvePoint& p) { return p.s - 3.25; };
  const auto found = locate(on_round, on_circle(0.5), 0, 0.25, value);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->point.s, 3.25);
}

TEST(Locate, NeedsAChangeOfSignAndFiniteValues) {
  const CurvePoint from = on_circle(0.5);
  EXPECT_FALSE(locate(on_round, from, 0, 0.3, [](const CurvePoint&) { return 1.0; }).has_value());
  const auto undefined = [](const CurvePoint& p) { return p.s > 3.1 ? std::sqrt(-1.0) : -1.0; };
  EXPECT_FALSE(locate(on_round, from, 0, 0.3, undefined).has_value());
}

TEST(BranchPoint, IsRefinedToFullPrecisionFromRoughPlaces) {
  // Buckling of the second mode on the way of the first: everywhere regular but at the point.
  const TwoModes modes{1, 1.4};
  const Walker walker{modes, Vector::Ones(2), {}};
  for (const double error : {1e-4, 1e-7, 0.0}) {
    CurvePoint near;
    near.x = Vector{{error, -error}};
    near.lambda = 1 + error;
    near.tangent = {Vector::Zero(2), 1};
    const auto refined = refine_branch_point(walker, near);
    ASSERT_TRUE(refined.has_value()) << "error " << error;
    EXPECT_NEAR(refined->lambda, 1, 1e-12);
    EXPECT_LT(refined->x.norm(), 1e-12);
  }
}

TEST(BranchPoint, IsNotInventedWhereBranchesOnlyComeClose) {
  ScalarProblem apart = transcritical();
  apart.F = [](double x, double l) { return x * (l - x) + 1e-6; };
  const Walker walker{apart, Vector::Ones(1), {}};
  CurvePoint near;
  near.x = Vector::Constant(1, 1e-3);
  near.lambda = 0;
  near.tangent = {Vector::Constant(1, 0.5), 1};
  EXPECT_FALSE(refine_branch_point(walker, near).has_value());
}

TEST(BranchPoint, OfTwoModesAtOnceIsLocatedOnTheCurveWithItsCorank) {
  const TwoModes modes{1, 1};
  const Curve curve =
      follow(modes, {Vector::Zero(2), 0.2, {}, {Vector::Zero(2), 1}}, {lambda_reaches(2)});
  const auto hits = hits_of(curve, HitKind::branch_point);
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_EQ(hits[0].multiplicity, 2);
  EXPECT_NEAR(hits[0].point.lambda, 1, 1e-12);
}

TEST(BranchPoint, IsFoundInProblemsThatAreNotSymmetric) {
  // x (l - x) = 0 and y - x^2 = 0, rows mixed.
  struct Mixed {
    static Index size() { return 2; }
    static bool residual(const Vector& z, double l, Vector& F) {
      const double f = z[0] * (l - z[0]), g = z[1] - z[0] * z[0];
      F = Vector{{f + 2 * g, 3 * f - g}};
      return true;
    }
    static bool derivatives(const Vector& z, double l, Matrix& dF_dx, Vector& dF_dlambda) {
      const double f_x = l - 2 * z[0], g_x = -2 * z[0];
      dF_dx = Matrix{{f_x + 2 * g_x, 2}, {3 * f_x - g_x, -1}};
      dF_dlambda = Vector{{z[0], 3 * z[0]}};
      return true;
    }
  };
  for (const double x : {0.0, -0.7}) {  // along x = 0, and along x = l
    const Curve curve = follow(Mixed{}, {Vector{{x, x * x}}, -0.7, {}, {Vector::Zero(2), 1}},
                               {lambda_reaches(0.9)});
    ASSERT_EQ(curve.hits.size(), 2u) << x;
    EXPECT_EQ(curve.hits[0].kind, HitKind::branch_point);
    EXPECT_EQ(curve.hits[0].multiplicity, 1);
    EXPECT_NEAR(curve.hits[0].point.lambda, 0, 1e-10);
    EXPECT_LT(curve.hits[0].point.x.norm(), 1e-10);
  }
}

TEST(Spectrum, IsThatOfTheMatrixAtThePoint) {
  const TwoModes modes{1, 1.4};
  const Walker walker{modes, Vector::Ones(2), {}};
  CurvePoint p;
  p.x = Vector::Zero(2);
  p.lambda = 1.4;
  EXPECT_EQ(spectrum_at(walker, p)->size(), 2);
  EXPECT_NEAR((*spectrum_at(walker, p))[0], -0.4, 1e-15);
}

TEST(Evidence, SpeaksForAnOrdinaryStep) {
  const CurvePoint from = on_circle(0.5);
  const StepResult step = try_step(on_round, from, 0.1);
  ASSERT_TRUE(step.point.has_value());
  const Evidence evidence = examine(on_round, from, *step.point);
  EXPECT_TRUE(evidence.doubt.empty()) << evidence.doubt;
  ASSERT_TRUE(evidence.middle.has_value());
  EXPECT_NEAR(evidence.middle->s, 3.05, 1e-15);
  EXPECT_NEAR(evidence.middle->x[0], std::cos(0.5 + std::asin(0.05)), 1e-14);
}

TEST(Evidence, SpeaksAgainstAJumpToTheNeighbour) {
  // The two branches of x (lambda - x) + gap = 0 come close at lambda = 0; a step across lands on
  // the straight continuation, which belongs to the other one.
  constexpr double gap = -1e-5;
  ScalarProblem apart = transcritical();
  apart.F = [](double x, double l) { return x * (l - x) + gap; };
  const Walker walker{apart, Vector::Ones(1), {}};
  CurvePoint from, to;
  for (CurvePoint* p : {&from, &to}) {
    p->lambda = p == &from ? -0.1 : 0.1;
    p->x =
        Vector::Constant(1, p->lambda / 2 * (1 - std::sqrt(1 + 4 * gap / (p->lambda * p->lambda))));
    const double slope = -p->x[0] / (p->lambda - 2 * p->x[0]);
    p->tangent = {Vector::Constant(1, slope / std::hypot(slope, 1)), 1 / std::hypot(slope, 1)};
  }
  to.s = 0.2;
  EXPECT_FALSE(examine(walker, from, to).doubt.empty());
}

}  // namespace
}  // namespace springfold::continuation
