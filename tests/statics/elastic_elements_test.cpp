// 6x6 springs: gradient and matrix, loaded stiffness in space, and published and closed-form answers.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "equilibria.hpp"
#include "examples.hpp"
#include "springfold/core/differences.hpp"
#include "springfold/model/elastic_link.hpp"

namespace springfold::statics {
namespace {

using enum model::ElasticDirection;
const std::vector<model::ElasticDirection> all_six{Tx, Ty, Tz, Rx, Ry, Rz};

Matrix random_stiffness(std::mt19937& random, Index m) {
  Matrix B(m, m);
  for (Index i = 0; i < m; ++i) B.col(i) = random_vector(random, m, 1);
  Matrix K = B * B.transpose() + 0.3 * Matrix::Identity(m, m);
  return 0.5 * (K + K.transpose());
}

/// A body on two elastic legs with a passive joint each and a random 6x6 spring, closed unloaded.
State random_platform(std::mt19937& random) {
  model::Mechanism m;
  m.bodies = {{"tool", TaskSpace::spatial, random_vector(random, 6, 1.0)}};
  const model::Pose<double> body =
      real_part(frame_of_body(TaskSpace::spatial, m.bodies[0].pose.cast<Complex>()));
  for (int i = 0; i < 3; ++i) {
    model::Chain chain{.name = "leg" + std::to_string(i)};
    chain.to_attachment = random_pose(random, false);
    chain.elements = {model::RigidLink{random_pose(random, false)},
                      model::Joint{.name = "foot", .axis = random_unit(random)}};
    add_elastic_link(chain, "link", 0.8, all_six, random_stiffness(random, 6),
                     random_vector(random, 6, 0.3), Vector::Zero(6));
    // Stress-free where it stands.
    Vector& free = chain.coupled_springs[0].free;
    for (std::size_t k = 0; k < 6; ++k)
      free[static_cast<Index>(k)] =
          std::get<model::Joint>(chain.elements[chain.coupled_springs[0].elements[k]]).initial;
    chain.from_attachment = body * chain.to_attachment * inverse(shape_of(chain));
    m.chains.push_back(chain);
  }
  State state{.system = prepare(m)};
  state.z = guess(state.system);
  state.inputs = {Vector(0), Vector::Zero(6)};
  return state;
}

/// Under a force at the tool's origin, followed from the unloaded state.
std::optional<State> loaded(State state, const Vec3& force) {
  for (int step = 1; step <= 8; ++step) {
    state.inputs.W.head(3) = force * (step / 8.0);
    if (!solve(state)) return std::nullopt;
  }
  return state;
}

TEST(ElasticElements, ResidualIsTheGradientOfTheLagrangian) {
  std::mt19937 random(51);
  for (int trial = 0; trial < 50; ++trial) {
    State state = random_platform(random);
    state.z += random_vector(random, state.system.size, 0.3);
    const Vector expected =
        gradient_of_lagrangian(state.system.mechanism, state.z, state.inputs.rho, state.inputs.W);
    EXPECT_LT((residual_at(state, state.piece()) - expected).norm(), 1e-12 * (1 + expected.norm()));
    const Complex L = lagrangian(state.system.mechanism, state.z.cast<Complex>(), state.inputs.rho,
                                 state.inputs.W);
    State without = state;
    for (const ChainSlice& s : state.system.chain_slices)
      without.z.segment(s.F, s.F_count).setZero();
    const Complex energy = lagrangian(state.system.mechanism, without.z.cast<Complex>(),
                                      state.inputs.rho, state.inputs.W);
    EXPECT_NEAR(spring_energy(state.system, state.z), energy.real(), 1e-13 * (1 + std::abs(L)));
  }
}

TEST(ElasticElements, MatrixIsTheDerivativeOfTheResidualAndSymmetric) {
  std::mt19937 random(52);
  for (int trial = 0; trial < 20; ++trial) {
    State state = random_platform(random);
    state.z += random_vector(random, state.system.size, 0.3);
    const Matrix A = evaluate(state).A;
    EXPECT_LT((A - A.transpose()).norm(), 1e-12 * A.norm());
    for (Index j = 0; j < state.system.size; ++j) {
      const auto along = [&](double value) -> std::optional<Vector> {
        State moved = state;
        moved.z[j] = value;
        return residual_at(moved, moved.piece());
      };
      const auto column = six_point_derivative(along, state.z[j], 0x1p-7);
      EXPECT_LT((*column - A.col(j)).norm(), 1e-10 * A.norm());
    }
  }
}

// The laws that every loaded stiffness matrix of a conservative system obeys.
TEST(LoadedSpatialStiffness, IsSymmetricAndThatOfDifferencedEquilibria) {
  std::mt19937 random(53);
  int compared = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const Vector load = random_vector(random, 3, 0.2);
    const auto state = loaded(random_platform(random), load);
    if (!state) continue;
    ++compared;
    const Matrix A = evaluate(*state).A;
    Matrix condensed = A.bottomRightCorner(6, 6);
    const Index n = A.rows() - 6;
    condensed -= A.bottomLeftCorner(6, n) *
                 A.topLeftCorner(n, n).partialPivLu().solve(A.topRightCorner(n, 6));
    EXPECT_LT((condensed - condensed.transpose()).norm(), 1e-10 * condensed.norm());
    const Matrix K = platform_stiffness(state->system, A).K;
    EXPECT_LT((K - condensed).norm(), 1e-10 * K.norm());
    // Equilibria beside it under changed forces: K dt = dW.
    for (Index j = 0; j < 3; ++j) {
      const auto pose_at = [&](double force) -> std::optional<Vector> {
        State moved = *state;
        moved.inputs.W[j] = force;
        if (!solve(moved)) return std::nullopt;
        return Vector(moved.z.tail(6));
      };
      const auto rate = six_point_derivative(pose_at, state->inputs.W[j], 0x1p-8 * K.norm() * 0.01);
      ASSERT_TRUE(rate);
      EXPECT_LT((K * *rate - Vector::Unit(6, j)).norm(), 1e-6);
    }
  }
  EXPECT_GE(compared, 8);
}

TEST(LoadedSpatialStiffness, TurnsWithTheBaseAndKnowsNoOrigin) {
  std::mt19937 random(54);
  int compared = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const State unloaded = random_platform(random);
    const Vec3 force = random_vector(random, 3, 0.2);
    const auto state = loaded(unloaded, force);
    if (!state) continue;
    ++compared;
    const model::Pose<double> move = random_pose(random, false);
    State other = unloaded;
    model::Mechanism m = unloaded.system.mechanism;
    for (model::Chain& chain : m.chains) chain.from_attachment = move * chain.from_attachment;
    const model::Pose<double> tool =
        move * model::Pose<double>{model::exp_rotation<double>(Vec3(m.bodies[0].pose.tail(3))),
                                   m.bodies[0].pose.head(3)};
    m.bodies[0].pose << tool.p, model::log_rotation<double>(tool.R);
    other.system = prepare(m);
    other.z = guess(other.system);
    const auto there = loaded(other, move.R * force);
    ASSERT_TRUE(there);
    const auto world = [](const State& s) {
      return in_world_axes(s.system, s.z, platform_stiffness(s.system, evaluate(s).A).K);
    };
    Matrix turn = Matrix::Zero(6, 6);
    turn.topLeftCorner(3, 3) = turn.bottomRightCorner(3, 3) = move.R;
    const Matrix K = world(*state);
    EXPECT_LT((world(*there) - turn * K * turn.transpose()).norm(), 1e-10 * K.norm());
  }
  EXPECT_GE(compared, 8);
}

TEST(ElasticElements, PapersEliminationAgreesWithTheFullMatrix) {
  std::mt19937 random(55);
  for (int trial = 0; trial < 12; ++trial) {
    const Vector load = random_vector(random, 3, 0.2);
    const auto state = loaded(random_platform(random), load);
    if (!state) continue;
    const Evaluated at = evaluate(*state);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto paper =
          chain_stiffness_paper(state->system, i, state->piece(), state->z, state->inputs);
      const ChainSlice& s = state->system.chain_slices[i];
      const Index n = s.x_count + s.F_count;
      const Matrix inverse = at.A.block(s.x, s.x, n, n).inverse();
      ASSERT_TRUE(paper);
      const Matrix K = -inverse.bottomRightCorner(6, 6);
      EXPECT_LT((*paper - K).norm(), 1e-9 * (1 + K.norm()));
    }
  }
}

TEST(ElasticElements, ThePapersIterationFindsTheSameWrench) {
  // A single elastic link between base and a body that is held displaced by a little.
  std::mt19937 random(56);
  model::Mechanism m;
  m.bodies = {{"tool", TaskSpace::spatial, Vector{{0.83, 0.02, -0.01, 0.05, -0.04, 0.03}}}};
  m.chains = {{.name = "leg"}};
  add_elastic_link(m.chains[0], "link", 0.8, all_six, random_stiffness(random, 6), Vector::Zero(6),
                   random_vector(random, 6, 0.02));
  const System system = prepare(m);
  StartProblem problem{.z = guess(system), .inputs = {system.commands, Vector::Zero(6)}};
  problem.unknowns = StartUnknowns::wrench;
  const FirstEquilibrium newton = first_equilibrium(system, problem);
  const FirstEquilibrium paper = first_equilibrium_paper(system, problem);
  ASSERT_EQ(newton.status, StartStatus::found);
  ASSERT_EQ(paper.status, StartStatus::found);
  EXPECT_LT((newton.inputs.W - paper.inputs.W).norm(), 1e-10);
}

/// An unloaded link's stiffness at its end is the matrix that it was given.
TEST(ElasticElements, HaveTheGivenStiffnessWhereTheyAreRelaxed) {
  std::mt19937 random(57);
  const Matrix K = random_stiffness(random, 6);
  model::Mechanism m;
  m.bodies = {{"tool", TaskSpace::spatial, Vector{{0.8, 0, 0, 0, 0, 0}}}};
  m.chains = {{.name = "leg"}};
  add_elastic_link(m.chains[0], "link", 0.8, all_six, K, Vector::Zero(6), Vector::Zero(6));
  const System system = prepare(m);
  const FirstEquilibrium found = free_equilibrium(system, Vector::Zero(6));
  ASSERT_EQ(found.status, StartStatus::found);
  EXPECT_LT((stiffness_at(system, found) - K).norm(), 1e-13 * K.norm());
}

/// Column along x, clamped at the origin, of N links; the tip is a point.
State column(int N, const Matrix& compliance_of_link) {
  model::Mechanism m;
  m.bodies = {{"tip", TaskSpace::xyz, Vector{{1, 0, 0}}}};
  m.chains = {{.name = "column"}};
  for (int i = 0; i < N; ++i)
    add_elastic_link(m.chains[0], "l" + std::to_string(i), 1.0 / N, all_six,
                     model::inverse_of(compliance_of_link), Vector::Zero(6), Vector::Zero(6));
  State state{.system = prepare(m)};
  state.z = guess(state.system);
  state.inputs = {Vector(0), Vector::Zero(3)};
  return state;
}

Index unstable_under(const State& unloaded, double P) {
  const auto state = loaded(unloaded, Vec3(-P, 0, 0));
  return *stability(state->system, evaluate(*state).A).force_controlled;
}

// Two links, EA -> infinity: P = 4p, p^2 + 3p - 3 = 0; with EIz = 2 EIy the two loads part.
TEST(FlexibleColumn, LosesTwoDirectionsAtTheClosedFormsLoad) {
  const model::BeamSection round{.A = 1e7, .Iy = 1, .Iz = 1, .J = 1};
  const State two = column(2, model::cantilever_compliance(0.5, 1, 1, round));
  const double P = 2 * (std::sqrt(21.0) - 3);
  EXPECT_EQ(unstable_under(two, P * (1 - 1e-6)), 0);
  EXPECT_EQ(unstable_under(two, P * (1 + 1e-6)), 2);

  const model::BeamSection flat{.A = 1e7, .Iy = 1, .Iz = 2, .J = 1};
  const State other = column(2, model::cantilever_compliance(0.5, 1, 1, flat));
  EXPECT_EQ(unstable_under(other, P * (1 - 1e-6)), 0);
  EXPECT_EQ(unstable_under(other, P * (1 + 1e-6)), 1);
  EXPECT_EQ(unstable_under(other, 2 * P * (1 - 1e-6)), 1);
  EXPECT_EQ(unstable_under(other, 2 * P * (1 + 1e-6)), 2);
}

TEST(FlexibleColumn, OfOneLinkNeverBuckles) {
  const model::BeamSection round{.A = 1e7, .Iy = 1, .Iz = 1, .J = 1};
  const State one = column(1, model::cantilever_compliance(1, 1, 1, round));
  EXPECT_EQ(unstable_under(one, 100), 0);
}

/// Links on the 45-degree arc of Bathe and Bolourchi (R = 100), E = 1e7, unit square, J = 2 I.
State bend(int N) {
  const double turn = degrees(45) / N, chord = 200 * std::sin(turn / 2), I = 1.0 / 12;
  const Matrix C = model::cantilever_compliance(chord, 1e7, 5e6, {1, I, I, 2 * I});
  model::Mechanism m;
  m.bodies = {{"tip", TaskSpace::xyz, Vector{{100 - 100 / std::sqrt(2), 100 / std::sqrt(2), 0}}}};
  m.chains = {{.name = "arc"}};
  m.chains[0].from_attachment.R =
      model::rotation_about<double>(Vec3::UnitZ(), degrees(90) - turn / 2);
  for (int i = 0; i < N; ++i) {
    add_elastic_link(m.chains[0], "l" + std::to_string(i), chord, all_six, model::inverse_of(C),
                     Vector::Zero(6), Vector::Zero(6));
    m.chains[0].elements.push_back(
        model::RigidLink{{model::rotation_about<double>(Vec3::UnitZ(), -turn), Vec3::Zero()}});
  }
  State state{.system = prepare(m)};
  state.z = guess(state.system);
  state.inputs = {Vector(0), Vector::Zero(3)};
  return state;
}

TEST(Bend45, DeflectsAsTheSameLinksSolvedASecondTime) {
  struct Row {
    int N;
    double force;
    Vec3 u;
  };
  for (const Row& row : {Row{2, 300, {-8.148079408, -8.443623971, 42.206234660}},
                         Row{2, 600, {-15.334196248, -18.508801816, 58.964951904}},
                         Row{4, 300, {-8.178282530, -10.755173870, 40.670609984}},
                         Row{4, 450, {-12.366003116, -16.999591645, 49.404923071}},
                         Row{4, 600, {-15.419209769, -21.986259589, 54.699243652}},
                         Row{16, 600, {-14.143625794, -23.314737594, 53.565819437}}}) {
    const State unloaded = bend(row.N);
    const auto state = loaded(unloaded, Vec3(0, 0, row.force));
    ASSERT_TRUE(state);
    const Vector u = state->z.tail(3) - unloaded.z.tail(3);
    EXPECT_LT((u - row.u).lpNorm<Eigen::Infinity>(), 1e-8) << row.N << " links";
  }
}

TEST(Bend45, GivesWayAtItsLoadedTipAsKnown) {
  const auto state = loaded(bend(4), Vec3(0, 0, 600));
  ASSERT_TRUE(state);
  const Matrix C = platform_stiffness(state->system, evaluate(*state).A).K.inverse();
  Matrix expected(3, 3);
  expected << 0.0857308439, -0.0106893972, -0.0172756708,  //
      -0.0106893972, 0.04859035, -0.0294582154,            //
      -0.0172756708, -0.0294582154, 0.0281119432;
  EXPECT_LT((C - expected).norm(), 1e-8);
}

// Error against the continuous rod halves with the length of the links.
TEST(Bend45, ConvergesToTheCurvedRod) {
  const Vec3 rod(-13.60396610, -23.55852790, 53.47176295);
  const auto error = [&rod](int N) {
    const State unloaded = bend(N);
    const auto state = loaded(unloaded, Vec3(0, 0, 600));
    return (state->z.tail(3) - unloaded.z.tail(3) - Vector(rod)).norm();
  };
  EXPECT_NEAR(error(16) / error(8), 0.5, 0.06);
}

}  // namespace
}  // namespace springfold::statics
