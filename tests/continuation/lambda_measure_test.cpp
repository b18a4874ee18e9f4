// lambda measured in parts of itself: what happens at lambdas of very different size is found on one curve.
#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "continuation/points/growing_units.hpp"
#include "springfold/continuation/trace.hpp"
#include "tracing.hpp"

namespace springfold::continuation {
namespace {

/// (K - lambda) x + |x|^2 x = 0: x = 0 loses stability at every eigenvalue of K.
struct Soft {
  Matrix K{};
  LambdaMeasure measure{};
  Index size() const { return K.rows(); }
  bool symmetric() const { return true; }
  LambdaMeasure lambda_measure() const { return measure; }
  bool residual(const Vector& x, double lambda, Vector& F) const {
    F = K * x - lambda * x + x.squaredNorm() * x;
    return true;
  }
  bool derivatives(const Vector& x, double lambda, Matrix& J, Vector& dF) const {
    J = K + (x.squaredNorm() - lambda) * Matrix::Identity(size(), size()) + 2 * x * x.transpose();
    dF = -x;
    return true;
  }
};

/// A bar that is turned by a spring k while its end is pressed: a force f is its unknown of weight zero.
///
///     k sin q + lambda f - f q = 0,   q - e (1 + f^2) = lambda / 8
struct WithForce {
  double k = 1, e = 1e-3;
  Index size() const { return 2; }
  bool symmetric() const { return true; }  // not that of J: what is stiff counts by its energy then
  LambdaMeasure lambda_measure() const { return {0.25, 1e-3}; }
  Vector metric() const { return Vector{{1, 0}}; }
  Index switch_count() const { return 1; }
  bool residual(const Vector& x, double lambda, const Piece&, Vector& F) const {
    F = Vector{{k * std::sin(x[0]) + lambda * x[1] - x[1] * x[0],
                x[0] - e * (1 + x[1] * x[1]) - lambda / 8}};
    return true;
  }
  bool derivatives(const Vector& x, double lambda, const Piece&, Matrix& J, Vector& dF) const {
    J = Matrix{{k * std::cos(x[0]) - x[1], lambda - x[0]}, {1, -2 * e * x[1]}};
    dF = Vector{{x[1], -0.125}};
    return true;
  }
  bool switches(const Vector& x, double lambda, Vector& g) const {
    g = Vector{{x[0] + x[1] * x[1] - lambda}};
    return true;
  }
  bool switch_gradients(const Vector& x, double, Matrix& dg, Vector& dl) const {
    dg = Matrix{{1, 2 * x[1]}};
    dl = Vector{{-1}};
    return true;
  }
};

Curve along_lambda(const Soft& problem, double until) {
  const Index n = problem.size();
  const Ray ray{.tangent = {Vector::Zero(n), 1}};
  const Event end{.name = "end",
                  .value = [until](const CurvePoint& p) { return p.lambda - until; },
                  .action = EventAction::stop};
  return trace(problem, Vector::Zero(n), 0, ray, {end}, {});
}

/// @param loads  at which the straight state is critical, in order
void expect_critical_loads(const std::vector<double>& loads, std::size_t most_points) {
  const Soft problem{.K = Eigen::Map<const Vector>(loads.data(), std::ssize(loads)).asDiagonal(),
                     .measure = {0, 1}};
  const Curve curve = along_lambda(problem, 2.5 * loads.back());
  EXPECT_EQ(curve.stop, StopReason::event);
  std::vector<double> found;
  for (const Hit& hit : curve.hits) {
    if (hit.kind == HitKind::user) continue;
    EXPECT_EQ(hit.kind, HitKind::branch_point);
    found.push_back(hit.point.lambda);
  }
  ASSERT_EQ(found.size(), loads.size());
  for (std::size_t i = 0; i < loads.size(); ++i) EXPECT_NEAR(found[i] / loads[i], 1, 1e-10);
  EXPECT_LT(curve.points.size(), most_points);
}

TEST(LambdaMeasure, ShowsCriticalLoadsOverTwelveOrdersOfMagnitudeOnOneCurve) {
  expect_critical_loads({0.1, 30, 2e6, 7.5e10}, 700);
}

// The stiffest entry is beyond the rounding of the softest one a hundred million times.
TEST(LambdaMeasure, ShowsCriticalLoadsOverTwentyFiveOrdersOfMagnitudeOnOneCurve) {
  expect_critical_loads({0.3, 2e6, 7.5e10, 4e17, 3e24}, 1500);
}

TEST(LambdaMeasure, LeavesPlacesAsTheyAreOutside) {
  const Soft problem{.K = Matrix{{0.5, 0}, {0, 3}}, .measure = {0, 1e-3}};
  const Soft plain{.K = problem.K};
  const Curve measured = along_lambda(problem, 2), as_it_is = along_lambda(plain, 2);
  ASSERT_EQ(measured.hits.size(), as_it_is.hits.size());
  for (std::size_t i = 0; i < measured.hits.size(); ++i) {
    EXPECT_EQ(measured.hits[i].kind, as_it_is.hits[i].kind);
    EXPECT_NEAR(measured.hits[i].point.lambda, as_it_is.hits[i].point.lambda, 1e-12);
  }
}

/// Six-point differences of a function of one variable.
template <class Function>
Vector difference(const Function& f, double h) {
  return (45 * (f(h) - f(-h)) - 9 * (f(2 * h) - f(-2 * h)) + (f(3 * h) - f(-3 * h))) / (60 * h);
}

/// Of a spring that counts as it is, and of one that counts by its energy.
class GrowingUnitsOf : public testing::TestWithParam<double> {
 protected:
  GrowingUnitsOf() {
    growing.count_by_energy({.x = Vector::Zero(2), .lambda = 0.25, .piece = {1}}, Vector::Ones(2),
                            {});
  }
  const WithForce problem{.k = GetParam()};
  GrowingUnits growing{problem};
};
INSTANTIATE_TEST_SUITE_P(Springs, GrowingUnitsOf, testing::Values(1, 1e9));

TEST_P(GrowingUnitsOf, HaveExactDerivativesWhereForcesGrowWithLambda) {
  const Vector y{{0.3, -0.7}};
  const double mu = 0.2525;
  const Piece piece{1};
  Matrix J, dg;
  Vector dF, dl;
  ASSERT_TRUE(growing.derivatives(y, mu, piece, J, dF));
  ASSERT_TRUE(growing.switch_gradients(y, mu, dg, dl));
  const auto F = [&](const Vector& at, double m) {
    Vector value, g;
    growing.residual(at, m, piece, value);
    growing.switches(at, m, g);
    return Vector{{value[0], value[1], g[0]}};
  };
  Matrix all(3, 3), differences(3, 3);
  all << J, dF, dg, dl;
  for (Index i = 0; i < 2; ++i)
    differences.col(i) =
        difference([&](double h) { return F(y + h * Vector::Unit(2, i), mu); }, 1e-3);
  differences.col(2) = difference([&](double h) { return F(y, mu + h); }, 1e-6);
  EXPECT_LE((all - differences).cwiseAbs().maxCoeff(), 1e-9 * all.cwiseAbs().maxCoeff());
}

TEST_P(GrowingUnitsOf, TakePointsAndTangentsThereAndBack) {
  CurvePoint inside{.x = Vector{{0.3, -0.7}}, .lambda = 0.2525};
  inside.tangent = {Vector{{0.6, 2}}, 0.8};
  const CurvePoint back = growing.inside(growing.outside(inside));
  EXPECT_NEAR((back.x - inside.x).norm(), 0, 1e-14);
  EXPECT_NEAR(back.lambda, inside.lambda, 1e-15);
  EXPECT_NEAR((back.tangent.dx - inside.tangent.dx).norm(), 0, 1e-13);
  EXPECT_NEAR(back.tangent.dlambda, inside.tangent.dlambda, 1e-13);
  // A tangent outside is the rate of the point outside.
  const auto outside = [&](double h) {
    CurvePoint at = inside;
    at.x += h * inside.tangent.dx;
    at.lambda += h * inside.tangent.dlambda;
    at = growing.outside(at);
    return Vector{{at.x[0], at.x[1], at.lambda}};
  };
  const Vector rate = difference(outside, 1e-6);
  const Direction there = growing.outside(inside).tangent;
  EXPECT_NEAR(rate[0] / there.dx[0], 1, 1e-8);
  EXPECT_NEAR(rate[1] / there.dx[1], 1, 1e-9);
  EXPECT_NEAR(rate[2] / there.dlambda, 1, 1e-9);
}

}  // namespace
}  // namespace springfold::continuation
