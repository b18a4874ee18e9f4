// Stability is counted, not guessed: indices against eigenvalues of the reduced Hessian.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <set>

#include "equilibria.hpp"
#include "springfold/statics/stiffness.hpp"

namespace springfold::statics {
namespace {

/// Negative eigenvalues of the Hessian on the motions that the closures allow, Z^T H Z.
Index unstable_motions(const Matrix& A, const std::vector<Index>& coordinates,
                       const std::vector<Index>& wrenches) {
  const Matrix H = A(coordinates, coordinates), C = A(wrenches, coordinates);
  const Eigen::FullPivLU<Matrix> lu(C);
  if (lu.dimensionOfKernel() == 0) return 0;
  const Matrix Z = lu.kernel();
  const Matrix reduced = Z.transpose() * H * Z;
  return (Eigen::SelfAdjointEigenSolver<Matrix>(reduced).eigenvalues().array() < 0).count();
}

struct Split {
  std::vector<Index> coordinates{}, poses{}, wrenches{};
};

Split split_of(const System& system) {
  Split split;
  for (Index i = 0; i < system.size; ++i) {
    if (system.is_wrench[static_cast<std::size_t>(i)])
      split.wrenches.push_back(i);
    else
      (i < system.first_pose ? split.coordinates : split.poses).push_back(i);
  }
  return split;
}

class Indices : public testing::TestWithParam<TaskSpace> {};
INSTANTIATE_TEST_SUITE_P(AllTaskSpaces, Indices,
                         testing::Values(TaskSpace::xy, TaskSpace::planar, TaskSpace::xyz,
                                         TaskSpace::spatial));

TEST_P(Indices, CountTheUnstableMotions) {
  std::mt19937 random(81);
  std::set<Index> pose_indices, force_indices;
  for (int trial = 0; trial < 120; ++trial) {
    const ChainShape shape = GetParam() == TaskSpace::spatial ? ChainShape{1, 7} : ChainShape{1, 4};
    const double load = std::pow(4.0, trial % 5) - 1;  // from none to far beyond buckling
    State state = random_equilibrium(random, GetParam(), 2 + trial % 2, shape, load);
    if (GetParam() == TaskSpace::spatial) state.inputs.W.tail(3).setZero();
    const Matrix A = evaluate(state).A;
    const Split split = split_of(state.system);
    std::vector<Index> all = split.coordinates;
    all.insert(all.end(), split.poses.begin(), split.poses.end());

    const Stability counted = stability(state.system, A);
    EXPECT_EQ(counted.pose_controlled, unstable_motions(A, split.coordinates, split.wrenches));
    EXPECT_EQ(counted.force_controlled, unstable_motions(A, all, split.wrenches));
    pose_indices.insert(counted.pose_controlled.value_or(-1));
    force_indices.insert(counted.force_controlled.value_or(-1));
  }
  EXPECT_GE(pose_indices.size(), 2u) << "the test needs stable and unstable states";
  EXPECT_GE(force_indices.size(), 3u);
}

TEST_P(Indices, AreTheSameWhenTheChainsAreCondensedOneByOne) {
  std::mt19937 random(83);
  for (int trial = 0; trial < 120; ++trial) {
    const ChainShape shape = GetParam() == TaskSpace::spatial ? ChainShape{1, 7} : ChainShape{1, 4};
    const double load = std::pow(4.0, trial % 5) - 1;
    State state = random_equilibrium(random, GetParam(), 2 + trial % 2, shape, load);
    if (GetParam() == TaskSpace::spatial) state.inputs.W.tail(3).setZero();
    const Matrix A = evaluate(state).A;
    const Condensed together = condense(state.system, A);
    const Stability counted = stability(state.system, A);
    EXPECT_EQ(together.stability.pose_controlled, counted.pose_controlled) << "trial " << trial;
    EXPECT_EQ(together.stability.force_controlled, counted.force_controlled) << "trial " << trial;
    const PlatformStiffness platform = platform_stiffness(state.system, A);
    ASSERT_EQ(together.platform.K.size(), platform.K.size());
    EXPECT_LE((together.platform.K - platform.K).norm(), 1e-12 * platform.K.norm());
  }
}

TEST_P(Indices, AddUpOverChainsAndPlatform) {
  // Haynsworth: force-controlled = pose-controlled + negative eigenvalues of the platform stiffness.
  std::mt19937 random(82);
  for (int trial = 0; trial < 60; ++trial) {
    const ChainShape shape = GetParam() == TaskSpace::spatial ? ChainShape{1, 7} : ChainShape{1, 4};
    State state = random_equilibrium(random, GetParam(), 2, shape, trial % 8);
    if (GetParam() == TaskSpace::spatial) state.inputs.W.tail(3).setZero();
    const Matrix A = evaluate(state).A;
    const Stability counted = stability(state.system, A);
    const PlatformStiffness platform = platform_stiffness(state.system, A);
    ASSERT_TRUE(counted.pose_controlled && counted.force_controlled);
    ASSERT_GT(platform.K.size(), 0);
    const Index soft = (platform.eigenvalues.array() < 0).count();
    EXPECT_EQ(*counted.force_controlled, *counted.pose_controlled + soft) << "trial " << trial;
  }
}

/// n links of length 1 in a row along x on hinges with springs of stiffness 1, pushed by P.
State column(int links, double P) {
  model::Mechanism m;
  m.bodies = {{"tip", TaskSpace::xy, Vector{{double(links), 0}}}};
  model::Chain chain{.name = "column"};
  for (int i = 0; i < links; ++i) {
    chain.elements.push_back(model::Joint{.name = "hinge" + std::to_string(i),
                                          .role = model::JointRole::compliant,
                                          .spring = model::LinearSpring{1, 0}});
    chain.elements.push_back(
        model::RigidLink{{model::Mat3<double>::Identity(), model::Vec3<double>::UnitX()}});
  }
  m.chains = {chain};
  State state{.system = prepare(m)};
  state.z = guess(state.system);
  state.inputs = {Vector(0), Vector{{-P, 0}}};
  state.z.segment(state.system.chain_slices[0].F, 2) = state.inputs.W;
  return state;
}

TEST(Indices, OfAClampedColumnGrowByOneAtEachCriticalLoad) {
  // P_j = 4 sin^2((2j - 1) pi / (2 (2N + 1))) for N links and equal springs, the base included.
  const int N = 5;
  const auto critical = [](int j) {
    const double sine = std::sin((2 * j - 1) * std::acos(-1.0) / (2 * (2 * N + 1)));
    return 4 * sine * sine;
  };
  for (int j = 1; j <= N; ++j)
    for (const double side : {-1e-9, 1e-9}) {
      const State state = column(N, critical(j) + side);
      ASSERT_LT(residual_at(state, {}).norm(), 1e-14);
      const Stability counted = stability(state.system, evaluate(state).A);
      EXPECT_EQ(counted.force_controlled, side < 0 ? j - 1 : j) << "load " << j;
    }
}

TEST(Indices, SeeAChainBuckleBetweenHeldEnds) {
  // Two links of length 1, hinged at both held ends, one spring k = 1 between them: P = 2 k.
  for (const double P : {2 - 1e-9, 2 + 1e-9}) {
    State state = column(2, P);
    auto& base = std::get<model::Joint>(state.system.mechanism.chains[0].elements[0]);
    base.role = model::JointRole::passive;
    base.spring.reset();
    state.system = prepare(state.system.mechanism);
    const Stability counted = stability(state.system, evaluate(state).A);
    EXPECT_EQ(counted.pose_controlled, P < 2 ? 0 : 1) << "P = " << P;
  }
}

TEST(Indices, AreEmptyInACriticalState) {
  const State state = column(1, 1);  // k / l = 1: an eigenvalue is zero
  const Stability counted = stability(state.system, evaluate(state).A);
  EXPECT_FALSE(counted.force_controlled.has_value());
  EXPECT_FALSE(condense(state.system, evaluate(state).A).stability.force_controlled.has_value());
  EXPECT_FALSE(unstable_modes(Matrix::Zero(2, 2), 0).has_value());
}

TEST(Indices, DoNotCountDependentClosuresAsUnstable) {
  // A single hinge cannot follow a plane body: two of the chain's three closures are dependent.
  model::Mechanism m;
  m.bodies = {{"plate", TaskSpace::planar, Vector::Zero(3)}};
  m.chains = {{.name = "pin",
               .elements = {model::Joint{.name = "hinge",
                                         .role = model::JointRole::preloaded,
                                         .spring = model::LinearSpring{2, 0}}}}};
  const State state{prepare(m), Vector::Zero(7), {Vector(0), Vector::Zero(3)}};
  const Matrix A = evaluate(state).A;
  const Stability counted = stability(state.system, A);
  EXPECT_EQ(counted.pose_controlled, 0);
  EXPECT_EQ(counted.force_controlled, 0);
  const PlatformStiffness platform = platform_stiffness(state.system, A);
  EXPECT_EQ(platform.K.size(), 0);
  ASSERT_EQ(platform.eigenvalues.size(), 3);
  EXPECT_NEAR(platform.eigenvalues[0], 2, 1e-14);
  EXPECT_EQ(platform.eigenvalues[1], std::numeric_limits<double>::infinity());
  EXPECT_EQ(platform.eigenvalues[2], std::numeric_limits<double>::infinity());
}

TEST(Indices, StiffnessOfALooseMechanismIsUnknown) {
  // The same pin beside a second one: the mechanism's closures are dependent as a whole.
  model::Mechanism m;
  m.bodies = {{"plate", TaskSpace::planar, Vector::Zero(3)}};
  for (const char* name : {"pin", "other pin"})
    m.chains.push_back({.name = name, .elements = {model::Joint{.name = "hinge"}}});
  const State state{prepare(m), Vector::Zero(11), {Vector(0), Vector::Zero(3)}};
  const Matrix A = evaluate(state).A;
  EXPECT_EQ(platform_stiffness(state.system, A).eigenvalues.size(), 0);
  EXPECT_FALSE(stability(state.system, A).force_controlled.has_value());
}

}  // namespace
}  // namespace springfold::statics
