// Chains of elastic links at ten thousand random poses of chain and body, rotations up to and almost
// at half a turn: first and second derivatives against the complex step.
#include <gtest/gtest.h>

#include <complex>
#include <numbers>

#include "random_chain.hpp"
#include "springfold/model/elastic_link.hpp"

namespace springfold::model {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

/// Base - elastic link (six virtual joints) - passive joint - body.
CompiledChain elastic_chain(std::mt19937& random) {
  Mechanism m;
  m.bodies = {{"tool", TaskSpace::spatial, Vector::Zero(6)}};
  Chain chain{.name = "leg"};
  chain.from_attachment = random_pose(random, false);
  chain.to_attachment = random_pose(random, false);
  using enum ElasticDirection;
  add_elastic_link(chain, "link", 0.7, {Tx, Ty, Tz, Rx, Ry, Rz}, Matrix::Identity(6, 6),
                   Vector::Zero(6), Vector::Zero(6));
  chain.elements.push_back(Joint{.name = "hinge", .axis = random_unit(random)});
  m.chains = {chain};
  return compile(m, m.chains[0]);
}

/// Rotation angles of the body: all sizes, a third of them within 1e-1 ... 1e-7 of half a turn.
double random_angle(std::mt19937& random, int trial) {
  std::uniform_real_distribution<double> uniform(0, 1);
  if (trial % 3 == 0) return pi - std::pow(10, -1 - 6 * uniform(random));
  return pi * uniform(random);
}

TEST(ElasticClosure, HasExactDerivativesAtTenThousandPosesUpToHalfATurn) {
  std::mt19937 random(41);
  double worst_J = 0, worst_H = 0, largest = 0;
  for (int trial = 0; trial < 10000; ++trial) {
    const CompiledChain chain = elastic_chain(random);
    VectorOf<double> v = random_vector(random, chain.variable_count(), 1.5);
    v.tail(3) = random_angle(random, trial) * random_unit(random);
    // Every other body is where the chain ends but for a rotation of any size up to half a turn.
    Closure<double> at;
    if (trial % 2) {
      const Vec3<double> gap = random_angle(random, trial / 2) * random_unit(random);
      v.tail(3).setZero();
      evaluate_closure<double>(chain, v, nullptr, at);
      const Mat3<double> E = exp_rotation<double>(Vec3<double>(at.e.tail(3)));
      v.tail(3) = log_rotation<double>(Mat3<double>(exp_rotation<double>(gap).transpose() * E));
    }
    const VectorOf<double> F = random_vector(random, 6, 2.0);
    evaluate_closure<double>(chain, v, &F, at);
    largest = std::max(largest, at.e.tail(3).norm());
    const Index j = trial % v.size();
    VectorOf<Complex> w = v.cast<Complex>();
    w[j] += Complex(0, 1e-30);
    Closure<Complex> moved;
    evaluate_closure<Complex>(chain, w, nullptr, moved);
    const Vector de = moved.e.imag() / 1e-30;
    const Vector dJ = (moved.J.imag() / 1e-30).transpose() * F;
    worst_J = std::max(worst_J, (de - at.J.col(j)).norm() / (1 + at.J.norm()));
    worst_H = std::max(worst_H, (dJ - at.H.col(j)).norm() / (1 + at.H.norm()));
  }
  EXPECT_LT(worst_J, 1e-10);
  EXPECT_LT(worst_H, 1e-10);
  EXPECT_GT(largest, pi - 1e-6);
}

}  // namespace
}  // namespace springfold::model
