// All zeros of a function on an interval.
#include "continuation/locating/zeros.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace springfold::continuation {
namespace {

TEST(Zeros, ThatTouchAreFoundBesideALargerHump) {
  // Two touches: the parabola at each of them is steep compared with the values far away.
  const auto f = [](double t) -> std::optional<double> {
    return std::pow((t - 0.12) * (t - 0.83), 2);
  };
  for (const double begin : {-0.05, 0.0, 0.013}) {
    const ZeroSearch found = find_zeros(f, begin, 1.0, 1e-13, 1e-7);
    ASSERT_TRUE(found.resolved);
    ASSERT_EQ(found.zeros.size(), 2u) << "from " << begin;
    EXPECT_TRUE(found.zeros[0].touches);
    EXPECT_NEAR(found.zeros[0].at, 0.12, 1e-7);
    EXPECT_TRUE(found.zeros[1].touches);
    EXPECT_NEAR(found.zeros[1].at, 0.83, 1e-7);
  }
}

TEST(Zeros, ThatTouchRightBesideACrossingAreFound) {
  // Wherever both lie between the places at which the function is looked at first.
  for (const double apart : {1e-3, 3e-3, 6e-3, 9e-3, 1.3e-2, 1.8e-2, 2.5e-2})
    for (double crossing = 0.3; crossing < 0.31; crossing += 0.0007) {
      const auto f = [=](double t) -> std::optional<double> {
        return (t - crossing) * std::pow(t - crossing - apart, 2);
      };
      const ZeroSearch found = find_zeros(f, 0, 1, 1e-15, 1e-7, NoiseIs::bound);
      ASSERT_TRUE(found.resolved);
      ASSERT_EQ(found.zeros.size(), 2u) << "from " << crossing << ", " << apart << " apart";
      EXPECT_FALSE(found.zeros[0].touches);
      EXPECT_NEAR(found.zeros[0].at, crossing, 1e-7);
      EXPECT_TRUE(found.zeros[1].touches);
      EXPECT_NEAR(found.zeros[1].at, crossing + apart, 1e-6);
    }
}

TEST(Zeros, BesideATouchLieWhereTheFunctionIsZeroThoughTheirSlopeIsSmall) {
  // Over the whole interval the polynomial is as good as the bound of noise, which is far above what noise there is.
  for (double touch = 0.6; touch < 0.62; touch += 0.0037) {
    const double crossing = touch + 0.005;
    const auto f = [=](double t) -> std::optional<double> {
      return std::pow(t - touch, 2) * (t - crossing) * std::exp(3 * t);
    };
    const ZeroSearch found = find_zeros(f, 0, 1, 1e-8, 1e-7, NoiseIs::bound);
    ASSERT_TRUE(found.resolved);
    ASSERT_EQ(found.zeros.size(), 2u) << "touch at " << touch;
    EXPECT_TRUE(found.zeros[0].touches);
    EXPECT_NEAR(found.zeros[0].at, touch, 1e-8);
    EXPECT_FALSE(found.zeros[1].touches);
    EXPECT_NEAR(found.zeros[1].at, crossing, 1e-10);
  }
}

TEST(Zeros, ThatAreToldApartHaveNoTouchBetweenThem) {
  // Between them the function is no farther from zero than noise might be, but far clear of the noise that is seen.
  for (double apart = 1e-3; apart < 4e-2; apart *= 1.05)
    for (double first = 0.3; first < 0.31; first += 0.0007) {
      const auto f = [=](double t) -> std::optional<double> {
        return (t - first) * (t - first - apart);
      };
      const double farthest = 0.25 * apart * apart;
      const ZeroSearch found = find_zeros(f, 0, 1, 1.2 * farthest, 1e-7, NoiseIs::doubt);
      ASSERT_TRUE(found.resolved);
      ASSERT_EQ(found.zeros.size(), 2u) << "from " << first << ", " << apart << " apart";
      for (const ZeroOf& zero : found.zeros) EXPECT_FALSE(zero.touches || zero.several);
      EXPECT_NEAR(found.zeros[0].at, first, 1e-9);
      EXPECT_NEAR(found.zeros[1].at, first + apart, 1e-9);
    }
}

TEST(Zeros, ThatTouchWithinNoiseOverAWideStretchAreOneTouch) {
  constexpr double noise = 1e-12;
  const auto f = [](double t) -> std::optional<double> {
    return 1e-8 * (t - 0.47) * (t - 0.47) + 0.05 * noise * std::sin(1e9 * t);
  };
  for (const double begin : {0.0, 0.1, 0.2, 0.31}) {
    const ZeroSearch found = find_zeros(f, begin, 1.0, noise, 1e-7);
    ASSERT_TRUE(found.resolved) << "from " << begin;
    ASSERT_EQ(found.zeros.size(), 1u) << "from " << begin;
    EXPECT_TRUE(found.zeros[0].touches);
    EXPECT_NEAR(found.zeros[0].at, 0.47, 1e-4);
  }
}

TEST(Zeros, AreNoneWhereAFunctionRisesFromZeroAtAnEndLikeARoot) {
  for (const double power : {0.2, 0.5, 0.8, 1.5}) {
    const auto falling = [power](double t) -> std::optional<double> {
      return t == 1 ? 0 : -std::pow(1 - t, power);
    };
    const auto rising = [power](double t) -> std::optional<double> { return std::pow(t, power); };
    for (const SampledFunction& f : {SampledFunction{falling}, SampledFunction{rising}}) {
      const ZeroSearch found = find_zeros(f, 0, 1, 1e-14, 1e-12);
      EXPECT_TRUE(found.resolved) << power;
      for (const ZeroOf& zero : found.zeros) EXPECT_TRUE(zero.at == 0 || zero.at == 1) << zero.at;
    }
  }
}

TEST(Zeros, BesideAnEndThatIsZeroAreFound) {
  const auto f = [](double t) -> std::optional<double> { return std::sqrt(1 - t) * (t - 0.999); };
  const ZeroSearch found = find_zeros(f, 0, 1, 1e-14, 1e-12);
  ASSERT_TRUE(found.resolved);
  ASSERT_GE(found.zeros.size(), 1u);
  EXPECT_NEAR(found.zeros[0].at, 0.999, 1e-9);
}

TEST(Zeros, OfNoiseAreGivenUpSoon) {
  int asked = 0;
  const auto noise = [&](double t) -> std::optional<double> {
    ++asked;
    return std::sin(1e9 * t);
  };
  EXPECT_FALSE(find_zeros(noise, 0, 1, 1e-6, 1e-7).resolved);
  EXPECT_LT(asked, 10000);
}

TEST(Zeros, OfAFunctionThatIsNotANumberSomewhereAreGivenUp) {
  for (const double from : {0.05, 0.3, 0.62}) {
    const auto f = [from](double t) -> std::optional<double> {
      return t > from && t < from + 0.3 ? std::numeric_limits<double>::quiet_NaN() : t - 0.45;
    };
    EXPECT_FALSE(find_zeros(f, 0, 1, 1e-13, 1e-7).resolved) << from;
  }
}

TEST(Zeros, OfAFunctionBelowTheNoiseAreNone) {
  const auto f = [](double t) -> std::optional<double> { return 1e-9 * (t - 0.5); };
  EXPECT_TRUE(find_zeros(f, 0, 1, 1e-6, 1e-7).zeros.empty());
}

}  // namespace
}  // namespace springfold::continuation
