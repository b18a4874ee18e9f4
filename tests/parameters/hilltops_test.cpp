// Branch points at which lambda turns back, followed as limit points of the path with the other modes held.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "families.hpp"

namespace springfold::continuation {
namespace {

/// Units x_i with c_i x - 3 x^2 + x^3 = lambda, c = (mu, mu + apart * mu, ...).
Given row_of_units(Index count, double apart, double mu) {
  Vector c(count);
  for (Index i = 0; i < count; ++i) c[i] = mu * (1 + apart * static_cast<double>(i));
  return {[c](const Vector& x, double lambda) {
            const auto u = x.array();
            return Vector((c.array() * u - 3 * u.square() + u.cube() - lambda).matrix());
          },
          [c](const Vector& x, double) {
            const auto u = x.array();
            return Matrix((c.array() - 6 * u + 3 * u.square()).matrix().asDiagonal());
          },
          [](const Vector& x, double) { return Vector(-Vector::Ones(x.size())); }, count};
}
Family units(Index count, double apart) {
  return family_of<Given>([=](double mu) { return row_of_units(count, apart, mu); });
}

double turn_at(double c) { return 1 - std::sqrt(1 - c / 3); }
double load_at(double c) {
  const double u = turn_at(c);
  return ((u - 3) * u + c) * u;
}

/// Where all of them turn, as the branch point that it is called.
CriticalStart turn_of_all(Index count, double c) {
  return {.kind = CriticalKind::branch_point,
          .x = Vector::Constant(count, turn_at(c)),
          .lambda = load_at(c),
          .mu = c,
          .corank = static_cast<int>(count) - 1};
}

Direction together(Index count) { return {Vector::Ones(count).normalized(), 0}; }

TEST(Hilltops, AreFollowedToTheCuspOfTheirUnits) {
  for (const Index count : {2, 3, 5}) {
    SCOPED_TRACE(count);
    const Family family = units(count, 0);
    const auto start = hilltop_start(family, turn_of_all(count, 2), together(count));
    ASSERT_TRUE(start);
    EXPECT_EQ(start->held_right.cols(), count - 1);
    const CriticalCurve curve = follow_critical(family, *start, true, {}, {.maximum_points = 40});
    const auto cusp = std::find_if(curve.hits.begin(), curve.hits.end(),
                                   [](const auto& hit) { return hit.kind == Degeneracy::cusp; });
    ASSERT_NE(cusp, curve.hits.end());
    EXPECT_NEAR(cusp->point.mu, 3, 1e-9);
    EXPECT_NEAR(cusp->point.lambda, 1, 1e-9);
    ASSERT_EQ(cusp->point.x.size(), count);
    for (const CriticalPoint& p : curve.points) {
      if (p.s >= cusp->point.s) break;
      EXPECT_NEAR(p.lambda, load_at(p.mu), 1e-10);
    }
  }
}

TEST(Hilltops, AreTheSameInUnknownsInWhichTheirSymmetryIsNotOrthogonal) {
  for (const Index count : {2, 3, 4}) {
    SCOPED_TRACE(count);
    const Family family =
        family_of<Given>([=](double mu) { return in_sums(row_of_units(count, 0, mu)); });
    CriticalStart at = turn_of_all(count, 2);
    const Vector path = Vector::LinSpaced(count, 1.0, static_cast<double>(count));
    at.x = turn_at(2) * path;
    const auto start = hilltop_start(family, at, {path.normalized(), 0});
    ASSERT_TRUE(start);
    const auto rate = critical_rate(family, *start);
    ASSERT_TRUE(rate);
    EXPECT_NEAR(rate->dlambda, turn_at(2), 1e-9);
    const CriticalCurve curve = follow_critical(family, *start, false, {stop_at(1, 2.5)}, {});
    EXPECT_TRUE(curve.kept);
    EXPECT_NEAR(curve.hits.back().point.mu, 1, 1e-9);
    for (const CriticalPoint& p : curve.points) {
      EXPECT_NEAR(p.lambda, load_at(p.mu), 1e-10);
      EXPECT_LT((p.x - turn_at(p.mu) * path).norm(), 1e-9);
    }
  }
}

TEST(Hilltops, MoveAtTheRateOfTheClosedForm) {
  const Family family = units(3, 0);
  const auto start = hilltop_start(family, turn_of_all(3, 2), together(3));
  ASSERT_TRUE(start);
  const auto rate = critical_rate(family, *start);
  ASSERT_TRUE(rate);
  EXPECT_NEAR(rate->dlambda, turn_at(2), 1e-9);
  EXPECT_EQ(rate->dx.size(), 3);
}

TEST(Hilltops, ArePolishedOnlyFromPlacesOnTheirPath) {
  const Family family = units(3, 0);
  auto start = hilltop_start(family, turn_of_all(3, 2), together(3));
  ASSERT_TRUE(start);
  start->x += 1e-4 * Vector::Ones(3);
  const auto point = polish_critical(family, *start);
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->lambda, load_at(2), 1e-12);
  start->x += 1e-4 * Vector{{1, -2, 1}};  // along the modes that are held
  EXPECT_FALSE(polish_critical(family, *start));
}

TEST(Hilltops, HaveNoCurveOverAParameterThatPartsTheUnits) {
  const Family family = units(2, 0);
  const auto start = hilltop_start(family, turn_of_all(2, 2), together(2));
  ASSERT_TRUE(start);
  const auto parted = family_of<Given>([](double mu) {
    return Given{[mu](const Vector& x, double lambda) {
                   const auto u = x.array();
                   const Vector c{{2, mu}};
                   return Vector((c.array() * u - 3 * u.square() + u.cube() - lambda).matrix());
                 },
                 [mu](const Vector& x, double) {
                   const auto u = x.array();
                   const Vector c{{2, mu}};
                   return Matrix((c.array() - 6 * u + 3 * u.square()).matrix().asDiagonal());
                 },
                 [](const Vector& x, double) { return Vector(-Vector::Ones(x.size())); }, 2};
  });
  EXPECT_FALSE(critical_rate(parted, *start));
  EXPECT_FALSE(follow_critical(parted, *start, true, {}, {.maximum_points = 20}).kept);
}

TEST(Hilltops, HaveNoRateByAParameterThatMovesTheBranchPointAlone) {
  // Two equal units and a spring between them, which their common path does not feel.
  const auto coupled = family_of<Given>([](double mu) {
    return Given{[mu](const Vector& x, double lambda) {
                   const auto u = x.array();
                   const double pull = mu * (x[0] - x[1]);
                   return Vector((2 * u - 3 * u.square() + u.cube() - lambda).matrix() +
                                 Vector{{pull, -pull}});
                 },
                 [mu](const Vector& x, double) {
                   const auto u = x.array();
                   return Matrix(Matrix((2 - 6 * u + 3 * u.square()).matrix().asDiagonal()) +
                                 mu * Matrix{{1, -1}, {-1, 1}});
                 },
                 [](const Vector& x, double) { return Vector(-Vector::Ones(x.size())); }, 2};
  });
  CriticalStart at = turn_of_all(2, 2);
  at.mu = 0;
  const auto start = hilltop_start(coupled, at, together(2));
  ASSERT_TRUE(start);
  EXPECT_FALSE(critical_rate(coupled, *start));
}

TEST(Hilltops, AreNoneWhereLambdaGoesOn) {
  const Family family = units(2, 0);
  EXPECT_FALSE(hilltop_start(family, turn_of_all(2, 2), {Vector::Ones(2).normalized(), 0.1}));
}

}  // namespace
}  // namespace springfold::continuation
