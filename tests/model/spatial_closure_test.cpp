// The spatial closure at a thousand poses: small, ordinary and almost half-turn rotations, both of
// the gap between chain and body and of the body itself.
#include <gtest/gtest.h>

#include <complex>
#include <numbers>

#include "model/complex_step.hpp"
#include "random_chain.hpp"

namespace springfold::model {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

struct Case {
  CompiledChain chain{};
  VectorOf<double> v{};
  double angle = 0;  ///< of the relative rotation
};

/// A chain and a body such that the chain's end is turned against the body by `angle`.
Case case_with_gap_rotation(std::mt19937& random, double angle) {
  Case c{.chain = random_chain(random, TaskSpace::spatial, false, true, 5), .angle = angle};
  c.v = random_vector(random, c.chain.variable_count(), 1.7);
  c.v.tail(6).setZero();
  Closure<double> at;
  evaluate_closure<double>(c.chain, c.v, nullptr, at);
  const Mat3<double> Q = exp_rotation<double>(Vec3<double>(at.e.tail(3)));
  const Mat3<double> R_body = exp_rotation<double>(Vec3<double>(-angle * random_unit(random))) * Q;
  c.v.tail(6).head(3) = random_vector(random, 3, 1.0);
  c.v.tail(3) = log_rotation<double>(R_body);
  return c;
}

std::vector<Case> thousand_cases() {
  std::mt19937 random(16);
  std::uniform_real_distribution<double> uniform(0, pi - 0.01);
  const std::array special{0.0,  1e-9,      1e-4,      0.999,     1.001,
                           3.14, pi - 1e-3, pi - 1e-5, pi - 1e-7, pi - 1e-8};
  std::vector<Case> cases;
  for (std::size_t i = 0; i < 1000; ++i)
    cases.push_back(case_with_gap_rotation(
        random, i % 2 ? uniform(random) : special[(i / 2) % special.size()]));
  return cases;
}

Closure<Complex> moved_along(const Case& c, Index j) {
  VectorOf<Complex> w = c.v.cast<Complex>();
  w[j] += Complex(0, tiny);
  Closure<Complex> moved;
  evaluate_closure<Complex>(c.chain, w, nullptr, moved);
  return moved;
}

TEST(SpatialClosure, HasTheRotationThatItWasBuiltWith) {
  for (const Case& c : thousand_cases()) {
    Closure<double> at;
    evaluate_closure<double>(c.chain, c.v, nullptr, at);
    EXPECT_NEAR(at.e.tail(3).norm(), c.angle, 1e-13);
  }
}

TEST(SpatialClosure, JacobianAgreesWithTheComplexStepUpToHalfATurn) {
  for (const Case& c : thousand_cases()) {
    Closure<double> at;
    evaluate_closure<double>(c.chain, c.v, nullptr, at);
    for (Index j = 0; j < c.v.size(); ++j) {
      const Vector column = moved_along(c, j).e.imag() / tiny;
      EXPECT_LT((column - at.J.col(j)).norm(), 1e-10 * (1 + at.J.norm()))
          << "angle " << c.angle << ", variable " << j;
    }
  }
}

TEST(SpatialClosure, HessianAgreesWithTheComplexStepUpToHalfATurn) {
  std::mt19937 random(17);
  for (const Case& c : thousand_cases()) {
    const VectorOf<double> F = random_vector(random, 6, 2.0);
    Closure<double> at;
    evaluate_closure<double>(c.chain, c.v, &F, at);
    EXPECT_LT((at.H - at.H.transpose()).norm(), 1e-12);
    for (Index j = 0; j < c.v.size(); ++j) {
      const Matrix J_rate = moved_along(c, j).J.imag() / tiny;
      const Vector column = J_rate.transpose() * F;
      EXPECT_LT((column - at.H.col(j)).norm(), 1e-10 * (1 + at.H.norm()))
          << "angle " << c.angle << ", variable " << j;
    }
  }
}

TEST(SpatialClosure, TurnsWithItsTwoBodies) {
  std::mt19937 random(18);
  for (int trial = 0; trial < 100; ++trial) {
    const CompiledChain chain = random_chain(random, TaskSpace::spatial, true, true, 3);
    VectorOf<double> v = random_vector(random, chain.variable_count(), 1.0);
    Closure<double> before, after;
    evaluate_closure<double>(chain, v, nullptr, before);
    const Pose<double> move = random_pose(random, false);
    for (const Index first : {Index{0}, v.size() - 6}) {
      const Pose<double> body{exp_rotation<double>(Vec3<double>(v.segment(first + 3, 3))),
                              v.segment(first, 3)};
      const Pose<double> there = move * body;
      v.segment(first, 3) = there.p;
      v.segment(first + 3, 3) = log_rotation<double>(there.R);
    }
    evaluate_closure<double>(chain, v, nullptr, after);
    EXPECT_LT((after.e.head(3) - move.R * before.e.head(3)).norm(), 1e-12);
    EXPECT_LT((after.e.tail(3) - move.R * before.e.tail(3)).norm(), 1e-12);
  }
}

TEST(PlanarClosure, MeasuresAnglesModuloAFullTurn) {
  std::mt19937 random(19);
  for (int trial = 0; trial < 100; ++trial) {
    const CompiledChain chain = random_chain(random, TaskSpace::planar, false, true, 3);
    VectorOf<double> v = random_vector(random, chain.variable_count(), 1.5);
    Closure<double> before, after;
    evaluate_closure<double>(chain, v, nullptr, before);
    v[v.size() - 1] += 2 * pi * (trial % 7 - 3);
    evaluate_closure<double>(chain, v, nullptr, after);
    EXPECT_LE(std::abs(before.e[2]), pi);
    EXPECT_LT((after.e - before.e).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace springfold::model
