#include "springfold/core/hermite.hpp"

#include <gtest/gtest.h>

#include "springfold/core/types.hpp"

namespace springfold {
namespace {

TEST(HermiteCubic, IsTheCubicWhoseValuesAndSlopesItIsGiven) {
  const auto f = [](double x) { return 2 - 3 * x + 0.5 * x * x + 4 * x * x * x; };
  const auto slope = [](double x) { return -3 + x + 12 * x * x; };
  const double from = 0.3, h = 1.7;
  const HermiteCubic<double> cubic{f(from), slope(from), f(from + h), slope(from + h), h};
  for (const double t : {-0.2, 0.0, 0.1, 0.5, 0.9, 1.0}) {
    EXPECT_NEAR(cubic.at(t), f(from + t * h), 1e-13);
    EXPECT_NEAR(cubic.slope_at(t), slope(from + t * h), 1e-12);
  }
}

TEST(HermiteCubic, OfVectorsIsThatOfEachEntry) {
  const Vector a{{1, 2}}, da{{0, -1}}, b{{3, 5}}, db{{2, 0}};
  const HermiteCubic<Vector> both{a, da, b, db, 0.5};
  for (Index i = 0; i < 2; ++i) {
    const HermiteCubic<double> one{a[i], da[i], b[i], db[i], 0.5};
    EXPECT_NEAR(both.at(0.3)[i], one.at(0.3), 1e-15);
    EXPECT_NEAR(both.slope_at(0.3)[i], one.slope_at(0.3), 1e-14);
  }
}

}  // namespace
}  // namespace springfold
