// Places and directions at which functions are sampled, and when an iteration has settled.
#include "springfold/core/sampling.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "continuation/points/chebyshev.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/extended_matrix.hpp"

namespace springfold::continuation {
namespace {

TEST(UnevenShares, FillAnIntervalAndKeepOffItsMiddleAndItsThirds) {
  auto shares = uneven_shares<8>();
  std::sort(shares.begin(), shares.end());
  EXPECT_LT(shares.front(), 0.15);
  EXPECT_GT(shares.back(), 0.85);
  for (std::size_t i = 1; i < shares.size(); ++i) EXPECT_LT(shares[i] - shares[i - 1], 0.2);
  for (const double share : shares)
    for (const double place : {0.0, 1.0 / 3, 0.5, 2.0 / 3, 1.0})
      EXPECT_GT(std::abs(share - place), 0.005) << share;
}

TEST(SharesTowardsEnds, LieSymmetricallyAndCrowdThere) {
  const auto shares = shares_towards_ends<6>();
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(shares[i] + shares[5 - i], 1, 1e-15);
  EXPECT_GT(shares[0], 0);
  EXPECT_LT(10 * shares[0], shares[1]);
  EXPECT_LT(3 * shares[1], shares[2]);
}

TEST(Decades, AreTheNumbersThatAreWrittenSo) {
  EXPECT_THAT((decades<-3, 0>()), testing::ElementsAre(1e-3, 1e-2, 1e-1, 1.0));
  EXPECT_THAT((decades<-6, -5>()), testing::ElementsAre(1e-6, 1e-5));
}

TEST(HalfDecades, AreADecadeApartTwoByTwo) {
  const auto shares = half_decades<5>();
  EXPECT_EQ(shares[0], 1);
  for (std::size_t i = 2; i < shares.size(); ++i) EXPECT_NEAR(shares[i - 2] / shares[i], 10, 1e-14);
}

TEST(IrregularVectors, AreIndependent) {
  for (Index n = 1; n <= 8; ++n) {
    Matrix all(n, n);
    for (Index i = 0; i < n; ++i)
      for (Index k = 0; k < n; ++k) all(i, k) = irregular(i, k);
    EXPECT_GT(singular_values(all).minCoeff(), 1e-3) << n;
  }
}

TEST(Interpolants, AreCheckedBetweenTheirSamplesAndNotInTheMiddle) {
  const auto p = interpolate_value([](double t) { return std::optional<double>(t); }, 2, 4);
  ASSERT_TRUE(p);
  for (const double check : p->checks()) {
    EXPECT_GT(std::abs(check - 3), 0.2);
    for (const double sample : p->at) EXPECT_GT(std::abs(check - sample), 0.1);
  }
}

TEST(Iterations, SettleWithAFineStepOrWhereSmallStepsNoLongerShrink) {
  EXPECT_TRUE(has_settled(1e-15, 1e-9, 1e-14, 1e-9));
  EXPECT_TRUE(has_settled(1e-11, 2e-11, 1e-14, 1e-9));
  EXPECT_FALSE(has_settled(1e-11, 1e-9, 1e-14, 1e-9)) << "still shrinks";
  EXPECT_FALSE(has_settled(1e-6, 2e-6, 1e-14, 1e-9)) << "not small";
}

}  // namespace
}  // namespace springfold::continuation
