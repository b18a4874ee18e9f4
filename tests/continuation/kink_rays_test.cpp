// All ways out of a point at which many switches act at once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "continuation/kinks/kink.hpp"
#include "kink_problems.hpp"
#include "tracing.hpp"

namespace springfold::continuation {
namespace {

using testing::HasSubstr;

Rays rays_of_chain(const BarChain& chain) {
  return rays_from(chain, Vector::Ones(chain.n), static_cast<double>(chain.n),
                   Piece(static_cast<std::size_t>(chain.k), -1), {});
}

TEST(KinkRays, OfKSofteningBarsAreAllTwoToTheK) {
  // The force falls by 1: a bar that softens gets longer by 2, one that springs back shorter by 1.
  for (const auto& [n, k] : {std::pair<Index, Index>{1, 1}, {3, 3}, {7, 5}, {12, 12}, {30, 12}}) {
    const Rays rays = rays_of_chain({.n = n, .k = k});
    EXPECT_TRUE(rays.complete) << rays.why;
    ASSERT_EQ(rays.rays.size(), std::size_t{1} << k);
    std::size_t number = 0;
    for (const Ray& ray : rays.rays) {
      Vector dx = -Vector::Ones(n);
      std::size_t code = 0;
      for (Index i = 0; i < k; ++i)
        if (ray.piece[static_cast<std::size_t>(i)] > 0) {
          dx[i] = 2;
          code += std::size_t{1} << i;
        }
      EXPECT_EQ(code, number++) << "the order is fixed";
      const double length = std::sqrt(dx.squaredNorm() + dx.sum() * dx.sum());
      EXPECT_LT((ray.tangent.dx - dx / length).norm(), 1e-13);
      EXPECT_NEAR(ray.tangent.dlambda, dx.sum() / length, 1e-13);
    }
  }
}

TEST(KinkRays, OfHardeningBarsAreTwo) {
  for (const Index k : {1, 4, 12}) {
    const Rays rays = rays_of_chain({.n = 14, .k = k, .after = 3});
    EXPECT_TRUE(rays.complete) << rays.why;
    ASSERT_EQ(rays.rays.size(), 2u);
    EXPECT_LT(rays.rays[0].tangent.dlambda, 0);
    EXPECT_GT(rays.rays[1].tangent.dlambda, 0);
  }
}

Curve stretch(const BarChain& chain) {
  const Vector x = Vector::Constant(chain.n, 0.8);
  return follow(
      chain, {x, x.sum(), Piece(static_cast<std::size_t>(chain.k), -1), {Vector::Ones(chain.n), 1}},
      {lambda_reaches(1.5 * static_cast<double>(chain.n))});
}

TEST(KinkRays, AreAllInTheHitOfABranchingKink) {
  const Curve curve = stretch({.n = 8, .k = 6});
  EXPECT_EQ(curve.stop, StopReason::several_ways);
  ASSERT_EQ(curve.hits.size(), 1u);
  EXPECT_EQ(curve.hits[0].kind, HitKind::branching_kink);
  EXPECT_EQ(curve.hits[0].leaving.size(), 63u) << "all but the way back";
}

TEST(KinkRays, OfTwelveHardeningBarsPassThrough) {
  const Curve curve = stretch({.n = 12, .k = 12, .after = 2});
  EXPECT_EQ(curve.stop, StopReason::event) << curve.stop_detail;
  ASSERT_EQ(curve.hits.size(), 2u);
  EXPECT_EQ(curve.hits[0].kind, HitKind::kink);
  EXPECT_EQ(curve.hits[0].switches.size(), 12u);
}

TEST(KinkRays, OfSwitchesThatActTogetherNeedNotBeZeroTogether) {
  // 2e-11 apart, in x and in lambda less than rows are promised to
  for (const double k0 : {1.0, 1e-3}) {
    const PiecewiseLine line{k0, {{k0, 0.1, 1}, {k0, 0.1 + 1e-11, 1}, {k0, 0.1 - 1e-11, -1}}};
    const double lambda = k0 * (-0.5) + k0 * (-0.5 - (0.1 - 1e-11));
    const Curve curve = follow(line, at(-0.5, lambda, 1, 0, {-1, -1, -1}), {x_reaches(0.6)});
    ASSERT_EQ(curve.stop, StopReason::event) << curve.stop_detail;
    ASSERT_EQ(curve.hits.size(), 2u);
    EXPECT_EQ(curve.hits[0].switches.size(), 3u);
    EXPECT_NEAR(curve.hits[0].point.x[0], 0.1, 1e-10);
  }
}

TEST(KinkRays, OfMoreThanTwelveSwitchesAreUnresolved) {
  const Curve curve = stretch({.n = 13, .k = 13, .after = 2});
  EXPECT_EQ(curve.stop, StopReason::several_ways);
  EXPECT_THAT(curve.stop_detail, HasSubstr("too many switches"));
  ASSERT_EQ(curve.hits.size(), 1u);
  EXPECT_EQ(curve.hits[0].kind, HitKind::unresolved);
}

}  // namespace
}  // namespace springfold::continuation
