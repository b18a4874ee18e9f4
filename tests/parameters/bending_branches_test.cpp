// Where the branch that leaves a symmetric branch point bends the other way, along curves of such points.
#include <gtest/gtest.h>

#include "parameters/families.hpp"
#include "springfold/parameters/two_parameter.hpp"

namespace springfold::continuation {
namespace {

TEST(BendingBranch, OfASupercriticalBranchPointBendsTheOtherWayWhereThatBecomesSubcritical) {
  // On the branch that leaves x = 0 at l = mu, l = mu + (1 + mu) x^2 + x^4: it bends the other way at mu = -1.
  const Family family = family_of<ScalarProblem>([](double mu) {
    return ScalarProblem{
        [=](double x, double l) { return x * (mu - l + x * x * (1 + mu + x * x)); },
        [=](double x, double l) { return mu - l + x * x * (3 * (1 + mu) + 5 * x * x); },
        [](double x, double) { return -x; }};
  });
  for (const bool growing : {true, false}) {
    const auto curve =
        follow_critical(family, start_at(CriticalKind::branch_point, single(0), 0, 0), growing,
                        {stop_at(-2.3, 1.7)}, {});
    const auto bends = hits_of(curve, Degeneracy::bends_other_way);
    ASSERT_EQ(bends.size(), growing ? 0U : 1U);
    if (growing) continue;
    EXPECT_NEAR(bends[0].point.mu, -1, 1e-9);
    EXPECT_NEAR(bends[0].point.lambda, -1, 1e-9);
  }
}

/// Two modes that do not know of each other, x leaves at l = mu, y at l = 1, and one more unknown that follows the
/// load.
Given two_modes(double mu) {
  return {
      [=](const Vector& u, double l) {
        return Vector{{u[0] * (mu - l + u[0] * u[0]), u[1] * (1 - l + u[1] * u[1]), u[2] - l}};
      },
      [=](const Vector& u, double l) {
        return Matrix{{mu - l + 3 * u[0] * u[0], 0, 0}, {0, 1 - l + 3 * u[1] * u[1], 0}, {0, 0, 1}};
      },
      [](const Vector& u, double) {
        return Vector{{-u[0], -u[1], -1}};
      },
      3};
}

TEST(BendingBranch, ThatBendsOneWayAllAlongDoesNotTurnAtAnotherMode) {
  const Family family = family_of<Given>(two_modes);
  const auto curve =
      follow_critical(family, start_at(CriticalKind::branch_point, Vector{{0, 0, 0.3}}, 0.3, 0.3),
                      true, {stop_at(0, 1.7)}, {});
  ASSERT_EQ(hits_of(curve, Degeneracy::corank_two).size(), 1U);
  EXPECT_NEAR(hits_of(curve, Degeneracy::corank_two)[0].point.mu, 1, 1e-9);
  EXPECT_EQ(hits_of(curve, Degeneracy::bends_other_way).size(), 0U);
}

/// At the hilltop y = mu = 1 the bend is infinite.
TEST(BendingBranch, IsNotStraightAtAHilltop) {
  const Family family = family_of<Given>(hill);
  const double y = 0.5;
  const auto curve = follow_critical(
      family, start_at(CriticalKind::branch_point, Vector{{0, y}}, y - y * y * y / 3, y), true,
      {stop_at(0, 1.5)}, {});
  EXPECT_EQ(hits_of(curve, Degeneracy::hilltop).size(), 1U);
  EXPECT_EQ(hits_of(curve, Degeneracy::bends_other_way).size(), 0U);
}

}  // namespace
}  // namespace springfold::continuation
