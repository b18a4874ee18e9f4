// Two modes that vanish together: the umbilics as branch points of corank two.
#include <gtest/gtest.h>

#include "exit_problems.hpp"
#include "springfold/continuation/trace.hpp"

namespace springfold::continuation {
namespace {

/// V = x^3/3 + y^3/3 - l (x^2 + y^2)/2: hyperbolic.
Small hyperbolic() {
  return {.n = 2, .at = [](const Vector& z, double l, Vector& F, Matrix& H, Vector& F_l) {
            F = Vector{{z[0] * z[0] - l * z[0], z[1] * z[1] - l * z[1]}};
            H = Matrix{{2 * z[0] - l, 0}, {0, 2 * z[1] - l}};
            F_l = -z;
          }};
}

/// V = x^3/3 - x y^2 - l (x^2 + y^2)/2: elliptic.
Small elliptic() {
  return {.n = 2, .at = [](const Vector& z, double l, Vector& F, Matrix& H, Vector& F_l) {
            F = Vector{{z[0] * z[0] - z[1] * z[1] - l * z[0], -2 * z[0] * z[1] - l * z[1]}};
            H = Matrix{{2 * z[0] - l, -2 * z[1]}, {-2 * z[1], -2 * z[0] - l}};
            F_l = -z;
          }};
}

/// The trunk x = y = 0 from l = -1 to 1.
Curve trunk_of(const Small& problem) {
  const auto rays = rays_from(problem, Vector::Zero(2), -1, {}, {}).rays;
  const Ray& up = rays[rays[0].tangent.dlambda > 0 ? 0 : 1];
  return trace(problem, Vector::Zero(2), -1, up,
               {{"end", [](const CurvePoint& p) { return p.lambda - 1; }, EventAction::stop}}, {});
}

void expect_one_double_point(const Small& problem) {
  const Curve curve = trunk_of(problem);
  ASSERT_EQ(curve.hits.size(), 2U);
  EXPECT_EQ(curve.hits[0].kind, HitKind::branch_point);
  EXPECT_EQ(curve.hits[0].multiplicity, 2);
  EXPECT_NEAR(curve.hits[0].point.lambda, 0, 1e-10);
}

TEST(Umbilics, AreOneBranchPointOfCorankTwoOnTheirTrunk) {
  expect_one_double_point(hyperbolic());
  expect_one_double_point(elliptic());
}

TEST(Umbilics, OfTheHyperbolicKindHaveThreeBranchesBesidesTheTrunk) {
  const Small problem = hyperbolic();
  const auto walker = walker_of(problem);
  EXPECT_EQ(corank_of(walker, origin(2)), 2);
  std::vector<Direction> expected;
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}})
    both_ways(expected, unit(Vector{{x, y}}, 1));
  expect_exits(walker, origin(2), exits_at(walker, origin(2), 2), expected, 1e-6);
}

TEST(Umbilics, OfTheEllipticKindHaveThreeBranchesBesidesTheTrunk) {
  const Small problem = elliptic();
  const auto walker = walker_of(problem);
  EXPECT_EQ(corank_of(walker, origin(2)), 2);
  const double h = std::sqrt(3.0) / 2;
  std::vector<Direction> expected;
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {-0.5, h}, {-0.5, -h}})
    both_ways(expected, unit(Vector{{x, y}}, 1));
  expect_exits(walker, origin(2), exits_at(walker, origin(2), 2), expected, 1e-6);
}

}  // namespace
}  // namespace springfold::continuation
