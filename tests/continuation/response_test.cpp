#include "springfold/continuation/response.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tracing.hpp"

namespace springfold::continuation {
namespace {

using testing::HasSubstr;

/// A bar of stiffness k that is compressed by u under the load lambda, beside a strut that buckles at `critical`:
/// F = (k u - lambda, (critical - lambda) theta).
struct CompressedStrut {
  double k = 1, critical = 1;
  static Index size() { return 2; }
  static bool symmetric() { return true; }
  bool residual(const Vector& x, double lambda, Vector& F) const {
    F = Vector{{k * x[0] - lambda, (critical - lambda) * x[1]}};
    return true;
  }
  bool derivatives(const Vector& x, double lambda, Matrix& dF_dx, Vector& dF_dlambda) const {
    dF_dx = Matrix{{k, 0.0}, {0.0, critical - lambda}};
    dF_dlambda = Vector{{-1.0, -x[1]}};
    return true;
  }
};

/// Two struts that buckle at two loads: nothing moves before.
struct TwoStruts {
  double first = 1, second = 1e6;
  static Index size() { return 2; }
  static bool symmetric() { return true; }
  bool residual(const Vector& x, double lambda, Vector& F) const {
    F = Vector{{(first - lambda) * x[0], (second - lambda) * x[1]}};
    return true;
  }
  bool derivatives(const Vector& x, double lambda, Matrix& dF_dx, Vector& dF_dlambda) const {
    dF_dx = Matrix{{first - lambda, 0.0}, {0.0, second - lambda}};
    dF_dlambda = -x;
    return true;
  }
};

TEST(Response, IsTheSlopeOfACurveThatMoves) {
  for (const double k : {1e-15, 1.0, 3e12}) {
    const ScalarProblem spring = graph([k](double x) { return k * (x + x * x * x); },
                                       [k](double x) { return k * (1 + 3 * x * x); });
    const auto response = response_at(spring, Vector::Zero(1), 0, {});
    ASSERT_TRUE(response && response->lambda);
    EXPECT_NEAR(*response->lambda, 16 * k, 1e-9 * k);
  }
}

TEST(Response, OfATrivialBranchIsTheFirstCriticalLoad) {
  for (const double first : {1e-9, 1.0, 1e9}) {
    const TwoStruts struts{first, 100 * first};
    const auto response = response_at(struts, Vector::Zero(2), 0, {});
    ASSERT_TRUE(response && response->lambda);
    EXPECT_NEAR(*response->lambda, 8 * first, 0.01 * first);
  }
}

TEST(Response, OfABarThatHardlyGivesWayIsTheFirstCriticalLoadToo) {
  const auto stiff = response_at(CompressedStrut{1e5, 10}, Vector::Zero(2), 0, {});
  ASSERT_TRUE(stiff && stiff->lambda);
  EXPECT_NEAR(*stiff->lambda, 80, 1);
  const auto soft = response_at(CompressedStrut{1, 10}, Vector::Zero(2), 0, {});
  ASSERT_TRUE(soft && soft->lambda);
  EXPECT_NEAR(*soft->lambda, 16, 1e-9);
}

/// 3 x - x^3 has the bend 3 x, and a limit point at 1.
TEST(Response, OfACurveThatTurnsJustBesideIsItsBend) {
  const ScalarProblem cubic =
      graph([](double x) { return 3 * x - x * x * x; }, [](double x) { return 3 - 3 * x * x; });
  for (const double off : {1e-2, -1e-3, 1e-4, 1e-5, -1e-6, 1e-7, 1e-8}) {
    const double x = 1 - off;
    const auto response = response_at(cubic, Vector::Constant(1, x), 3 * x - x * x * x, {});
    ASSERT_TRUE(response && response->lambda) << off;
    EXPECT_NEAR(*response->lambda, 16 * 3 * x, 1e-6) << off;
  }
}

TEST(Response, HasNoUnitWhereNothingMovesNorChanges) {
  const ScalarProblem rest{[](double x, double) { return x; }, [](double, double) { return 1.0; },
                           [](double, double) { return 0.0; }};
  const auto response = response_at(rest, Vector::Zero(1), 0, {});
  ASSERT_TRUE(response);
  EXPECT_FALSE(response->lambda);
}

TEST(Response, IsUndefinedAtALimitPoint) {
  EXPECT_FALSE(response_at(circle(), Vector::Zero(1), 1, {}));
}

/// V = k x^2/2 - lambda x + y^3/6 - x^2 y/2: at x = y = lambda = 0 two curves cross, and y has no stiffness.
struct Crossing {
  static Index size() { return 2; }
  static bool symmetric() { return true; }
  bool residual(const Vector& x, double lambda, Vector& F) const {
    F = Vector{{x[0] - x[0] * x[1] - lambda, (x[1] * x[1] - x[0] * x[0]) / 2}};
    return true;
  }
  bool derivatives(const Vector& x, double, Matrix& dF_dx, Vector& dF_dlambda) const {
    dF_dx = Matrix{{1 - x[1], -x[0]}, {-x[0], x[1]}};
    dF_dlambda = Vector{{-1.0, 0.0}};
    return true;
  }
};

TEST(Response, IsUndefinedWhereASpecialPointIsAsNearAsItCanBeLocated) {
  for (const double off : {0.0, 1e-16, -1e-11})
    EXPECT_FALSE(response_at(Crossing{}, Vector{{0.0, off}}, 0, {})) << off;
  const auto regular = response_at(Crossing{}, Vector{{0.0, 0.5}}, 0, {});
  ASSERT_TRUE(regular && regular->lambda);
}

TEST(LongCurve, HasItsLimitPointAlsoWhereLambdaIsTiny) {
  const double soft = 1e-7;
  const auto height = [soft](double x) { return soft * (3 * x - x * x * x); };
  const auto slope = [soft](double x) { return soft * (3 - 3 * x * x); };
  const ScalarProblem curve_of = graph(height, slope);
  const Curve curve = trace(curve_of, Vector::Constant(1, -0.5), height(-0.5),
                            ray_of(curve_of, at(-0.5, height(-0.5), 1, 0), {}), {x_reaches(2)}, {});
  ASSERT_EQ(curve.hits.size(), 2u);
  EXPECT_EQ(curve.hits[0].kind, HitKind::limit_point);
  EXPECT_NEAR(curve.hits[0].point.x[0], 1, 1e-10);
  EXPECT_NEAR(curve.hits[0].point.lambda, 2 * soft, 1e-9 * soft);
}

TEST(LongCurve, SaysWhyItTookAsManyPointsAsAllowed) {
  TraceOptions options;
  options.maximum_points = 100;
  const ScalarProblem line = graph([](double x) { return x; }, [](double) { return 1.0; });
  const Curve curve =
      trace(line, Vector::Zero(1), 0, ray_of(line, at(0, 0, 1, 1), {}), {}, options);
  EXPECT_EQ(curve.stop, StopReason::max_points);
  EXPECT_THAT(curve.stop_detail, HasSubstr("100 points over an arc length of"));
  EXPECT_THAT(curve.stop_detail, HasSubstr("maximum_points"));
  EXPECT_THAT(curve.stop_detail, HasSubstr("limit"));
}

}  // namespace
}  // namespace springfold::continuation
