#include "springfold/model/closure.hpp"

#include <gtest/gtest.h>

#include <complex>

#include "model/complex_step.hpp"
#include "random_chain.hpp"

namespace springfold::model {
namespace {

using Complex = std::complex<double>;

struct ChainShape {
  TaskSpace space;
  bool from_moves, to_moves;
};

class ClosureDerivatives : public testing::TestWithParam<ChainShape> {};

/// Variables at random; rotation vectors kept away from 2 pi, where the chart ends.
VectorOf<double> random_variables(std::mt19937& random, const CompiledChain& chain) {
  return random_vector(random, chain.variable_count(), 1.7);
}

TEST_P(ClosureDerivatives, JacobianAgreesWithTheComplexStep) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    CompiledChain chain = random_chain(random, GetParam().space, GetParam().from_moves,
                                       GetParam().to_moves, trial % 6);
    chain.flat = trial % 2 == 0 && is_flat(chain);
    const VectorOf<double> v = random_variables(random, chain);
    Closure<double> at;
    evaluate_closure<double>(chain, v, nullptr, at);
    for (Index j = 0; j < v.size(); ++j) {
      VectorOf<Complex> w = v.cast<Complex>();
      w[j] += Complex(0, tiny);
      Closure<Complex> moved;
      evaluate_closure<Complex>(chain, w, nullptr, moved);
      const Vector column = moved.e.imag() / tiny;
      EXPECT_LT((column - at.J.col(j)).norm(), 1e-10 * (1 + at.J.col(j).norm()))
          << "trial " << trial << ", variable " << j;
    }
  }
}

TEST_P(ClosureDerivatives, ContractedHessianAgreesWithTheComplexStepOfTheJacobian) {
  std::mt19937 random(8);
  for (int trial = 0; trial < 200; ++trial) {
    CompiledChain chain = random_chain(random, GetParam().space, GetParam().from_moves,
                                       GetParam().to_moves, trial % 6);
    chain.flat = trial % 2 == 0 && is_flat(chain);
    const VectorOf<double> v = random_variables(random, chain);
    const VectorOf<double> F = random_vector(random, chain.dimension(), 2.0);
    Closure<double> at;
    evaluate_closure<double>(chain, v, &F, at);
    ASSERT_LT((at.H - at.H.transpose()).norm(), 1e-12);
    for (Index j = 0; j < v.size(); ++j) {
      VectorOf<Complex> w = v.cast<Complex>();
      w[j] += Complex(0, tiny);
      Closure<Complex> moved;
      evaluate_closure<Complex>(chain, w, nullptr, moved);
      const Matrix J_rate = moved.J.imag() / tiny;
      const Vector column = J_rate.transpose() * F;
      EXPECT_LT((column - at.H.col(j)).norm(), 1e-10 * (1 + at.H.norm()))
          << "trial " << trial << ", variable " << j;
    }
  }
}

TEST(FlatClosure, IsThatOfTheGeneralWay) {
  std::mt19937 random(10);
  constexpr TaskSpace plane[] = {TaskSpace::xy, TaskSpace::planar};
  for (int trial = 0; trial < 400; ++trial) {
    CompiledChain chain =
        random_chain(random, plane[trial % 2], trial % 3 > 0, trial % 5 > 0, trial % 7);
    chain.from_space = plane[trial / 2 % 2];
    chain.to_space = plane[trial / 4 % 2];
    if (chain.space == TaskSpace::planar) chain.from_space = chain.to_space = chain.space;
    for (auto& step : chain.joints) {
      step.before.p[2] = 0.3;
      if (!step.revolute) step.axis = random_unit(random);
    }
    ASSERT_TRUE(is_flat(chain));
    const VectorOf<double> v = random_variables(random, chain);
    const VectorOf<double> F = random_vector(random, chain.dimension(), 2.0);
    Closure<double> general, flat;
    evaluate_closure<double>(chain, v, &F, general);
    chain.flat = true;
    evaluate_closure<double>(chain, v, &F, flat);
    EXPECT_LT((flat.e - general.e).norm(), 2e-14) << trial;
    if (v.size() == 0) continue;
    EXPECT_LT((flat.J - general.J).norm(), 2e-14) << trial;
    EXPECT_LT((flat.H - general.H).norm(), 5e-14) << trial;
  }
}

TEST(FlatClosure, IsNotForChainsThatLeaveThePlane) {
  std::mt19937 random(11);
  const CompiledChain chain = random_chain(random, TaskSpace::planar, true, true, 3);
  EXPECT_TRUE(is_flat(chain));
  const auto with = [&](const auto& change) {
    CompiledChain other = chain;
    change(other);
    return is_flat(other);
  };
  const Mat3<double> tilted = rotation_about(Vec3<double>::UnitX(), 1e-9);
  EXPECT_FALSE(with([&](CompiledChain& c) { c.last.R = tilted; }));
  EXPECT_FALSE(with([&](CompiledChain& c) { c.to_attachment.R = tilted; }));
  EXPECT_FALSE(with([&](CompiledChain& c) { c.joints[1].before.R = tilted; }));
  EXPECT_FALSE(with([&](CompiledChain& c) { c.from_space = TaskSpace::spatial; }));
  EXPECT_FALSE(with([&](CompiledChain& c) { c.space = TaskSpace::xyz; }));
  EXPECT_FALSE(with([&](CompiledChain& c) {
    c.joints[0].revolute = true;
    c.joints[0].axis = Vec3<double>::UnitX();
  }));
}

/// Ends in different task spaces: a point on a plate, a planar body in a spatial mechanism.
TEST(ClosureBetweenTaskSpaces, HasExactDerivatives) {
  constexpr TaskSpace spaces[] = {TaskSpace::xy, TaskSpace::planar, TaskSpace::xyz,
                                  TaskSpace::spatial};
  std::mt19937 random(9);
  for (int trial = 0; trial < 400; ++trial) {
    const TaskSpace from = spaces[trial % 4], to = spaces[trial / 4 % 4];
    Mechanism m;
    m.bodies = {{"a", from, Vector::Zero(dimension(from))}, {"b", to, Vector::Zero(dimension(to))}};
    m.chains = {{.name = "c", .from = 1, .to = 2, .elements = {RigidLink{}}}};
    const TaskSpace space = compile(m, m.chains[0]).space;
    // A planar closure is one of planar chains.
    CompiledChain chain = random_chain(
        random, space == TaskSpace::planar ? space : TaskSpace::spatial, true, true, trial % 4);
    chain.space = space;
    chain.from_space = from;
    chain.to_space = to;
    const VectorOf<double> v = random_variables(random, chain);
    const VectorOf<double> F = random_vector(random, chain.dimension(), 2.0);
    Closure<double> at;
    evaluate_closure<double>(chain, v, &F, at);
    for (Index j = 0; j < v.size(); ++j) {
      VectorOf<Complex> w = v.cast<Complex>();
      w[j] += Complex(0, tiny);
      Closure<Complex> moved;
      evaluate_closure<Complex>(chain, w, nullptr, moved);
      EXPECT_LT((moved.e.imag() / tiny - at.J.col(j)).norm(), 1e-10 * (1 + at.J.norm()));
      const Matrix J_rate = moved.J.imag() / tiny;
      EXPECT_LT((J_rate.transpose() * F - at.H.col(j)).norm(), 1e-10 * (1 + at.H.norm()))
          << "trial " << trial << ", variable " << j;
    }
  }
}

TEST(ClosureBetweenTaskSpaces, HoldsAPointAsAPointAndBodiesOfBothKindsAsBodiesInSpace) {
  const auto closes_in = [](TaskSpace from, TaskSpace to) {
    Mechanism m;
    m.bodies = {{"a", from, Vector::Zero(dimension(from))}, {"b", to, Vector::Zero(dimension(to))}};
    return task_space_of(m, {.name = "c", .from = 1, .to = 2});
  };
  EXPECT_EQ(closes_in(TaskSpace::xy, TaskSpace::planar), TaskSpace::xy);
  EXPECT_EQ(closes_in(TaskSpace::planar, TaskSpace::xyz), TaskSpace::xyz);
  EXPECT_EQ(closes_in(TaskSpace::spatial, TaskSpace::xy), TaskSpace::xyz);
  EXPECT_EQ(closes_in(TaskSpace::planar, TaskSpace::spatial), TaskSpace::spatial);
  EXPECT_EQ(closes_in(TaskSpace::planar, TaskSpace::planar), TaskSpace::planar);
}

INSTANTIATE_TEST_SUITE_P(AllTaskSpaces, ClosureDerivatives,
                         testing::Values(ChainShape{TaskSpace::xy, false, true},
                                         ChainShape{TaskSpace::xy, true, false},
                                         ChainShape{TaskSpace::xy, true, true},
                                         ChainShape{TaskSpace::planar, false, true},
                                         ChainShape{TaskSpace::planar, true, false},
                                         ChainShape{TaskSpace::planar, true, true},
                                         ChainShape{TaskSpace::xyz, false, true},
                                         ChainShape{TaskSpace::xyz, true, true},
                                         ChainShape{TaskSpace::spatial, false, true},
                                         ChainShape{TaskSpace::spatial, true, false},
                                         ChainShape{TaskSpace::spatial, true, true}));

TEST(Closure, IsZeroWhereTheChainEndsOnTheBody) {
  std::mt19937 random(9);
  for (const TaskSpace space : {TaskSpace::xyz, TaskSpace::spatial}) {
    CompiledChain chain = random_chain(random, space, false, true, 4);
    chain.to_attachment = Pose<double>{};
    VectorOf<double> v = random_variables(random, chain);
    Closure<double> at;
    v.tail(chain.dimension()).setZero();
    evaluate_closure<double>(chain, v, nullptr, at);
    v.tail(chain.dimension()) = at.e;  // the gap to a body at the origin is the chain's end pose
    evaluate_closure<double>(chain, v, nullptr, at);
    EXPECT_LT(at.e.norm(), 1e-14);
  }
}

TEST(RotationVector, LogarithmUndoesTheExponentialUpToPi) {
  std::mt19937 random(10);
  for (int trial = 0; trial < 1000; ++trial) {
    const double angle = trial % 4 == 0 ? 3.14159 : std::pow(10.0, -trial % 9);
    const Vec3<double> phi = angle * random_unit(random);
    EXPECT_LT((log_rotation<double>(exp_rotation<double>(phi)) - phi).norm(), 1e-13)
        << "angle " << angle;
  }
}

TEST(RotationVector, InverseJacobianInvertsTheJacobian) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3<double> phi = random_vector(random, 1, 6.0)[0] * random_unit(random);
    const Mat3<double> product = inverse_left_jacobian<double>(phi) * left_jacobian<double>(phi);
    EXPECT_LT((product - Mat3<double>::Identity()).norm(), 1e-12) << phi.transpose();
  }
}

}  // namespace
}  // namespace springfold::model
