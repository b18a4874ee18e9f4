// Curves of branch points that a symmetry keeps, whatever the unknowns in which it is written.
#include <gtest/gtest.h>

#include <cmath>

#include "parameters/families.hpp"

namespace springfold::continuation {
namespace {

/// Two units with c x - 3 x^2 + x^3 + k (x - other) = lambda. Along x_1 = x_2 = u they part where c - 6 u + 3 u^2 + 2 k
/// = 0.
Given coupled_pair(double c, double k) {
  return {[=](const Vector& x, double lambda) {
            const auto u = x.array();
            const double pull = k * (x[0] - x[1]);
            return Vector((c * u - 3 * u.square() + u.cube() - lambda).matrix() +
                          Vector{{pull, -pull}});
          },
          [=](const Vector& x, double) {
            const auto u = x.array();
            return Matrix(Matrix((c - 6 * u + 3 * u.square()).matrix().asDiagonal()) +
                          k * Matrix{{1, -1}, {-1, 1}});
          },
          [](const Vector& x, double) { return Vector(-Vector::Ones(x.size())); }, 2};
}

double parts_at(double c, double k) { return 1 - std::sqrt(1 - (c + 2 * k) / 3); }
double common_load(double c, double u) { return ((u - 3) * u + c) * u; }

TEST(KeptSymmetries, NeedNotBeOrthogonalInTheUnknownsOfABranchPoint) {
  const double k = -0.2;
  const Family family = family_of<Given>([=](double c) { return in_sums(coupled_pair(c, k)); });
  const double c = 2, u = parts_at(c, k);
  const CriticalStart start{.kind = CriticalKind::branch_point,
                            .x = Vector{{u, 2 * u}},
                            .lambda = common_load(c, u),
                            .mu = c};
  const auto rate = critical_rate(family, start);
  ASSERT_TRUE(rate);
  const double by_c =
      1 / (6 * (1 - u));  // of u; along the path lambda grows by c - 6 u + 3 u^2 = -2 k
  EXPECT_NEAR(rate->dlambda, u - 2 * k * by_c, 1e-9);
  for (const bool growing : {true, false}) {
    const CriticalCurve curve = follow_critical(family, start, growing, {stop_at(1, 2.5)}, {});
    EXPECT_TRUE(curve.kept);
    EXPECT_NEAR(curve.hits.back().point.mu, growing ? 2.5 : 1, 1e-9);
    for (const CriticalPoint& p : curve.points) {
      const double at = parts_at(p.mu, k);
      EXPECT_NEAR(p.lambda, common_load(p.mu, at), 1e-10);
      EXPECT_LT((p.x - at * Vector{{1, 2}}).norm(), 1e-9);
    }
  }
}

/// V = y^2/2 - lambda y + (y^2 - mu) x^2/2 + x^4/4 in (x, y): along y = lambda a pair of branch points at lambda^2 =
/// mu.
Given pair_of_branch_points(double mu) {
  return {[=](const Vector& u, double l) {
            return Vector{{u[0] * (u[1] * u[1] - mu + u[0] * u[0]), u[1] - l + u[1] * u[0] * u[0]}};
          },
          [=](const Vector& u, double) {
            return Matrix{{u[1] * u[1] - mu + 3 * u[0] * u[0], 2 * u[0] * u[1]},
                          {2 * u[0] * u[1], 1 + u[0] * u[0]}};
          },
          [](const Vector&, double) {
            return Vector{{0, -1}};
          },
          2};
}

TEST(KeptSymmetries, LeadAPairOfBranchPointsToItsBirth) {
  for (const bool in_other_unknowns : {false, true}) {
    const Family family = family_of<Given>([=](double mu) {
      return in_other_unknowns ? in_sums(pair_of_branch_points(mu)) : pair_of_branch_points(mu);
    });
    for (const double begin : {0.04, 0.25, 1.0}) {
      SCOPED_TRACE(begin);
      const double y = std::sqrt(begin);
      const CriticalStart start{
          .kind = CriticalKind::branch_point, .x = Vector{{0, y}}, .lambda = y, .mu = begin};
      const CriticalCurve curve = follow_critical(family, start, false, {stop_at(-1, 1.5)}, {});
      EXPECT_TRUE(curve.kept);
      const auto births = hits_of(curve, Degeneracy::branch_points_merge);
      ASSERT_EQ(births.size(), 1U);
      EXPECT_NEAR(births[0].point.mu, 0, 1e-12);
      EXPECT_NEAR(births[0].point.lambda, 0, 1e-9);
      for (const CriticalPoint& p : curve.points) {
        EXPECT_NEAR(p.x[0], 0, 1e-10);
        EXPECT_NEAR(p.mu, p.lambda * p.lambda, 1e-10);
      }
      EXPECT_NEAR(curve.hits.back().point.lambda, -std::sqrt(1.5), 1e-9);
    }
  }
}

}  // namespace
}  // namespace springfold::continuation
