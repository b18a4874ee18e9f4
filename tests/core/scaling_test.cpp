#include "springfold/core/scaling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace springfold {
namespace {

using Limits = std::numeric_limits<double>;

TEST(PowerOfTwoNear, IsAPowerOfTwoWithinAFactorOfTheRootOfTwo) {
  std::mt19937 random(31);
  std::uniform_real_distribution<double> exponent(-300, 300);
  for (int trial = 0; trial < 10000; ++trial) {
    const double value = (trial % 2 ? -1 : 1) * std::pow(10.0, exponent(random));
    const double power = power_of_two_near(value);
    int ignored = 0;
    ASSERT_EQ(std::frexp(power, &ignored), 0.5) << "not a power of two: " << power;
    const double ratio = std::abs(value) / power, root = std::numbers::sqrt2;
    ASSERT_TRUE(ratio >= (1 - 1e-15) / root && ratio <= (1 + 1e-15) * root) << value;
  }
}

TEST(PowerOfTwoNear, FollowsAChangeOfUnitsByPowersOfTwoExactly) {
  std::mt19937 random(32);
  std::uniform_real_distribution<double> uniform(1, 2);
  for (int trial = 0; trial < 200; ++trial) {
    const double value = uniform(random);
    for (int k = -1000; k <= 1000; k += 7)
      ASSERT_EQ(power_of_two_near(std::ldexp(value, k)), std::ldexp(power_of_two_near(value), k))
          << value << " * 2^" << k;
  }
}

TEST(PowerOfTwoNear, LeavesPowersOfTwoAsTheyAre) {
  for (int k = -1074; k <= 1023; ++k)
    EXPECT_EQ(power_of_two_near(std::ldexp(1, k)), std::ldexp(1, k));
}

TEST(PowerOfTwoNear, SplitsAtTheGeometricMean) {
  const double root = std::numbers::sqrt2;
  EXPECT_EQ(power_of_two_near(std::nextafter(root, 0) * (1 - Limits::epsilon())), 1);
  EXPECT_EQ(power_of_two_near(root * (1 + 2 * Limits::epsilon())), 2);
}

TEST(PowerOfTwoNear, DividesSubnormalNumbersToOrderOne) {
  for (const double value : {Limits::denorm_min(), 3 * Limits::denorm_min(), Limits::min() / 3}) {
    const double ratio = value / power_of_two_near(value);
    EXPECT_GE(ratio, 0.5) << value;
    EXPECT_LE(ratio, 2) << value;
  }
}

TEST(PowerOfTwoNear, IsOneWhereThereIsNoScale) {
  for (const double value :
       {0.0, -0.0, Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN()})
    EXPECT_EQ(power_of_two_near(value), 1) << value;
}

}  // namespace
}  // namespace springfold
