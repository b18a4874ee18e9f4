#include "springfold/continuation/newton.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "problems.hpp"

namespace springfold::continuation {
namespace {

const Vector unit_weight = Vector::Ones(1);

Vector scalar(double value) { return Vector::Constant(1, value); }

Linearisation linear_at(ProblemView problem, double x, double lambda) {
  Linearisation at;
  EXPECT_TRUE(linearise(problem, scalar(x), lambda, {}, at));
  return at;
}

TEST(Metric, WeighsTheUnknownsAndCountsLambdaOnce) {
  const Direction a{Vector{{1, 2, 3}}, 4}, b{Vector{{5, 6, 7}}, 8};
  EXPECT_EQ(metric_product(Vector{{1, 0, 0.5}}, a, b), 5 + 0.5 * 21 + 32);
}

TEST(Metric, GivesDirectionsThatItMeasuresTheLengthOne) {
  const Vector weights{{1, 0}};
  Direction d{Vector{{3, 7}}, 4};
  EXPECT_TRUE(set_length_one(weights, d));
  EXPECT_DOUBLE_EQ(metric_product(weights, d, d), 1);
  EXPECT_DOUBLE_EQ(d.dx[1], 1.4);
}

TEST(Metric, LeavesDirectionsThatItDoesNotMeasureAsTheyAre) {
  const Vector weights{{1, 0}};
  Direction d{Vector{{0, 7}}, 0};
  EXPECT_FALSE(set_length_one(weights, d));
  EXPECT_EQ(d.dx[1], 7);
  d = {Vector{{3, 0}}, 4};
  EXPECT_FALSE(set_length_one(weights, d, 5));
  EXPECT_EQ(d.dlambda, 4);
}

TEST(Bordered, SolvesTheSystemThatItDraws) {
  std::mt19937 random(101);
  std::normal_distribution<double> normal;
  const auto number = [&](auto) { return normal(random); };
  for (int trial = 0; trial < 100; ++trial) {
    const Index n = trial % 6;
    const Linearisation at{Matrix::Zero(n, n).unaryExpr(number), Vector::Zero(n).unaryExpr(number)};
    const Vector weights = Vector::Zero(n).unaryExpr(number).cwiseAbs();
    const Direction border{Vector::Zero(n).unaryExpr(number), normal(random)};
    const Vector r = Vector::Zero(n).unaryExpr(number);
    const auto solution = solve_bordered(at, weights, border, r, 0.7);
    ASSERT_TRUE(solution.has_value());
    const Vector off = at.dF_dx * solution->dx + at.dF_dlambda * solution->dlambda - r;
    const double size = 1 + solution->dx.norm() + std::abs(solution->dlambda);
    EXPECT_LT(off.norm(), 1e-12 * size);
    EXPECT_NEAR(metric_product(weights, border, *solution), 0.7, 1e-12 * size);
  }
}

TEST(Bordered, IsRegularAtALimitPointAndSingularAtABranchPoint) {
  const Direction along{scalar(1), 0};
  EXPECT_TRUE(
      solve_bordered(linear_at(circle(), 0, 1), unit_weight, along, scalar(0), 1).has_value());
  EXPECT_FALSE(
      solve_bordered(linear_at(pitchfork(), 0, 0), unit_weight, along, scalar(0), 1).has_value());
}

TEST(Tangent, IsAUnitVectorAlongTheCurveOrientedByTheReference) {
  for (double angle = 0.1; angle < 6; angle += 0.3) {
    const double x = std::cos(angle), lambda = std::sin(angle);
    for (const double way : {1.0, -1.0}) {
      const Direction reference{scalar(-way * lambda + 0.2), way * x};
      const auto tangent = tangent_at(linear_at(circle(), x, lambda), unit_weight, reference);
      ASSERT_TRUE(tangent.has_value());
      EXPECT_NEAR(tangent->dx[0], -way * lambda, 1e-15) << "angle " << angle;
      EXPECT_NEAR(tangent->dlambda, way * x, 1e-15) << "angle " << angle;
    }
  }
}

TEST(Tangent, HasUnitLengthInTheMetric) {
  const Vector weights = scalar(100);
  const auto tangent = tangent_at(linear_at(circle(), 0.6, 0.8), weights, {scalar(-1), 0});
  ASSERT_TRUE(tangent.has_value());
  EXPECT_NEAR(metric_product(weights, *tangent, *tangent), 1, 1e-15);
  EXPECT_NEAR(0.6 * tangent->dx[0] + 0.8 * tangent->dlambda, 0, 1e-15);
}

TEST(Tangent, DoesNotExistWhereBranchesCross) {
  EXPECT_FALSE(
      tangent_at(linear_at(transcritical(), 0, 0), unit_weight, {scalar(1), 1}).has_value());
}

NewtonResult back_to_the_circle(double angle, double ds, const NewtonOptions& options = {}) {
  const Direction tangent{scalar(-std::sin(angle)), std::cos(angle)};
  return correct(circle(), unit_weight, scalar(std::cos(angle) + ds * tangent.dx[0]),
                 std::sin(angle) + ds * tangent.dlambda, {}, tangent, options);
}

TEST(Corrector, ConvergesToTheCurveInTheHyperplaneOfTheBorder) {
  for (double angle = 0; angle < 6; angle += 0.37)
    for (const double ds : {1e-6, 0.01, 0.3}) {
      const NewtonResult result = back_to_the_circle(angle, ds);
      ASSERT_TRUE(converged(result));
      // The circle's point at the distance ds along the tangent.
      const double there = angle + std::asin(ds);
      EXPECT_NEAR(result.x[0], std::cos(there), 1e-15);
      EXPECT_NEAR(result.lambda, std::sin(there), 1e-15);
      EXPECT_LE(result.residual_norm, 1e-12);
      EXPECT_EQ(static_cast<int>(result.corrections.size()), result.iterations);
    }
}

TEST(Corrector, IsQuadraticOnAStepThatIsTooLong) {
  // Order p from corrections c: c_{k+1} ~ c_k^p. A wrong second-order term would give p = 1.
  const auto expect_quadratic = [](const NewtonResult& result, const std::string& what) {
    ASSERT_TRUE(converged(result)) << what;
    int seen = 0;
    for (std::size_t k = 1; k + 1 < result.corrections.size(); ++k) {
      if (result.corrections[k + 1] < 1e-14 || result.corrections[k] > 0.05) continue;
      const double order = std::log(result.corrections[k + 1] / result.corrections[k]) /
                           std::log(result.corrections[k] / result.corrections[k - 1]);
      EXPECT_GT(order, 1.8) << what << ", correction " << k;
      ++seen;
    }
    EXPECT_GE(seen, 1) << what << ": the step was not long enough to see the order";
  };
  expect_quadratic(back_to_the_circle(0.3, 0.8), "circle");
  expect_quadratic(correct(strut(0.1), unit_weight, scalar(1.2), 1.6, {}, {scalar(1), 0.2}, {}),
                   "strut");
  expect_quadratic(correct(fold_ladder(), unit_weight, scalar(0.7), 1.0, {}, {scalar(0.3), -1}, {}),
                   "ladder");
  const Vector two_weights = Vector::Ones(2);
  expect_quadratic(correct(TwoModes{1, 1.4}, two_weights, Vector{{0.6, 0.3}}, 1.5, {},
                           {Vector{{1, 0}}, 0.2}, {}),
                   "two modes");
}

TEST(Corrector, AcceptsAPointOfTheCurveAsItIs) {
  const NewtonResult result =
      correct(circle(), unit_weight, scalar(0.6), 0.8, {}, {scalar(-0.8), 0.6}, {});
  ASSERT_TRUE(converged(result));
  EXPECT_NEAR(result.x[0], 0.6, 1e-15);
  EXPECT_NEAR(result.lambda, 0.8, 1e-15);
  EXPECT_LE(result.iterations, 2);
}

TEST(Corrector, NeedsNoSecondIterationWhereTheResidualIsExactlyZero) {
  const ScalarProblem line = graph([](double x) { return 2 * x; }, [](double) { return 2; });
  const NewtonResult result = correct(line, unit_weight, scalar(0.25), 0.5, {}, {scalar(1), 2}, {});
  ASSERT_TRUE(converged(result));
  EXPECT_LE(result.iterations, 1);
}

TEST(Corrector, SaysWhenItNeedsTooManyIterations) {
  const NewtonResult result = back_to_the_circle(0.3, 0.9, {.maximum_iterations = 2});
  EXPECT_EQ(result.status, NewtonStatus::too_many_iterations);
  EXPECT_EQ(result.iterations, 2);
}

TEST(Corrector, SaysWhenItDiverges) {
  // The line lambda = 2 does not meet the circle.
  const NewtonResult result = correct(circle(), unit_weight, scalar(0.3), 2, {}, {scalar(0), 1},
                                      {.maximum_iterations = 50});
  EXPECT_EQ(result.status, NewtonStatus::diverges);
  EXPECT_GT(result.contraction, 1);
}

TEST(Corrector, SaysWhenItsMatrixIsSingular) {
  const NewtonResult result = correct(circle(), unit_weight, scalar(0), 2, {}, {scalar(0), 1}, {});
  EXPECT_EQ(result.status, NewtonStatus::singular);
}

TEST(Corrector, SaysWhenItLeavesTheDomain) {
  ScalarProblem half = circle();
  half.inside = [](double x, double) { return x > 0; };
  const auto correct_from = [&half](double x) {
    return correct(half, unit_weight, scalar(x), 0.99, {}, {scalar(0), 1}, {});
  };
  EXPECT_EQ(correct_from(-0.1).status, NewtonStatus::outside_domain);
  EXPECT_EQ(correct_from(0.2).status, NewtonStatus::converged);
  half.F = [](double, double) { return std::numeric_limits<double>::quiet_NaN(); };
  EXPECT_EQ(correct_from(0.5).status, NewtonStatus::outside_domain);
}

TEST(Corrector, HasWordsForEveryStatus) {
  for (const NewtonStatus status :
       {NewtonStatus::converged, NewtonStatus::too_many_iterations, NewtonStatus::diverges,
        NewtonStatus::singular, NewtonStatus::outside_domain})
    EXPECT_NE(to_string(status), "unknown");
}

TEST(Linearise, RefusesNumbersThatAreNotFinite) {
  ScalarProblem problem = circle();
  problem.F_x = [](double, double) { return std::numeric_limits<double>::infinity(); };
  Linearisation at;
  EXPECT_FALSE(linearise(problem, scalar(1), 0, {}, at));
}

}  // namespace
}  // namespace springfold::continuation
