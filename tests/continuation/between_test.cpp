// Points at even distances between the engine's own.
#include "springfold/continuation/between.hpp"

#include <gmock/gmock.h>

#include "springfold/continuation/davidenko.hpp"
#include "tracing.hpp"

namespace springfold::continuation {
namespace {

/// Counts how often it is asked.
struct Counted {
  ScalarProblem inner{};
  mutable int residuals = 0, derivatives_ = 0;

  static Index size() { return 1; }
  static bool symmetric() { return true; }
  bool residual(const Vector& x, double lambda, Vector& F) const {
    ++residuals;
    return inner.residual(x, lambda, F);
  }
  bool derivatives(const Vector& x, double lambda, Matrix& A, Vector& b) const {
    ++derivatives_;
    return inner.derivatives(x, lambda, A, b);
  }
};

/// The laws of a curve hold for the further points too, and these are where they should be.
void expect_even(ProblemView problem, const Curve& curve, const Between& between, double spacing,
                 std::size_t count) {
  EXPECT_EQ(between.missed, 0);
  EXPECT_EQ(between.points.size(), count);
  Curve further;
  further.points = between.points;
  expect_laws(problem, further);
  for (const CurvePoint& p : between.points) {
    EXPECT_NEAR(std::remainder(p.s, spacing), 0, 1e-9 * spacing);
    EXPECT_GT(p.s, curve.points.front().s);
  }
}

Curve ladder(const ScalarProblem& problem, double spacing) {
  return follow(problem, at(-2, -2 + 2 * std::sin(-6.0), 1, 0), {x_reaches(2)},
                steps_up_to(spacing));
}

TEST(PointsBetween, LieOnTheCurveAtMultiplesOfTheSpacing) {
  const ScalarProblem problem = fold_ladder();
  const Curve curve = ladder(problem, 0.05);
  const double end = curve.hits.back().point.s;
  const Between between = points_between(problem, curve, 0.003, {});
  expect_even(problem, curve, between, 0.003, static_cast<std::size_t>(end / 0.003));
}

TEST(PointsBetween, DoNotDependOnTheStepsOfTheEngine) {
  const ScalarProblem problem = circle();
  const StartPoint start = at(0, 1, 1, 0);
  // On a circle the arc length of a step is its chord along the tangent: other steps, other places.
  for (const double longest : {0.01, 0.1}) {
    const Curve curve = follow(problem, start, {x_reaches(0.9)}, steps_up_to(longest));
    const Between between = points_between(problem, curve, 0.001, {});
    ASSERT_GT(between.points.size(), 1000u);
    for (const CurvePoint& p : between.points) {
      EXPECT_NEAR(p.x[0] * p.x[0] + p.lambda * p.lambda, 1, 1e-12);
      EXPECT_NEAR(p.tangent.dx[0], p.lambda, 1e-7);
      EXPECT_NEAR(p.tangent.dlambda, -p.x[0], 1e-7);
    }
  }
}

TEST(PointsBetween, CostOneResidualEachWhereThereAreMany) {
  const Counted problem{.inner = circle()};
  const Curve curve = follow(problem, at(0, 1, 1, 0), {x_reaches(0.9)}, steps_up_to(0.1));
  problem.residuals = problem.derivatives_ = 0;
  const Between between = points_between(problem, curve, 1e-5, {});
  ASSERT_GT(between.points.size(), 100000u);
  EXPECT_LT(problem.residuals, 1.1 * static_cast<double>(between.points.size()));
  EXPECT_LT(problem.derivatives_, 0.03 * static_cast<double>(between.points.size()));
}

TEST(PointsBetween, CostNoCorrectionWhereTheStepsAroundShowTheCurve) {
  const Counted problem{.inner = circle()};
  const Curve curve = follow(problem, at(0, 1, 1, 0), {x_reaches(0.9)}, steps_up_to(0.02));
  problem.residuals = problem.derivatives_ = 0;
  const Between between = points_between(problem, curve, 0.006, {});
  ASSERT_GT(between.points.size(), 150u);
  EXPECT_EQ(between.missed, 0);
  // Those of the units and of the first and last steps, which have few around them.
  EXPECT_LT(problem.derivatives_, 0.3 * static_cast<double>(between.points.size()));
  for (const CurvePoint& p : between.points)
    EXPECT_NEAR(p.x[0] * p.x[0] + p.lambda * p.lambda, 1, 1e-12);
}

TEST(PointsBetween, AreThereWhenOnlyOneOrTwoFitIntoAStep) {
  const ScalarProblem problem = fold_ladder();
  const Curve curve = ladder(problem, 0.05);
  const double end = curve.hits.back().point.s;
  const Between between = points_between(problem, curve, 0.04, {});
  expect_even(problem, curve, between, 0.04, static_cast<std::size_t>(end / 0.04));
}

TEST(PointsBetween, KnowTheNumberOfNegativeEigenvalues) {
  const ScalarProblem problem = fold_ladder();
  const Between between = points_between(problem, ladder(problem, 0.05), 0.001, {});
  for (const CurvePoint& p : between.points)
    EXPECT_EQ(p.negative, 1 + 6 * std::cos(3 * p.x[0]) < 0 ? 1 : 0) << p.x[0];
}

TEST(PointsBetween, ChangeThePieceAtAKink) {
  const PiecewiseLine problem{.k0 = 1, .springs = {{2, 0.5, 1}}};
  const Curve curve = follow(problem, at(0, 0, 1, 0, problem.piece_at(0)), {x_reaches(1)});
  const Between between = points_between(problem, curve, 0.01, {});
  ASSERT_GT(between.points.size(), 100u);
  for (const CurvePoint& p : between.points) {
    EXPECT_EQ(p.piece, problem.piece_at(p.x[0]));
    EXPECT_NEAR(p.lambda, p.x[0] + 2 * std::max(0.0, p.x[0] - 0.5), 1e-12);
  }
}

TEST(PointsBetween, PassABranchPointOnTheirOwnBranch) {
  const ScalarProblem problem = pitchfork();
  const Curve curve = follow(problem, at(0, -0.53, 0, 1), {lambda_reaches(0.5)});
  ASSERT_EQ(hits_of(curve, HitKind::branch_point).size(), 1u);
  const Between between = points_between(problem, curve, 0.001, {});
  EXPECT_GT(between.points.size() + static_cast<std::size_t>(between.missed), 1000u);
  EXPECT_LE(between.missed, 2);
  for (const CurvePoint& p : between.points) {
    EXPECT_NEAR(p.x[0], 0, 1e-12);
    if (std::abs(p.lambda) > 1e-6) {
      EXPECT_EQ(p.negative, p.lambda < 0 ? 1 : 0);
    }
  }
}

TEST(PointsBetween, GoAllTheWayRoundAClosedCurve) {
  const ScalarProblem problem = circle();
  const Curve curve = follow(problem, at(0, 1, 1, 0), {});
  ASSERT_EQ(curve.stop, StopReason::closed);
  const double end = curve.points.back().s;
  const Between between = points_between(problem, curve, 0.0071, {});
  expect_even(problem, curve, between, 0.0071, static_cast<std::size_t>(end / 0.0071));
}

TEST(PointsBetween, FollowThePathOfTheFlowAsWell) {
  const ScalarProblem problem = fold_ladder();
  const StartPoint start = at(-2, -2 + 2 * std::sin(-6.0), 1, 0);
  const Curve curve =
      davidenko(problem, start.x, start.lambda, ray_of(problem, start, {}), {x_reaches(2)}, {});
  const Between between = points_between(problem, curve, 0.003, {});
  EXPECT_GT(between.points.size(), 3000u);
  for (const CurvePoint& p : between.points)
    EXPECT_NEAR(p.lambda, p.x[0] + 2 * std::sin(3 * p.x[0]), 1e-11);
}

}  // namespace
}  // namespace springfold::continuation
