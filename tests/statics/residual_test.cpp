// The equilibrium equations against an independent Lagrangian, their matrix against differences.
#include <gtest/gtest.h>

#include <complex>

#include "equilibria.hpp"
#include "springfold/core/differences.hpp"

namespace springfold::statics {
namespace {

class EveryTaskSpace : public testing::TestWithParam<TaskSpace> {};
INSTANTIATE_TEST_SUITE_P(Statics, EveryTaskSpace,
                         testing::Values(TaskSpace::xy, TaskSpace::planar, TaskSpace::xyz,
                                         TaskSpace::spatial));

model::SpringLaw any_law(std::mt19937& random) {
  const auto number = [&random](double size) { return random_vector(random, 1, size)[0]; };
  switch (std::uniform_int_distribution<int>(0, 7)(random)) {
    case 0:
      return model::LinearSpring{1 + number(0.9), number(1)};
    case 1:
      return model::OneSidedSpring{1 + number(0.9), number(1), model::OneSidedSpring::Side::above};
    case 2:
      return model::OneSidedSpring{1 + number(0.9), number(1), model::OneSidedSpring::Side::below};
    case 3:
      return model::PolynomialSpring{{number(1), 1, number(1), 2}, number(1), {}, true};
    case 4:
      return model::LogarithmicSpring{2, 9, number(1)};
    case 5:
      return model::PowerSpring{3, 0.5, 3, number(1), number(1) > 0};
    case 6:
      return model::FormulaSpring{
          {{{model::FormulaStep::Operation::variable}, {model::FormulaStep::Operation::sinh, 0}}},
          number(1)};
    default:
      return model::PiecewiseLinearSpring{
          {-0.7, -0.1 + number(0.2), 0.6}, {3, 0, 0.5, 2}, number(1.5), number(1)};
  }
}

/// Near half a turn the closure's rotation jumps, and differences across that mean nothing.
bool near_half_turn(const State& state) {
  const TaskSpace space = state.system.mechanism.bodies[0].task_space;
  const Index angles = dimension(space) - translations(space);
  for (const model::Closure<double>& closure : evaluate(state).work.closures)
    if (closure.e.tail(angles).norm() > 3) return true;
  return false;
}

/// Two bodies and chains of every direction: base to body, body to base, body to body. Nothing is
/// closed, nothing in balance.
State random_state(std::mt19937& random, TaskSpace space) {
  model::Mechanism m;
  for (const char* name : {"first", "second"})
    m.bodies.push_back({name, space, Vector::Zero(dimension(space))});
  for (const auto& [from, to] : {std::pair{0, 1}, {1, 0}, {1, 2}, {2, 1}, {0, 2}}) {
    model::Chain chain = random_elastic_chain(random, space, {1, 3});
    chain.name = std::to_string(from) + " to " + std::to_string(to);
    chain.from = from;
    chain.to = to;
    chain.from_attachment =
        random_pose(random, dimension(space) == 2 || space == TaskSpace::planar);
    for (model::Element& element : chain.elements)
      if (auto* joint = std::get_if<model::Joint>(&element); joint && joint->spring)
        joint->spring = any_law(random);
    m.chains.push_back(chain);
  }
  State state{.system = prepare(m)};
  EXPECT_TRUE(problems_in(m).empty());
  do {
    state.z = random_vector(random, state.system.size, 1.2);
    state.inputs = {random_vector(random, state.system.commands.size(), 1.0),
                    random_vector(random, state.system.load_size, 1.0)};
  } while (near_half_turn(state));
  return state;
}

void remove_moments(State& state) {
  for (std::size_t b = 0; b < state.system.body_slices.size(); ++b)
    if (state.system.mechanism.bodies[b].task_space == TaskSpace::spatial)
      state.inputs.W.segment(state.system.body_slices[b].W + 3, 3).setZero();
}

TEST_P(EveryTaskSpace, ResidualIsTheGradientOfTheLagrangian) {
  std::mt19937 random(61);
  for (int trial = 0; trial < 30; ++trial) {
    State state = random_state(random, GetParam());
    remove_moments(state);
    const Vector gradient =
        gradient_of_lagrangian(state.system.mechanism, state.z, state.inputs.rho, state.inputs.W);
    const Vector residual = residual_at(state, state.piece());
    EXPECT_LT((residual - gradient).lpNorm<Eigen::Infinity>(), 1e-10) << "trial " << trial;
  }
}

TEST_P(EveryTaskSpace, EnergyIsTheLagrangianWithoutWrenches) {
  std::mt19937 random(62);
  for (int trial = 0; trial < 30; ++trial) {
    State state = random_state(random, GetParam());
    for (const ChainSlice& s : state.system.chain_slices) state.z.segment(s.F, s.F_count).setZero();
    const Vector none = Vector::Zero(state.system.load_size);
    const double L =
        lagrangian(state.system.mechanism, state.z.cast<Complex>(), state.inputs.rho, none).real();
    EXPECT_NEAR(spring_energy(state.system, state.z), L, 1e-12) << "trial " << trial;
  }
}

TEST_P(EveryTaskSpace, MatrixIsTheDerivativeOfTheResidual) {
  std::mt19937 random(63);
  for (int trial = 0; trial < 10; ++trial) {
    State state = random_state(random, GetParam());
    const Piece piece = state.piece();
    const Evaluated at = evaluate(state, piece);
    for (Index j = 0; j < state.system.size; ++j) {
      const auto along = [&](double value) -> std::optional<Vector> {
        State moved = state;
        moved.z[j] = value;
        return residual_at(moved, piece);
      };
      const Vector column = *six_point_derivative(along, state.z[j], 0x1p-8);
      EXPECT_LT((column - at.A.col(j)).lpNorm<Eigen::Infinity>(), 1e-9 * (1 + at.A.norm()))
          << "trial " << trial << ", "
          << state.system.coordinate_names[static_cast<std::size_t>(j)];
    }
  }
}

TEST_P(EveryTaskSpace, MatrixIsSymmetricWithoutExternalMomentsInSpace) {
  std::mt19937 random(64);
  for (int trial = 0; trial < 30; ++trial) {
    State state = random_state(random, GetParam());
    remove_moments(state);
    const Evaluated at = evaluate(state);
    EXPECT_LT((at.A - at.A.transpose()).lpNorm<Eigen::Infinity>(), 1e-12) << "trial " << trial;
  }
}

TEST_P(EveryTaskSpace, ResidualAndMatrixGiveTheSameResidual) {
  std::mt19937 random(65);
  const State state = random_state(random, GetParam());
  EXPECT_EQ(evaluate(state).residual, residual_at(state, state.piece()));
}

TEST_P(EveryTaskSpace, CommandColumnsAreTheDerivativeOfTheResidual) {
  std::mt19937 random(66);
  for (int trial = 0; trial < 10; ++trial) {
    State state = random_state(random, GetParam());
    const Piece piece = state.piece();
    const Evaluated at = evaluate(state, piece);
    ASSERT_EQ(at.dR_drho.cols(), state.inputs.rho.size());
    for (Index k = 0; k < state.inputs.rho.size(); ++k) {
      const auto along = [&](double value) -> std::optional<Vector> {
        State moved = state;
        moved.inputs.rho[k] = value;
        return residual_at(moved, piece);
      };
      const Vector column = *six_point_derivative(along, state.inputs.rho[k], 0x1p-8);
      EXPECT_LT((column - at.dR_drho.col(k)).lpNorm<Eigen::Infinity>(), 1e-9 * (1 + at.A.norm()))
          << "trial " << trial << ", " << state.system.command_names[static_cast<std::size_t>(k)];
    }
  }
}

TEST_P(EveryTaskSpace, LoadColumnsAreTheDerivativeOfTheResidual) {
  std::mt19937 random(67);
  for (int trial = 0; trial < 10; ++trial) {
    State state = random_state(random, GetParam());
    const Matrix columns = load_columns(state.system, state.z);
    State unloaded = state;
    unloaded.inputs.W.setZero();
    const Vector by_load = residual_at(state, state.piece()) - residual_at(unloaded, state.piece());
    EXPECT_LT((columns * state.inputs.W - by_load).lpNorm<Eigen::Infinity>(), 1e-13);
    Vector rate = Vector::Zero(state.system.size);
    add_wrench_rate(state.system, state.z, state.inputs.W, rate);
    EXPECT_LT((rate - by_load).lpNorm<Eigen::Infinity>(), 1e-13);
  }
}

TEST(SpatialMoments, DoWorkOnTheRotationOfTheBody) {
  // A moment m does the work m . omega, and omega of a rate of the rotation vector is the skew
  // part of R' R^T.
  std::mt19937 random(68);
  for (int trial = 0; trial < 50; ++trial) {
    const State state = random_state(random, TaskSpace::spatial);
    const Matrix columns = load_columns(state.system, state.z);
    for (const BodySlice& body : state.system.body_slices)
      for (Index j = 0; j < 3; ++j) {
        ComplexVector t = state.z.segment(body.t, 6).cast<Complex>();
        t[3 + j] += Complex(0, 1e-30);
        const Rotation R = frame_of_body(TaskSpace::spatial, t).topLeftCorner<3, 3>();
        const Eigen::Matrix3d spin = (R.imag() / 1e-30) * R.real().transpose();
        const Vector omega = Vector{{spin(2, 1), spin(0, 2), spin(1, 0)}};
        const Vector row = columns.row(body.t + 3 + j).segment(body.W + 3, 3);
        EXPECT_LT((row + omega).norm(), 1e-12) << "trial " << trial;
      }
  }
}

TEST(Residual, IsRefusedWhereItIsNotFinite) {
  std::mt19937 random(69);
  State state = random_state(random, TaskSpace::planar);
  state.z[0] = std::numeric_limits<double>::infinity();
  Workspace work;
  Vector r;
  Matrix A;
  const Piece piece = state.piece();
  EXPECT_FALSE(equilibrium_residual(state.system, piece, state.z, state.inputs, work, r));
  EXPECT_FALSE(equilibrium_matrix(state.system, piece, state.z, state.inputs, work, r, A));
}

}  // namespace
}  // namespace springfold::statics
