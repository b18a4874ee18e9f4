#include "continuation/points/step.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tracing.hpp"

namespace springfold::continuation {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

Walker walker_for(ProblemView problem, const TraceOptions& options = {}) {
  return {problem, problem.metric(), options};
}

CurvePoint at_angle(double angle) {
  CurvePoint p;
  p.x = Vector::Constant(1, std::cos(angle));
  p.lambda = std::sin(angle);
  p.tangent = {Vector::Constant(1, -std::sin(angle)), std::cos(angle)};
  return p;
}

TEST(Step, LandsOnTheCurveAtTheAskedDistance) {
  const ScalarProblem problem = circle();
  const Walker walker = walker_for(problem);
  for (const double ds : {1e-8, 1e-3, 0.1}) {
    CurvePoint from = at_angle(0.4);
    from.s = 2;
    const StepResult step = try_step(walker, from, ds);
    ASSERT_TRUE(step.point.has_value()) << step.refusal;
    const double there = 0.4 + std::asin(ds);
    EXPECT_NEAR(step.point->x[0], std::cos(there), 1e-14);
    EXPECT_NEAR(step.point->lambda, std::sin(there), 1e-14);
    EXPECT_NEAR(step.point->tangent.dx[0], -std::sin(there), 1e-14);
    EXPECT_NEAR(step.point->tangent.dlambda, std::cos(there), 1e-14);
    EXPECT_EQ(step.point->s, 2 + ds);
    EXPECT_NEAR(step.measures.turn, std::asin(ds), 1e-12 + 1e-8 * ds);
    EXPECT_THAT(step.refusal, IsEmpty());
  }
}

TEST(Step, PredictsWithAnErrorOfSecondOrder) {
  // deviation = (distance from predicted to corrected point) / ds, so it must fall like ds.
  const ScalarProblem curve = strut(0.1);
  const Walker walker = walker_for(curve);
  StartPoint start = at(0.6, 0.5 / std::sin(0.6), 1, 1);
  CurvePoint from{.x = start.x, .lambda = start.lambda};
  from.tangent = ray_of(curve, start, {}).tangent;
  for (double ds = 0.02; ds > 0.001; ds /= 2) {
    const double coarse = try_step(walker, from, ds).measures.deviation * ds;
    const double fine = try_step(walker, from, ds / 2).measures.deviation * ds / 2;
    EXPECT_NEAR(coarse / fine, 4, 0.4) << "ds = " << ds;
  }
}

TEST(Step, CountsNegativeEigenvaluesWhereTheyAreDefined) {
  const ScalarProblem problem = circle();
  const Walker walker = walker_for(problem);
  EXPECT_EQ(try_step(walker, at_angle(1.0), 0.01).point->negative, Index{0});
  EXPECT_EQ(try_step(walker, at_angle(2.0), 0.01).point->negative, Index{1});
}

TEST(Step, IsRefusedInWordsByEachMeasureOfNonlinearity) {
  const ScalarProblem problem = circle();
  const auto refusal_with = [&problem](const StepOptions& limits) {
    TraceOptions options;
    options.step = limits;
    const StepResult step = try_step(walker_for(problem, options), at_angle(0.4), 0.5);
    EXPECT_FALSE(step.point.has_value());
    return step.refusal;
  };
  EXPECT_THAT(refusal_with({.contraction = 9, .turn = 0.3, .deviation = 9}),
              HasSubstr("tangent turned by 30 deg"));
  EXPECT_THAT(refusal_with({.contraction = 9, .turn = 9, .deviation = 0.1}),
              HasSubstr("steps from the predicted one"));
  EXPECT_THAT(refusal_with({.contraction = 1e-3, .turn = 9, .deviation = 9}),
              HasSubstr("corrector contraction"));
}

TEST(Step, IsRefusedInWordsWhenTheCorrectorFails) {
  ScalarProblem problem = circle();
  problem.inside = [](double x, double) { return x > 0.9; };
  EXPECT_EQ(try_step(walker_for(problem), at_angle(0.4), 0.3).refusal,
            to_string(NewtonStatus::outside_domain));
}

TEST(Step, ThatWasRefusedLeavesItsInputAsItWas) {
  const ScalarProblem problem = circle();
  const CurvePoint from = at_angle(0.4);
  const CurvePoint copy = from;
  EXPECT_FALSE(try_step(walker_for(problem), from, 0.9).point.has_value());
  EXPECT_EQ(from.x, copy.x);
  EXPECT_EQ(from.lambda, copy.lambda);
  EXPECT_EQ(from.tangent.dx, copy.tangent.dx);
}

TEST(NextStepLength, GrowsByTheLargestFactorOnAStraightCurve) {
  const StepOptions options{.initial = 0.01, .minimum = 1e-8, .maximum = 1, .growth = 1.6};
  EXPECT_DOUBLE_EQ(next_step_length(0.1, {}, options), 0.16);
}

TEST(NextStepLength, AimsBelowTheLimitsOfTheMeasures) {
  const StepOptions options{.maximum = 1, .turn = 0.2, .aim = 0.5, .growth = 3};
  // Turn grows like ds: half the limit now, so the same length again.
  EXPECT_DOUBLE_EQ(next_step_length(0.1, {.turn = 0.1}, options), 0.1);
  EXPECT_DOUBLE_EQ(next_step_length(0.1, {.turn = 0.2}, options), 0.05);
  // The contraction grows like ds^2.
  EXPECT_DOUBLE_EQ(next_step_length(0.1, {.contraction = 0.25}, {.maximum = 1, .aim = 0.25}), 0.05);
}

TEST(NextStepLength, StaysBetweenMinimumAndMaximum) {
  const StepOptions options{.initial = 0.01, .minimum = 0.005, .maximum = 0.02};
  EXPECT_EQ(next_step_length(0.019, {}, options), 0.02);
  EXPECT_EQ(next_step_length(0.006, {.turn = 1.5}, options), 0.005);
}

TEST(TraceOptions, SayEveryRuleTheyBreak) {
  EXPECT_THAT(problems_in(TraceOptions{}), IsEmpty());
  TraceOptions options;
  options.step = {.initial = 1, .minimum = 0, .maximum = 0.5, .turn = -1, .growth = 1};
  options.newton = {.residual_tolerance = 0, .maximum_iterations = 0};
  options.maximum_points = 1;
  EXPECT_THAT(
      problems_in(options),
      testing::ElementsAre(HasSubstr("step: need 0 < minimum"), HasSubstr("must be positive"),
                           HasSubstr("step.growth"), HasSubstr("residual_tolerance"),
                           HasSubstr("maximum_iterations"), HasSubstr("maximum_points")));
}

}  // namespace
}  // namespace springfold::continuation
