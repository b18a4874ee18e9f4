// Equilibria are looked for near a guess: angles that have gone through whole turns on the way are the same postures.
#include "statics/whole_turns.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "examples.hpp"

namespace springfold::statics {
namespace {

constexpr double half_turn = std::numbers::pi;

/// sin(y) = 1/2 with a spring on the angle, y - y0 times its stiffness.
SquareSystem pendulum(double stiffness, double y0) {
  return {1,
          [=](const Vector& y, Vector& r) {
            r = Vector{{std::sin(y[0]) - 0.5 + stiffness * (y[0] - y0)}};
            return true;
          },
          [=](const Vector& y, Matrix& J) {
            J = Matrix{{std::cos(y[0]) + stiffness}};
            return true;
          },
          {0}};
}

TEST(WholeTurns, AreTakenBackToWithinHalfATurnOfTheGuess) {
  for (const double turns : {-1e7, -3.0, -1.0, 1.0, 2.0, 4e6}) {
    Vector y{{degrees(30) + turns * 2 * half_turn}};
    take_back_turns(pendulum(0, 0), Vector{{-0.2}}, y);
    EXPECT_NEAR(y[0], degrees(30), 1e-15 * (1 + std::abs(turns))) << turns;
  }
}

TEST(WholeTurns, StayWhereASpringCountsThem) {
  const double there = degrees(30) + 6 * half_turn;
  Vector y{{there}};
  take_back_turns(pendulum(1e-9, there), Vector{{0}}, y);
  EXPECT_EQ(y[0], there);
}

TEST(WholeTurns, OfAnAngleThatIsNearItsGuessAreNone) {
  Vector y{{degrees(30)}};
  take_back_turns(pendulum(0, 0), Vector{{degrees(30) + 0.9 * half_turn}}, y);
  EXPECT_EQ(y[0], degrees(30));
}

/// A plate on three line springs of free lengths of about their own, at random places.
model::Mechanism plate_on_springs(std::mt19937& random) {
  std::uniform_real_distribution<double> anchor(-1.5, 1.5), at(-0.6, 0.6), free(0.5, 1.5);
  model::Mechanism m;
  m.bodies = {{"plate", model::TaskSpace::planar, Vector{{0.1, 0.05, 0.2}}}};
  for (const double stiffness : {1.0, 1.2, 0.8}) {
    const Vec3 from{anchor(random), anchor(random), 0}, to{at(random), at(random), 0};
    m.line_springs.push_back(
        {"s", {.body = 0, .at = from}, {.body = 1, .at = to}, stiffness, free(random)});
  }
  return m;
}

/// Starts of 300 such plates under a load; one in a hundred may have none.
std::vector<FirstEquilibrium> starts_of_plates() {
  std::mt19937 random(20261201);
  std::vector<FirstEquilibrium> starts;
  for (int draw = 0; draw < 300; ++draw) {
    const System system = prepare(plate_on_springs(random));
    StartProblem problem{.z = guess(system)};
    problem.inputs = {system.commands, Vector{{0.1, -0.2, 0}}, {}};
    const FirstEquilibrium first = first_equilibrium(system, problem);
    if (first.status == StartStatus::found) starts.push_back(first);
  }
  return starts;
}

TEST(StartsOfFreePlates, AreLessThanAWholeTurnFromTheirGuess) {
  const auto starts = starts_of_plates();
  EXPECT_GE(starts.size(), 297u);
  for (const FirstEquilibrium& start : starts) EXPECT_LT(std::abs(start.z[2] - 0.2), 2 * half_turn);
}

// A spring that is as short as rounding has a force without a direction, which balances nothing.
TEST(StartsOfFreePlates, AreEquilibria) {
  for (const FirstEquilibrium& start : starts_of_plates()) EXPECT_LT(start.residual, 1e-12);
}

}  // namespace
}  // namespace springfold::statics
