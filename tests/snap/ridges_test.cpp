// Ways down that come to a ridge head on: they end there at once, and what stands on a ridge is left to both sides.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/state_book.hpp"
#include "snap/energies.hpp"

namespace springfold::analysis {
namespace {

using test::EnergyProblem;
using test::landscape_of;

/// Hessians that a way down asks for: steps to the bottom double in number of digits, so a few dozen are enough.
constexpr int few = 60;

/// V = (x^2 - 1)^2/4 + y^2/2 + y^4: minima at x = -1 and 1, a saddle of height 1/4 between them.
EnergyProblem two_valleys(int& asked) {
  return {
      .V =
          [](const Vector& q, double) {
            const double s = q[0] * q[0] - 1, y2 = q[1] * q[1];
            return s * s / 4 + y2 / 2 + y2 * y2;
          },
      .gradient =
          [](const Vector& q, double) {
            return Vector(Eigen::Vector2d(q[0] * (q[0] * q[0] - 1), q[1] + 4 * std::pow(q[1], 3)));
          },
      .hessian =
          [&asked](const Vector& q, double) {
            ++asked;
            return Matrix(Eigen::Vector2d(3 * q[0] * q[0] - 1, 1 + 12 * q[1] * q[1]).asDiagonal());
          },
      .n = 2};
}

TEST(Ridge, IsMetHeadOnByAWayDownThatStandsOnIt) {
  int asked = 0;
  const EnergyProblem problem = two_valleys(asked);
  const Landscape landscape = landscape_of(problem, 0);
  const Descent down = descend(landscape, Eigen::Vector2d(0, 0.7));
  ASSERT_EQ(down.end, Descent::End::rest);
  EXPECT_EQ(down.state.index, 1);
  EXPECT_NEAR(down.state.energy, 0.25, 1e-14);
  EXPECT_LT(asked, few);
}

TEST(Ridge, IsLeftToBothSides) {
  int asked = 0;
  const EnergyProblem problem = two_valleys(asked);
  const Landscape landscape = landscape_of(problem, 0);
  StateBook book(landscape);
  const WaysDown ways = book.ways_down(Eigen::Vector2d(0, 0.7));
  EXPECT_FALSE(ways.lost);
  ASSERT_EQ(ways.minima.size(), 2u);
  EXPECT_NEAR(book.states()[0].x[0] * book.states()[1].x[0], -1, 1e-12);
}

/// A side that can be told from rounding is kept.
TEST(Ridge, IsLeftToTheSideOnWhichAWayDownBegins) {
  int asked = 0;
  const EnergyProblem problem = two_valleys(asked);
  const Landscape landscape = landscape_of(problem, 0);
  for (const double side : {1e-6, -1e-6}) {
    const Descent down = descend(landscape, Eigen::Vector2d(side, 0.7));
    ASSERT_EQ(down.end, Descent::End::rest);
    EXPECT_NEAR(down.state.x[0], side > 0 ? 1 : -1, 1e-12);
  }
}

/// V = -x^4/4 + x^6/6 + y^2/2: a ridge that is flat to second order, from 1e-3 beside it.
TEST(Ridge, OfFourthOrderIsLeftThoughTheFirstStepsGainLessThanRounding) {
  EnergyProblem problem{
      .V = [](const Vector& q,
              double) { return -std::pow(q[0], 4) / 4 + std::pow(q[0], 6) / 6 + q[1] * q[1] / 2; },
      .gradient =
          [](const Vector& q, double) {
            return Vector(Eigen::Vector2d(-std::pow(q[0], 3) + std::pow(q[0], 5), q[1]));
          },
      .hessian =
          [](const Vector& q, double) {
            return Matrix(
                Eigen::Vector2d(-3 * q[0] * q[0] + 5 * std::pow(q[0], 4), 1).asDiagonal());
          },
      .n = 2};
  const Landscape landscape = landscape_of(problem, 0);
  const Descent down = descend(landscape, Eigen::Vector2d(-1e-3, 0.1));
  ASSERT_EQ(down.end, Descent::End::rest);
  EXPECT_NEAR(down.state.x[0], -1, 1e-12);
}

/// V = y^2/2 + y^4 whatever x is: a floor of states of rest, none of which is a minimum or a saddle.
TEST(Ridge, IsNoneOnALevelFloorWhereAWayDownEndsAtOnce) {
  int asked = 0;
  EnergyProblem problem = two_valleys(asked);
  problem.V = [](const Vector& q, double) { return q[1] * q[1] / 2 + std::pow(q[1], 4); };
  problem.gradient = [](const Vector& q, double) {
    return Vector(Eigen::Vector2d(0, q[1] + 4 * std::pow(q[1], 3)));
  };
  problem.hessian = [&asked](const Vector& q, double) {
    ++asked;
    return Matrix(Eigen::Vector2d(0, 1 + 12 * q[1] * q[1]).asDiagonal());
  };
  const Landscape landscape = landscape_of(problem, 0);
  const Descent down = descend(landscape, Eigen::Vector2d(0.3, 0.7));
  EXPECT_FALSE(down.end == Descent::End::rest && down.state.is_clear);
  EXPECT_NEAR(down.x[1], 0, 1e-8);
  EXPECT_LT(asked, few);
}

/// V = (x^2 + y^2 - 1)^2/4: rest all round a circle, as of a link that turns freely.
TEST(Floor, OfAFreeMotionDoesNotKeepASearchWithoutEnd) {
  const auto s = [](const Vector& q) { return q.squaredNorm() - 1; };
  EnergyProblem problem{.V = [=](const Vector& q, double) { return s(q) * s(q) / 4; },
                        .gradient = [=](const Vector& q, double) { return Vector(s(q) * q); },
                        .hessian =
                            [=](const Vector& q, double) {
                              return Matrix(s(q) * Matrix::Identity(2, 2) + 2 * q * q.transpose());
                            },
                        .n = 2};
  const Landscape landscape = landscape_of(problem, 0);
  StateBook book(landscape);
  book.ways_down(Eigen::Vector2d(0.6, 0.9));
  book.search({.starts = 32, .drives = 2});
  std::size_t resting = 0;
  for (const RestState& state : book.states()) resting += state.energy < 1e-12;
  EXPECT_GT(resting, 0u);
  EXPECT_LT(book.states().size(), 200u);
}

}  // namespace
}  // namespace springfold::analysis
