#include "continuation/locating/exits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "exit_problems.hpp"

namespace springfold::continuation {
namespace {

using std::numbers::pi;

TEST(Exits, OfAPerfectPitchforkAreTheTrunkAndTheArms) {
  const auto problem = pitchfork();
  std::vector<Direction> expected;
  both_ways(expected, {Vector{{0.0}}, 1.0});
  both_ways(expected, {Vector{{1.0}}, 0.0});
  const auto walker = walker_of(problem);
  EXPECT_EQ(corank_of(walker, origin(1)), 1);
  expect_exits(walker, origin(1), exits_at(walker, origin(1), 1), expected, 1e-9);
}

TEST(Exits, OfATranscriticalPointAreFour) {
  const auto problem = transcritical();
  std::vector<Direction> expected;
  both_ways(expected, {Vector{{0.0}}, 1.0});
  both_ways(expected, unit(Vector{{1.0}}, 1.0));
  const auto walker = walker_of(problem);
  expect_exits(walker, origin(1), exits_at(walker, origin(1), 1), expected, 1e-10);
}

TEST(Exits, OfALimitPointAreItsTwoDirections) {
  const auto problem = cusp(1);
  const double x = std::sqrt(1.0 / 3);
  const CurvePoint at{.x = Vector{{x}}, .lambda = x * (x * x - 1)};
  const auto walker = walker_of(problem);
  EXPECT_EQ(corank_of(walker, at), 0);
  std::vector<Direction> expected;
  both_ways(expected, {Vector{{1.0}}, 0.0});
  expect_exits(walker, at, exits_at(walker, at, 0), expected, 1e-10);
}

TEST(Exits, OfTheCentreOfAnIsolaAreNone) {
  const ScalarProblem problem{[](double x, double l) { return x * x + l * l + x * l; },
                              [](double x, double l) { return 2 * x + l; },
                              [](double x, double l) { return 2 * l + x; }};
  const auto walker = walker_of(problem);
  EXPECT_EQ(corank_of(walker, origin(1)), 1);
  expect_exits(walker, origin(1), exits_at(walker, origin(1), 1), {}, 0);
}

TEST(Exits, WhereOnlyOneCurveGoesThroughADegeneratePointAreTwo) {
  // x^3 + l^3 = (x + l)(x^2 - x l + l^2)
  const ScalarProblem problem{[](double x, double l) { return x * x * x + l * l * l; },
                              [](double x, double) { return 3 * x * x; },
                              [](double, double l) { return 3 * l * l; }};
  const auto walker = walker_of(problem);
  std::vector<Direction> expected;
  both_ways(expected, unit(Vector{{1.0}}, -1.0));
  expect_exits(walker, origin(1), exits_at(walker, origin(1), 1), expected, 1e-6);
}

TEST(Exits, OfCurvesThatTouchEachOtherAreAllFound) {
  // (l - x^2)(l + x^2): four rays, pairwise tangent
  const ScalarProblem problem{[](double x, double l) { return l * l - x * x * x * x; },
                              [](double x, double) { return -4 * x * x * x; },
                              [](double, double l) { return 2 * l; }};
  const auto walker = walker_of(problem);
  std::vector<Direction> expected;
  both_ways(expected, {Vector{{1.0}}, 0.0});
  both_ways(expected, {Vector{{1.0}}, 0.0});
  expect_exits(walker, origin(1), exits_at(walker, origin(1), 1), expected, 1e-6);
}

TEST(Exits, OfADoubleLineAreNotTrusted) {
  const ScalarProblem problem{[](double x, double) { return x * x; },
                              [](double x, double) { return 2 * x; },
                              [](double, double) { return 0.0; }};
  const auto walker = walker_of(problem);
  EXPECT_FALSE(exits_at(walker, origin(1), 1).complete);
}

TEST(Exits, AtCorankThreeAreNotSearchedFor) {
  const Small problem{.n = 3,
                      .at = [](const Vector& z, double l, Vector& F, Matrix& H, Vector& F_l) {
                        F = (z.squaredNorm() - l) * z;
                        H = (z.squaredNorm() - l) * Matrix::Identity(3, 3) + 2 * z * z.transpose();
                        F_l = -z;
                      }};
  const auto walker = walker_of(problem);
  EXPECT_EQ(corank_of(walker, origin(3)), 3);
  const auto found = exits_at(walker, origin(3), 3);
  EXPECT_FALSE(found.complete);
  EXPECT_FALSE(found.why.empty());
}

/// (x - p1 l)(x - p2 l) + cubic terms: crosses with known slopes.
Small crossing(double p1, double p2) {
  return {.n = 1, .at = [=](const Vector& z, double l, Vector& F, Matrix& H, Vector& F_l) {
            const double a = z[0] - p1 * l, b = z[0] - p2 * l;
            F[0] = a * b * (1 + z[0]) + z[0] * z[0] * z[0];
            H(0, 0) = (a + b) * (1 + z[0]) + a * b + 3 * z[0] * z[0];
            F_l[0] = -(p1 * b + p2 * a) * (1 + z[0]);
          }};
}

TEST(Exits, OfCrossingsAmongManyUnknownsHaveTheAnglesOfTheQuadraticTerms) {
  std::mt19937_64 random(41);
  for (const bool mixed : {false, true})
    for (int i = 0; i < 10; ++i) {
      const double p1 = uniform(random, -2, 2), p2 = p1 + uniform(random, 0.3, 2);
      const Hidden problem(crossing(p1, p2), 5, random, 3, mixed);
      const auto walker = walker_of(problem);
      const CurvePoint at = problem.place(Vector::Zero(1), 0);
      EXPECT_EQ(corank_of(walker, at), 1);
      std::vector<Direction> expected;
      for (const double p : {p1, p2})
        both_ways(expected, problem.lift(Vector::Zero(1), Vector{{p}}, 1));
      expect_exits(walker, at, exits_at(walker, at, 1), expected, 1e-9);
    }
}

TEST(Exits, AreTheSameWhereThePointIsLocatedToTenDigitsOnly) {
  std::mt19937_64 random(42);
  const Hidden problem(crossing(-0.5, 0.7), 5, random, 3);
  const auto walker = walker_of(problem);
  CurvePoint at = problem.place(Vector::Zero(1), 0);
  at.x += 1e-10 * Vector{{0.3, -0.8, 0.5, 0.1, -0.4}};
  at.lambda += 5e-11;
  EXPECT_EQ(corank_of(walker, at), 1);
  std::vector<Direction> expected;
  for (const double p : {-0.5, 0.7})
    both_ways(expected, problem.lift(Vector::Zero(1), Vector{{p}}, 1));
  expect_exits(walker, at, exits_at(walker, at, 1), expected, 1e-8);
}

TEST(Exits, OfAHilltopWhereAFoldMeetsABranchPointAllGoDown) {
  // x y = 0, l = x^2 + 2 y^2
  const Small problem{.n = 2,
                      .at =
                          [](const Vector& z, double l, Vector& F, Matrix& H, Vector& F_l) {
                            F = Vector{{z[0] * z[1], z[0] * z[0] + 2 * z[1] * z[1] - l}};
                            H = Matrix{{z[1], z[0]}, {2 * z[0], 4 * z[1]}};
                            F_l = Vector{{0.0, -1.0}};
                          },
                      .potential = false};
  const auto walker = walker_of(problem);
  EXPECT_EQ(corank_of(walker, origin(2)), 1);
  std::vector<Direction> expected;
  both_ways(expected, {Vector{{1.0, 0.0}}, 0.0});
  both_ways(expected, {Vector{{0.0, 1.0}}, 0.0});
  expect_exits(walker, origin(2), exits_at(walker, origin(2), 1), expected, 1e-9);
}

TEST(Exits, OfAThreefoldSymmetricDoublePointAreEight) {
  // V = l r^2 / 2 + (x^3 - 3 x y^2) / 3: arms along x = -l and turned by 120 degrees
  const Small small{.n = 2, .at = [](const Vector& z, double l, Vector& F, Matrix& H, Vector& F_l) {
                      const double x = z[0], y = z[1];
                      F = Vector{{l * x + x * x - y * y, l * y - 2 * x * y}};
                      H = Matrix{{l + 2 * x, -2 * y}, {-2 * y, l - 2 * x}};
                      F_l = z;
                    }};
  std::mt19937_64 random(43);
  for (const Index n : {2, 10}) {
    const Hidden problem(small, n, random, n == 2 ? 1 : 10);
    const auto walker = walker_of(problem);
    const CurvePoint at = problem.place(Vector::Zero(2), 0);
    EXPECT_EQ(corank_of(walker, at), 2);
    std::vector<Direction> expected;
    both_ways(expected, problem.lift(Vector::Zero(2), Vector::Zero(2), 1));
    for (int i = 0; i < 3; ++i) {
      const Vector y{{std::cos(2 * pi * i / 3), std::sin(2 * pi * i / 3)}};
      both_ways(expected, problem.lift(Vector::Zero(2), y, -1));
    }
    expect_exits(walker, at, exits_at(walker, at, 2), expected, 1e-9);
  }
}

/// V = 1/2 (m - l)(x^2 + y^2) + 1/4 (a x^4 + 2 b x^2 y^2 + c y^4)
Small two_mode(double m, double a, double b, double c) {
  return {.n = 2, .at = [=](const Vector& z, double l, Vector& F, Matrix& H, Vector& F_l) {
            const double x = z[0], y = z[1], X = x * x, Y = y * y;
            F = Vector{{x * (m - l + a * X + b * Y), y * (m - l + b * X + c * Y)}};
            H = Matrix{{m - l + 3 * a * X + b * Y, 2 * b * x * y},
                       {2 * b * x * y, m - l + b * X + 3 * c * Y}};
            F_l = -z;
          }};
}

std::vector<Direction> two_mode_exits(const Hidden& problem, double a, double b, double c) {
  const Vector zero = Vector::Zero(2);
  std::vector<Direction> expected;
  both_ways(expected, problem.lift(zero, zero, 1));
  both_ways(expected, problem.lift(zero, Vector{{1.0, 0.0}}, 0));
  both_ways(expected, problem.lift(zero, Vector{{0.0, 1.0}}, 0));
  const double D = a * c - b * b;
  if ((c - b) / D > 0 && (a - b) / D > 0)
    for (const double sign : {1.0, -1.0})
      both_ways(
          expected,
          problem.lift(zero, Vector{{std::sqrt((c - b) / D), sign * std::sqrt((a - b) / D)}}, 0));
  if ((c - b) / D < 0 && (a - b) / D < 0)  // the same with l falling
    for (const double sign : {1.0, -1.0})
      both_ways(
          expected,
          problem.lift(zero, Vector{{std::sqrt((b - c) / D), sign * std::sqrt((b - a) / D)}}, 0));
  return expected;
}

TEST(Exits, OfTwoModesThatBuckleTogetherIncludeTheMixedOnesWhereTheyExist) {
  std::mt19937_64 random(44);
  for (int i = 0; i < 50; ++i) {
    const auto draw = [&] { return uniform(random, 0.3, 2); };
    const double a = draw(), c = draw(), b = uniform(random, -1.5, 2.5);
    if (std::min({std::abs(a - b), std::abs(c - b), std::abs(a * c - b * b)}) < 0.05) continue;
    const Index n = i % 2 == 0 ? 2 : 10;
    const Hidden problem(two_mode(1, a, b, c), n, random, n == 2 ? 1 : 10, i % 4 == 3);
    const auto walker = walker_of(problem);
    const CurvePoint at = problem.place(Vector::Zero(2), 1);
    SCOPED_TRACE(testing::Message() << i << ": a " << a << " b " << b << " c " << c << " n " << n);
    EXPECT_EQ(corank_of(walker, at), 2);
    expect_exits(walker, at, exits_at(walker, at, 2), two_mode_exits(problem, a, b, c), 1e-6);
  }
}

/// N springs from a regular polygon, R = 1, to an apex under the load l; stress-free at height z0.
struct BarDome {
  int N = 3;
  double z0 = 2;
  double rest() const { return std::hypot(1, z0); }
  Small problem() const {
    const double L0 = rest();
    const int legs = N;
    return {.n = 3, .at = [=](const Vector& z, double l, Vector& F, Matrix& H, Vector& F_l) {
              F = Vector{{0.0, 0.0, l}};
              H = Matrix::Zero(3, 3);
              F_l = Vector{{0.0, 0.0, 1.0}};
              for (int i = 0; i < legs; ++i) {
                const Vector d =
                    z - Vector{{std::cos(2 * pi * i / legs), std::sin(2 * pi * i / legs), 0.0}};
                const double L = d.norm();
                F += (1 - L0 / L) * d;
                H += (1 - L0 / L) * Matrix::Identity(3, 3) + L0 / (L * L * L) * d * d.transpose();
              }
            }};
  }
  /// Where the apex may sway: L^3 - L0 L^2 + L0 / 2 = 0, the larger root.
  CurvePoint double_point() const {
    const double L0 = rest();
    double L = L0;
    for (int i = 0; i < 60; ++i) L -= (L * L * L - L0 * L * L + L0 / 2) / (3 * L * L - 2 * L0 * L);
    const double z = std::sqrt(L * L - 1);
    return {.x = Vector{{0.0, 0.0, z}}, .lambda = N * z * (L0 / L - 1)};
  }
};

void expect_polygon_symmetry(int N, const Exits& found) {
  for (const Exit& exit : found.exits) {
    const double c = std::cos(2 * pi / N), s = std::sin(2 * pi / N);
    const Vector& d = exit.tangent.dx;
    const Direction turned{Vector{{c * d[0] - s * d[1], s * d[0] + c * d[1], d[2]}},
                           exit.tangent.dlambda};
    double nearest = 9;
    for (const Exit& other : found.exits)
      nearest = std::min(nearest, distance(other.tangent, turned));
    EXPECT_LT(nearest, 1e-4) << N << ": " << d.transpose();
  }
}

TEST(Exits, OfADomeAtItsDoublePointHaveTheSymmetryOfItsPolygon) {
  for (const auto& [N, count] : {std::pair{3, 8}, {4, 10}, {5, 12}, {6, 14}}) {
    const BarDome dome{.N = N};
    const Small problem = dome.problem();
    const auto walker = walker_of(problem);
    const CurvePoint at = dome.double_point();
    Vector F;
    ASSERT_TRUE(problem.residual(at.x, at.lambda, F));
    ASSERT_LT(F.norm(), 1e-12);
    EXPECT_EQ(corank_of(walker, at), 2);
    const auto found = exits_at(walker, at, 2);
    EXPECT_TRUE(found.complete) << N << ": " << found.why;
    EXPECT_EQ(found.exits.size(), static_cast<std::size_t>(count)) << N;
    expect_polygon_symmetry(N, found);
  }
}

TEST(Exits, ThatOnlyTermsOfHighOrderTellApartAreAllFoundOrNotCalledComplete) {
  for (const int N : {7, 8})
    for (const double z0 : {1.8, 3.0}) {
      const Small problem = BarDome{.N = N, .z0 = z0}.problem();
      const auto walker = walker_of(problem);
      const auto found = exits_at(walker, BarDome{.N = N, .z0 = z0}.double_point(), 2);
      EXPECT_TRUE(!found.complete || std::ssize(found.exits) == 2 * N + 2) << N << " " << z0;
    }
}

TEST(Exits, AreTheSameForTheSameBytes) {
  std::mt19937_64 random(45);
  const Hidden problem(two_mode(1, 1, 0.4, 0.7), 10, random, 10);
  const auto walker = walker_of(problem);
  const CurvePoint at = problem.place(Vector::Zero(2), 1);
  const auto one = exits_at(walker, at, 2), two = exits_at(walker, at, 2);
  ASSERT_EQ(one.exits.size(), two.exits.size());
  for (std::size_t i = 0; i < one.exits.size(); ++i) {
    EXPECT_EQ(one.exits[i].start.x, two.exits[i].start.x);
    EXPECT_EQ(one.exits[i].tangent.dx, two.exits[i].tangent.dx);
  }
}

TEST(Exits, KeepThePieceAndCountNegativeEigenvalues) {
  const auto problem = pitchfork();
  const auto walker = walker_of(problem);
  for (const Exit& exit : exits_at(walker, origin(1), 1).exits) {
    const double slope = exit.start.lambda - 3 * exit.start.x[0] * exit.start.x[0];
    EXPECT_TRUE(exit.start.piece.empty());
    EXPECT_EQ(exit.start.negative, slope < 0 ? 1 : 0);
  }
}

}  // namespace
}  // namespace springfold::continuation
