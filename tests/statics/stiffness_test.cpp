// Stiffness matrices: paper eq. (12) two ways, condensed against full, and against equilibria that
// are solved anew beside the first.
#include "springfold/statics/stiffness.hpp"

#include <gtest/gtest.h>

#include "equilibria.hpp"
#include "springfold/core/differences.hpp"

namespace springfold::statics {
namespace {

ChainShape shape_for(TaskSpace space) {
  return space == TaskSpace::xy        ? ChainShape{1, 2}
         : space == TaskSpace::spatial ? ChainShape{2, 6}
                                       : ChainShape{1, 3};
}

class Stiffness : public testing::TestWithParam<TaskSpace> {
 protected:
  std::mt19937 random{71};
  State random_loaded(double load) {
    return random_equilibrium(random, GetParam(), 2, shape_for(GetParam()), load);
  }
};
INSTANTIATE_TEST_SUITE_P(AllTaskSpaces, Stiffness,
                         testing::Values(TaskSpace::xy, TaskSpace::planar, TaskSpace::xyz,
                                         TaskSpace::spatial));

/// Generalised forces of unit wrenches: what a load puts on the right side.
Matrix unit_loads(const State& state) {
  return -load_columns(state.system, state.z)
              .middleRows(state.system.first_pose, state.system.load_size);
}

/// Short enough for differences, however soft the mechanism is.
double difference_step(const Matrix& A) { return 0x1p-7 / A.inverse().norm(); }

TEST_P(Stiffness, RandomEquilibriaAreInBalance) {
  for (int trial = 0; trial < 20; ++trial) {
    const State state = random_loaded(1);
    EXPECT_LT(residual_at(state, state.piece()).lpNorm<Eigen::Infinity>(), 1e-12);
  }
}

TEST_P(Stiffness, IsTheForceThatDisplacedEquilibriaNeed) {
  for (int trial = 0; trial < 10; ++trial) {
    const State state = random_loaded(0.3);
    const Matrix A = evaluate(state).A;
    const PlatformStiffness platform = platform_stiffness(state.system, A);
    const Index t = state.system.first_pose, n = state.system.load_size;
    ASSERT_EQ(platform.K.rows(), n);
    const double h = difference_step(A.topLeftCorner(t, t));
    Matrix K(n, n);
    for (Index j = 0; j < n; ++j) {
      const auto held_at = [&](double value) -> std::optional<Vector> {
        State moved = state;
        moved.z[t + j] = value;
        if (!solve(moved, indices(0, t))) return std::nullopt;
        return Vector(residual_at(moved, moved.piece()).segment(t, n));
      };
      const auto column = six_point_derivative(held_at, state.z[t + j], h);
      ASSERT_TRUE(column.has_value()) << "trial " << trial;
      K.col(j) = *column;
    }
    // External moments in space are not symmetric in pose coordinates: K is the symmetric part.
    const Matrix symmetric = 0.5 * (K + K.transpose());
    EXPECT_LT((symmetric - platform.K).norm(), 1e-7 * platform.K.norm()) << "trial " << trial;
    if (GetParam() == TaskSpace::spatial) continue;
    EXPECT_LT((K - platform.K).norm(), 1e-7 * platform.K.norm()) << "trial " << trial;
  }
}

TEST_P(Stiffness, IsTheInverseOfTheDisplacementsUnderLoads) {
  for (int trial = 0; trial < 10; ++trial) {
    State state = random_loaded(0.3);
    if (GetParam() == TaskSpace::spatial) {  // without moments: see above
      state.inputs.W.tail(3).setZero();
      if (!solve(state)) continue;
    }
    const Matrix A = evaluate(state).A;
    const PlatformStiffness platform = platform_stiffness(state.system, A);
    const Index t = state.system.first_pose, n = state.system.load_size;
    ASSERT_EQ(platform.K.rows(), n);
    const double h = difference_step(A);
    Matrix C(n, n);
    for (Index j = 0; j < n; ++j) {
      const auto loaded_by = [&](double value) -> std::optional<Vector> {
        State moved = state;
        moved.inputs.W[j] = value;
        if (!solve(moved)) return std::nullopt;
        return Vector(moved.z.segment(t, n));
      };
      const auto column = six_point_derivative(loaded_by, state.inputs.W[j], h);
      ASSERT_TRUE(column.has_value()) << "trial " << trial;
      C.col(j) = *column;
    }
    const Matrix loads = unit_loads(state);
    EXPECT_LT((platform.K * C - loads).norm(), 1e-7 * platform.K.norm() * C.norm())
        << "trial " << trial;
  }
}

TEST_P(Stiffness, CondensedAndFullSolvesAgree) {
  for (int trial = 0; trial < 30; ++trial) {
    State state = random_loaded(1);
    if (GetParam() == TaskSpace::spatial) state.inputs.W.tail(3).setZero();
    const Evaluated at = evaluate(state);
    const PlatformStiffness platform = platform_stiffness(state.system, at.A);
    const Index t = state.system.first_pose, n = state.system.load_size;
    Matrix right = Matrix::Zero(state.system.size, n);
    right.middleRows(t, n) = unit_loads(state);
    const Matrix full = at.A.partialPivLu().solve(right).middleRows(t, n);
    const Matrix condensed = platform.K.partialPivLu().solve(unit_loads(state));
    EXPECT_LT((full - condensed).norm(), 1e-10 * full.norm()) << "trial " << trial;
  }
}

TEST_P(Stiffness, OfThePlatformIsTheSumOverItsChains) {
  for (int trial = 0; trial < 30; ++trial) {
    State state = random_loaded(1);
    if (GetParam() == TaskSpace::spatial) state.inputs.W.tail(3).setZero();
    const Evaluated at = evaluate(state);
    Matrix sum = Matrix::Zero(state.system.load_size, state.system.load_size);
    for (std::size_t i = 0; i < state.system.chains.size(); ++i) {
      const auto K = chain_stiffness(state.system, i, at.A, at.work);
      ASSERT_TRUE(K.has_value());
      EXPECT_LT((*K - K->transpose()).norm(), 1e-9 * K->norm());
      sum += *K;
    }
    const PlatformStiffness platform = platform_stiffness(state.system, at.A);
    EXPECT_LT((sum - platform.K).norm(), 1e-11 * sum.norm()) << "trial " << trial;
    const Vector mu = platform.eigenvalues;
    EXPECT_TRUE(std::is_sorted(mu.begin(), mu.end()));
    EXPECT_NEAR(mu.sum(), platform.K.trace(), 1e-10 * platform.K.norm());
  }
}

// In space the paper's matrix is that of a twist; pose coordinates add a term of the moment.
class ChainStiffnessOf : public Stiffness {};
INSTANTIATE_TEST_SUITE_P(PlaneAndPoints, ChainStiffnessOf,
                         testing::Values(TaskSpace::xy, TaskSpace::planar, TaskSpace::xyz));

TEST_P(ChainStiffnessOf, ALoadedChainIsThePapersEquationTwelve) {
  for (int trial = 0; trial < 200; ++trial) {
    // Loaded hard, up to lost stability; attached at the body's origin, where both are given.
    model::Chain chain = random_elastic_chain(random, GetParam(), shape_for(GetParam()));
    chain.to_attachment = {};
    chain.name = "chain";
    model::Mechanism m;
    m.bodies = {{"tool", GetParam(), Vector::Zero(dimension(GetParam()))}};
    chain.from_attachment = inverse(shape_of(chain));
    m.chains = {chain};
    const State state = balanced(random, m, 2.0);
    const Evaluated at = evaluate(state);
    const auto by_kkt = chain_stiffness(state.system, 0, at.A, at.work);
    const auto by_paper =
        chain_stiffness_paper(state.system, 0, state.piece(), state.z, state.inputs);
    ASSERT_TRUE(by_kkt.has_value());
    ASSERT_TRUE(by_paper.has_value());
    EXPECT_LT((*by_kkt - *by_paper).norm(), 1e-10 * by_kkt->norm()) << "trial " << trial;
  }
}

TEST(ChainStiffness, LosesOneRankPerPassiveJoint) {
  std::mt19937 random(72);
  for (int trial = 0; trial < 20; ++trial) {
    const State state = random_equilibrium(random, TaskSpace::planar, 2, {1, 3}, 0);
    const Evaluated at = evaluate(state);
    const auto K = chain_stiffness(state.system, 0, at.A, at.work);
    ASSERT_TRUE(K.has_value());
    Eigen::FullPivLU<Matrix> lu(*K);
    lu.setThreshold(1e-10);
    EXPECT_EQ(lu.rank(), 2);
  }
}

TEST(ChainStiffness, DoesNotDependOnTheDirectionInWhichTheChainIsWalked) {
  std::mt19937 random(73);
  for (int trial = 0; trial < 20; ++trial) {
    const State state = random_equilibrium(random, TaskSpace::planar, 2, {1, 3}, 1);
    model::Mechanism m = state.system.mechanism;
    model::Chain& chain = m.chains[0];
    std::swap(chain.from, chain.to);
    std::swap(chain.from_attachment, chain.to_attachment);
    std::reverse(chain.elements.begin(), chain.elements.end());
    for (model::Element& element : chain.elements) {
      if (auto* link = std::get_if<model::RigidLink>(&element))
        link->transform = inverse(link->transform);
      else
        std::get<model::Joint>(element).axis *= -1;
    }
    State walked{.system = prepare(m), .inputs = state.inputs};
    walked.inputs.rho = walked.system.commands;
    walked.z = guess(walked.system);
    // Its coordinates and commands stand in the opposite order. Its wrench is the opposite one, and
    // acts at the other end.
    for (const ChainSlice& s : walked.system.chain_slices)
      walked.z.segment(s.F, s.F_count) = state.z.segment(s.F, s.F_count);
    const ChainSlice& s = walked.system.chain_slices[0];
    auto F = walked.z.segment(s.F, 3);
    const model::Vec3<double> arm =
        model::rotation_about<double>(model::Vec3<double>::UnitZ(), state.z.tail(3)[2]) *
            chain.from_attachment.p +
        model::Vec3<double>(state.z.tail(3)[0], state.z.tail(3)[1], 0) - chain.to_attachment.p;
    F[2] += arm[0] * F[1] - arm[1] * F[0];
    F *= -1;
    ASSERT_LT(residual_at(walked, walked.piece()).norm(), 1e-11) << "trial " << trial;
    const Evaluated a = evaluate(state), b = evaluate(walked);
    const auto K = chain_stiffness(state.system, 0, a.A, a.work);
    const auto K_walked = chain_stiffness(walked.system, 0, b.A, b.work);
    ASSERT_TRUE(K && K_walked);
    EXPECT_LT((*K - *K_walked).norm(), 1e-10 * K->norm()) << "trial " << trial;
  }
}

TEST(ChainStiffness, IsNotDefinedForARigidChain) {
  model::Mechanism m;
  m.bodies = {{"tool", TaskSpace::xy, Vector::Zero(2)}};
  m.chains = {{.name = "rod", .elements = {model::Joint{.name = "hinge"}}}};
  const State state{prepare(m), Vector::Zero(5), {Vector(0), Vector::Zero(2)}};
  const Evaluated at = evaluate(state);
  EXPECT_FALSE(chain_stiffness(state.system, 0, at.A, at.work).has_value());
  EXPECT_FALSE(chain_stiffness_paper(state.system, 0, {}, state.z, state.inputs).has_value());
}

TEST(ChainStiffness, IsNotDefinedForAChainWithoutJoints) {
  model::Mechanism m;
  m.bodies = {{"tool", TaskSpace::xy, Vector::Zero(2)}};
  m.chains = {{.name = "weld", .elements = {model::RigidLink{}}}};
  const State state{prepare(m), Vector::Zero(4), {Vector(0), Vector::Zero(2)}};
  const Evaluated at = evaluate(state);
  EXPECT_FALSE(chain_stiffness(state.system, 0, at.A, at.work).has_value());
  EXPECT_FALSE(chain_stiffness_paper(state.system, 0, {}, state.z, state.inputs).has_value());
  const Stability counted = stability(state.system, at.A);
  EXPECT_EQ(counted.pose_controlled, 0);
  EXPECT_EQ(counted.force_controlled, 0);
}

TEST(WorldStiffness, DoesNotDependOnTheFrameThatTheBodyIsGiven) {
  std::mt19937 random(74);
  int compared = 0;
  for (int trial = 0; trial < 20; ++trial) {
    State state = random_equilibrium(random, TaskSpace::spatial, 2, {1, 7}, 0.2);
    state.inputs.W.tail(3).setZero();
    if (!solve(state)) continue;
    // The same body with its frame turned by Q about its origin.
    const auto Q = random_pose(random, false).R;
    State turned = state;
    for (model::Chain& chain : turned.system.mechanism.chains) {
      chain.to_attachment.R = Q.transpose() * chain.to_attachment.R;
      chain.to_attachment.p = Q.transpose() * chain.to_attachment.p;
    }
    turned.system = prepare(turned.system.mechanism);
    auto phi = turned.z.tail(3);
    phi = model::log_rotation<double>(model::exp_rotation<double>(model::Vec3<double>(phi)) * Q);
    ASSERT_LT(residual_at(turned, turned.piece()).norm(), 1e-11);
    const auto world = [](const State& s) {
      return in_world_axes(s.system, s.z, platform_stiffness(s.system, evaluate(s).A).K);
    };
    EXPECT_LT((world(state) - world(turned)).norm(), 1e-9 * world(state).norm());
    ++compared;
  }
  EXPECT_GE(compared, 10);
}

}  // namespace
}  // namespace springfold::statics
