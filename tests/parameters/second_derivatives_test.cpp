// Second derivatives that a problem offers itself.
#include <gtest/gtest.h>

#include "families.hpp"

namespace springfold::continuation {
namespace {

/// lambda = x^3 - 3 mu x, with limit points at x = -+sqrt(mu) and a cusp at 0; counts who asks.
struct CubicFold {
  double mu = 0;
  int* asked = nullptr;

  Index size() const { return 1; }
  bool residual(const Vector& x, double lambda, Vector& F) const {
    F = single(std::pow(x[0], 3) - 3 * mu * x[0] - lambda);
    return true;
  }
  bool derivatives(const Vector& x, double, Matrix& dF_dx, Vector& dF_dlambda) const {
    dF_dx = Matrix::Constant(1, 1, 3 * x[0] * x[0] - 3 * mu);
    dF_dlambda = single(-1);
    return true;
  }
  bool second_along(const Vector& x, double, const Vector& w, const Vector& V,
                    Vector& value) const {
    ++*asked;
    value = Vector{{w[0] * 6 * x[0] * V[0], 0}};
    return true;
  }
};

TEST(SecondDerivativesOfAProblem, AreAskedForAlongACurveOfLimitPoints) {
  int asked = 0;
  const Family family = family_of<CubicFold>([&](double mu) { return CubicFold{mu, &asked}; });
  const auto start = start_at(CriticalKind::limit_point, single(-0.5), 0.25, 0.25);
  TraceOptions options;
  options.maximum_points = 60;
  const CriticalCurve curve = follow_critical(family, start, false, {}, options);
  EXPECT_GT(asked, static_cast<int>(curve.points.size()));
  ASSERT_FALSE(curve.hits.empty());
  EXPECT_EQ(curve.hits.front().kind, Degeneracy::cusp);
  EXPECT_NEAR(curve.hits.front().point.mu, 0, 1e-10);
  for (const CriticalPoint& point : curve.points) {
    EXPECT_NEAR(point.mu, point.x[0] * point.x[0], 1e-12);
    EXPECT_NEAR(point.lambda, -2 * std::pow(point.x[0], 3), 1e-12);
  }
}

TEST(SecondDerivativesOfAProblem, GiveRatesOfLimitPoints) {
  int asked = 0;
  const Family family = family_of<CubicFold>([&](double mu) { return CubicFold{mu, &asked}; });
  const auto rate =
      critical_rate(family, start_at(CriticalKind::limit_point, single(-0.5), 0.25, 0.25));
  ASSERT_TRUE(rate);
  EXPECT_GT(asked, 0);
  EXPECT_NEAR(rate->dlambda, 1.5, 1e-10);  // lambda = 2 mu^(3/2)
  EXPECT_NEAR(rate->dx[0], -1, 1e-10);     // x = -mu^(1/2)
}

}  // namespace
}  // namespace springfold::continuation
