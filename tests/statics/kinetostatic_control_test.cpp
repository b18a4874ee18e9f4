// Inverse kinetostatics against closed forms, published numbers and forward solves.
#include "springfold/statics/kinetostatic_control.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <random>

#include "examples.hpp"

namespace springfold::statics {
namespace {

const double p = 0.454;

ControlResult commanded(const System& system, const Vector& target, const Vector& W,
                        ControlMethod method = ControlMethod::newton) {
  return kinetostatic_control(
      system,
      {.target = target, .W = W, .z = guess(system), .rho = system.commands, .method = method});
}

System orthoglide_system(const model::SpringLaw& knee) { return prepare(orthoglide(knee, 0, 0)); }

model::SpringLaw one_sided() {
  return model::OneSidedSpring{0.5, std::numbers::pi / 12, model::OneSidedSpring::Side::above};
}

struct Table1Row {
  double stiffness, rho_Q1, K_Q1, rho_Q2, K_Q2;
};

// Paper, Table 1, for p = 0.454 with 12 digits by the closed form of the diagonal.
const std::vector<Table1Row> table1{
    {0, 0.437001683500, 2.278707630609, 1.345001683500, 0.240552110109},
    {0.01, 0.433497973681, 2.289375275895, 1.355785384759, 0.271418201815},
    {0.05, 0.419483134407, 2.332045857042, 1.398920189796, 0.394882568639},
    {0.1, 0.401964585313, 2.385384083475, 1.452838696091, 0.549213027168}};

double along_diagonal(const System& system, const ControlResult& result) {
  Workspace work;
  Vector r;
  Matrix A;
  equilibrium_matrix(system, result.piece, result.z, result.inputs, work, r, A);
  const Vector d = Vector::Constant(2, std::sqrt(0.5));
  return d.dot(platform_stiffness(system, A).K * d);
}

TEST(KinetostaticControl, GivesTheCommandsAndStiffnessesOfTable1) {
  for (const Table1Row& row : table1) {
    const System system = orthoglide_system(model::LinearSpring{row.stiffness, 0});
    for (const double s : {-p, p}) {
      const ControlResult result = commanded(system, Vector::Constant(2, s), Vector::Zero(2));
      ASSERT_EQ(result.status, ControlStatus::converged);
      for (const double rho : result.inputs.rho)
        EXPECT_NEAR(rho, s < 0 ? row.rho_Q1 : row.rho_Q2, 1e-11);
      EXPECT_NEAR(along_diagonal(system, result), s < 0 ? row.K_Q1 : row.K_Q2, 1e-11);
      EXPECT_LT(result.residual, 1e-12);
      EXPECT_EQ(result.stability.force_controlled, 0);
    }
  }
}

TEST(KinetostaticControl, BalancesAOneSidedSpring) {
  const System system = orthoglide_system(one_sided());
  const ControlResult result = commanded(system, Vector::Constant(2, p), Vector::Zero(2));
  ASSERT_EQ(result.status, ControlStatus::converged);
  EXPECT_NEAR(result.inputs.rho[0], 1.584646266767, 1e-11);
  EXPECT_NEAR(along_diagonal(system, result), 1.276373927828, 1e-11);
}

TEST(KinetostaticControl, EqualsPlainInverseKinematicsWhereNoOneSidedSpringActs) {
  const System system = orthoglide_system(one_sided());
  const double threshold = std::sin(std::numbers::pi / 12);
  int idle = 0;
  for (double x = -0.44; x <= 0.44; x += 0.04)
    for (double y = -0.44; y <= 0.44; y += 0.04) {
      const ControlResult result = commanded(system, Vector{{x, y}}, Vector::Zero(2));
      ASSERT_EQ(result.status, ControlStatus::converged);
      const double difference = (result.inputs.rho - result.plain.rho).lpNorm<Eigen::Infinity>();
      if (x < threshold && y < threshold) {
        EXPECT_LE(difference, 1e-12);
        EXPECT_NEAR(result.inputs.rho[0], x + std::sqrt(1 - y * y), 1e-12);
        ++idle;
      } else {
        EXPECT_GT(difference, 1e-4);
      }
    }
  EXPECT_GT(idle, 200);
}

TEST(KinetostaticControl, NeedsAtMostSixIterationsInTheDexterousSquareFromTheKinematicGuess) {
  const double edge = 1 / std::sqrt(5);
  for (const double stiffness : {0.0, 0.01, 0.1}) {
    const System system = orthoglide_system(model::LinearSpring{stiffness, 0});
    for (int i = -10; i <= 10; ++i)
      for (int j = -10; j <= 10; ++j) {
        const ControlResult result =
            commanded(system, Vector{{i * edge / 10, j * edge / 10}}, Vector::Zero(2));
        ASSERT_EQ(result.status, ControlStatus::converged);
        EXPECT_LE(result.iterations, 6);
        EXPECT_FALSE(result.globalised);
      }
  }
}

TEST(KinetostaticControl, ConvergesQuadratically) {
  const System system = prepare(three_rpr({.stiffness = 100, .actuated = true}));
  const Vector target{{0.05, -0.03, 0.1}}, W{{5, -3, 0.4}};
  const ControlResult exact = commanded(system, target, W);
  ASSERT_EQ(exact.status, ControlStatus::converged);
  std::vector<double> errors;
  for (const double size : {1e-2, 1e-3, 1e-4}) {
    // One step from a disturbed solution leaves an error that falls with its square.
    ControlSolver solver = control_solver(system, {}, exact.z, exact.inputs.rho);
    for (Index i = 0; i < system.first_pose; ++i)
      if (!system.is_wrench[static_cast<std::size_t>(i)])
        solver.z[i] += size * std::cos(3.0 * static_cast<double>(i));
    solver.inputs = exact.inputs;
    Workspace work;
    Vector r;
    Matrix A, dR;
    equilibrium_matrix(system, exact.piece, solver.z, solver.inputs, work, r, A, &dR);
    Matrix M(system.size, system.size);
    M << A.leftCols(system.first_pose), dR;
    const Vector step = M.partialPivLu().solve(r);
    errors.push_back((solver.z.head(system.first_pose) - step.head(system.first_pose) -
                      exact.z.head(system.first_pose))
                         .lpNorm<Eigen::Infinity>());
  }
  EXPECT_LT(errors[1], 0.02 * errors[0]);
  EXPECT_LT(errors[2], 0.02 * errors[1]);
}

// Closed form: qa = IK(target) - K^-1 J^T F (elbow q2 > 0).
TEST(KinetostaticControl, HoldsALoadedTwoLinkArmAtItsTarget) {
  struct Row {
    double x, y, fx, fy, q1, q2;
  };
  for (const Row& row : {Row{1.2, 0.9, 0.3, -0.2, 0.382907102547, 1.453014490060},
                         Row{0.5, 1.0, -0.5, 0.4, -0.009825276497, 1.660931392697},
                         Row{1.5, 0.3, 0, -0.8, 0.307798897812, 1.551890016307}}) {
    const auto drive = [](const char* name, double stiffness, double command) {
      return model::Joint{.name = name,
                          .role = model::JointRole::actuated,
                          .spring = model::LinearSpring{stiffness, 0},
                          .command = command};
    };
    model::Mechanism m;
    m.bodies = {{"tip", model::TaskSpace::xy, Vector{{0.5, 1.2}}}};
    m.chains = {{.name = "arm",
                 .elements = {drive("shoulder", 2, 0.3), link_along_x(1), drive("elbow", 1, 1.2),
                              link_along_x(0.8)}}};
    const System system = prepare(m);
    const ControlResult result =
        commanded(system, Vector{{row.x, row.y}}, Vector{{row.fx, row.fy}});
    ASSERT_EQ(result.status, ControlStatus::converged);
    EXPECT_NEAR(result.inputs.rho[0], row.q1, 1e-11);
    EXPECT_NEAR(result.inputs.rho[1], row.q2, 1e-11);
  }
}

TEST(KinetostaticControl, GivesTheFreeLengthsOfALoadedPlanarPlatform) {
  const System system =
      prepare(three_rpr({.stiffness = 100, .actuated = true, .pose = Vector::Zero(3)}));
  const ControlResult first = commanded(system, Vector{{0.05, -0.03, 0.1}}, Vector{{5, -3, 0.4}});
  ASSERT_EQ(first.status, ControlStatus::converged);
  const Vector lengths{{0.504154077689, 0.506030278615, 0.468763103290}};
  EXPECT_LT((first.inputs.rho - lengths).lpNorm<Eigen::Infinity>(), 1e-11);
  Workspace work;
  Vector r;
  Matrix A;
  equilibrium_matrix(system, first.piece, first.z, first.inputs, work, r, A);
  const Matrix K = platform_stiffness(system, A).K;
  EXPECT_NEAR(K(0, 0), 158.414893908, 1e-8);
  EXPECT_NEAR(K(0, 1), -20.920472223, 1e-8);
  EXPECT_NEAR(K(1, 2), 1.051754356, 1e-8);
  EXPECT_NEAR(K(2, 2), 6.934675854, 1e-8);

  // A load ramp from (0, 0, 0) would end elsewhere: the commanded point is this one, and stable.
  const ControlResult second = commanded(system, Vector{{-0.1, 0.08, -0.2}}, Vector{{0, -10, 1}});
  ASSERT_EQ(second.status, ControlStatus::converged);
  const Vector trap{{0.371932280753, 0.551839329495, 0.666099716085}};
  EXPECT_LT((second.inputs.rho - trap).lpNorm<Eigen::Infinity>(), 1e-11);
  EXPECT_EQ(second.stability.force_controlled, 0);
}

TEST(KinetostaticControl, ThePapersSchemeFindsTheSameCommands) {
  const System system = orthoglide_system(model::LinearSpring{0.05, 0});
  for (const double s : {-0.3, 0.2, 0.454}) {
    const Vector target{{s, 0.5 * s}};
    const ControlResult exact = commanded(system, target, Vector{{0.02, -0.01}});
    const ControlResult paper =
        commanded(system, target, Vector{{0.02, -0.01}}, ControlMethod::paper);
    ASSERT_EQ(paper.status, ControlStatus::converged);
    EXPECT_LT((exact.inputs.rho - paper.inputs.rho).lpNorm<Eigen::Infinity>(), 1e-10);
    EXPECT_GT(paper.iterations, 0);
  }
}

TEST(KinetostaticControl, SaysWhichChainIsShortAndByHowMuch) {
  const System system = orthoglide_system(model::LinearSpring{0.01, 0});
  const ControlResult result = commanded(system, Vector{{0, 1.25}}, Vector::Zero(2));
  EXPECT_EQ(result.status, ControlStatus::unreachable);
  EXPECT_EQ(result.z.size(), 0);
  EXPECT_EQ(result.plain.chain, 0u);  // leg_x reaches 1 in y
  EXPECT_NEAR(result.plain.gap, 0.25, 1e-9);
}

TEST(KinetostaticControl, SaysThatAClosedPoseIsNotHeld) {
  // A spring that cannot push back: one-sided drives hold no force towards their idle side.
  model::Mechanism m = orthoglide(model::LinearSpring{0, 0}, 0, 0);
  for (auto& chain : m.chains)
    std::get<model::Joint>(chain.elements[0]).spring =
        model::OneSidedSpring{1, 0, model::OneSidedSpring::Side::above};
  const System system = prepare(m);
  const ControlResult result = commanded(system, Vector{{0.1, 0.1}}, Vector{{-0.3, -0.3}});
  EXPECT_EQ(result.status, ControlStatus::not_held);
  EXPECT_TRUE(result.plain.closed);
  EXPECT_EQ(result.z.size(), 0);
  EXPECT_GT(result.miss, 0.1);
}

TEST(KinetostaticControl, WindsUpTheSlackOfCablesThatBearAWeight) {
  // Two cables from (-1, 1) and (1, 1), slack until they are longer by 0.05: rho = l - T/k - 0.05.
  model::Mechanism m;
  m.bodies.push_back({"weight", model::TaskSpace::xy, Vector::Zero(2)});
  for (const double side : {-1.0, 1.0}) {
    model::Chain cable;
    cable.name = side < 0 ? "left" : "right";
    cable.from_attachment.p = {side, 1, 0};
    cable.elements.push_back(model::Joint{
        .name = "hinge", .axis = model::Vec3<double>::UnitZ(), .initial = side < 0 ? -0.8 : -2.35});
    cable.elements.push_back(
        model::Joint{.name = "winch",
                     .kind = model::JointKind::prismatic,
                     .axis = model::Vec3<double>::UnitX(),
                     .role = model::JointRole::actuated,
                     .spring = model::OneSidedSpring{50, 0.05, model::OneSidedSpring::Side::above},
                     .command = 1.41});
    m.chains.push_back(cable);
  }
  const System system = prepare(m);
  const double x = 0.2, y = -0.5;
  const ControlResult result = commanded(system, Vector{{x, y}}, Vector{{0, -1}});
  ASSERT_EQ(result.status, ControlStatus::converged);
  const double left = std::hypot(1 + x, 1 - y), right = std::hypot(1 - x, 1 - y);
  // Weight 1: the parts of both tensions across cancel, those upwards add up.
  const double both = 1 / (2 * (1 - y));
  EXPECT_NEAR(result.inputs.rho[0], left - (1 - x) * both * left / 50 - 0.05, 1e-12);
  EXPECT_NEAR(result.inputs.rho[1], right - (1 + x) * both * right / 50 - 0.05, 1e-12);
}

TEST(KinetostaticControl, LeavesOtherPoseCoordinatesInEquilibrium) {
  // Two drives place the point of a platform; its angle is left to the springs.
  model::Mechanism m = three_rpr({.stiffness = 100, .free_length = 0.3, .actuated = true});
  const System system = prepare(m);
  const CommandTask task{.prescribed = {0, 1}, .commands = {0, 1}};
  const Vector W{{3, -2, 0.1}};
  const ControlResult result = kinetostatic_control(system, {.task = task,
                                                             .target = Vector{{0.02, 0.03}},
                                                             .W = W,
                                                             .z = guess(system),
                                                             .rho = system.commands});
  ASSERT_EQ(result.status, ControlStatus::converged);
  EXPECT_EQ(result.inputs.rho[2], system.commands[2]);
  // Forward: with these commands the free platform is in equilibrium there.
  const FirstEquilibrium forward =
      first_equilibrium(system, {.z = result.z, .inputs = {result.inputs.rho, W}});
  ASSERT_EQ(forward.status, StartStatus::found);
  EXPECT_LT((forward.z - result.z).lpNorm<Eigen::Infinity>(), 1e-10);
  EXPECT_NEAR(result.z[system.body_slices[0].t], 0.02, 0);
}

TEST(KinetostaticControl, StiffnessOfEquation12EqualsDifferencedEquilibria) {
  const System system = orthoglide_system(model::LinearSpring{0.05, 0});
  std::mt19937_64 random(5);
  const auto uniform = [&random] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
  for (int node = 0; node < 100; ++node) {
    const Vector target{{0.44 * uniform(), 0.44 * uniform()}};
    const Vector W{{0.05 * uniform(), 0.05 * uniform()}};
    const ControlResult at = commanded(system, target, W);
    ASSERT_EQ(at.status, ControlStatus::converged);
    Workspace work;
    Vector r;
    Matrix A;
    equilibrium_matrix(system, at.piece, at.z, at.inputs, work, r, A);
    Matrix K = Matrix::Zero(2, 2), differenced(2, 2);
    for (std::size_t i = 0; i < 2; ++i) K += *chain_stiffness(system, i, A, work);
    constexpr double h = 1e-4;
    for (Index k = 0; k < 2; ++k) {
      Vector wrench[2];
      for (const int side : {0, 1}) {
        Vector z = at.z;
        z[system.first_pose + k] += side == 0 ? -h : h;
        const FirstEquilibrium held = first_equilibrium(
            system, {.unknowns = StartUnknowns::wrench, .z = z, .inputs = at.inputs});
        ASSERT_EQ(held.status, StartStatus::found);
        wrench[side] = held.inputs.W;
      }
      differenced.col(k) = (wrench[1] - wrench[0]) / (2 * h);
    }
    EXPECT_LT((K - differenced).norm(), 1e-6 * K.norm());
  }
}

}  // namespace
}  // namespace springfold::statics
