// The paper's iteration, eq. (6) with its sign corrected: same equilibria as Newton, other speed.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "examples.hpp"

namespace springfold::statics {
namespace {

StartProblem problem_for(const System& system, StartUnknowns unknowns) {
  return {.unknowns = unknowns,
          .z = guess(system),
          .inputs = {system.commands, Vector::Zero(system.load_size)}};
}

void expect_same(const FirstEquilibrium& paper, const FirstEquilibrium& newton) {
  ASSERT_EQ(paper.status, StartStatus::found);
  ASSERT_EQ(newton.status, StartStatus::found);
  EXPECT_LT((paper.z - newton.z).lpNorm<Eigen::Infinity>(), 1e-10);
  EXPECT_LT((paper.inputs.rho - newton.inputs.rho).norm(), 1e-10);
  EXPECT_LT((paper.inputs.W - newton.inputs.W).norm(), 1e-10);
  EXPECT_EQ(paper.piece, newton.piece);
}

/// Springs of every kind for the knees of the Orthoglide, with a preload in a segment of its own.
std::vector<model::SpringLaw> knees() {
  using Side = model::OneSidedSpring::Side;
  return {model::LinearSpring{0, 0},
          model::LinearSpring{0.1, 0},
          model::LinearSpring{0.05, 0.2},
          model::OneSidedSpring{0.5, std::numbers::pi / 12, Side::above},
          model::OneSidedSpring{0.5, 0.1, Side::below},
          model::PiecewiseLinearSpring{{-0.2, 0.2}, {0.4, 0, 0.3}, 0, 0.02},
          model::PolynomialSpring{{0.01, 0.1, 0, 0.2}, 0.1}};
}

TEST(PaperIteration, HoldsTheOrthoglideWithTheWrenchOfNewtonsMethod) {
  for (const model::SpringLaw& knee : knees())
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.3, 0.1}, {-0.4, -0.4}, {0.454, 0.454}}) {
      model::Mechanism m = orthoglide(knee, x, y);
      for (model::Chain& chain : m.chains)  // drives that have to carry something
        std::get<model::Joint>(chain.elements[0]).command += 0.05;
      const System system = prepare(m);
      const StartProblem problem = problem_for(system, StartUnknowns::wrench);
      expect_same(first_equilibrium_paper(system, problem), first_equilibrium(system, problem));
    }
}

TEST(PaperIteration, FindsTheCommandsOfNewtonsMethod) {
  for (const model::SpringLaw& knee : knees())
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.3, 0.1}, {-0.454, -0.454}, {0.4, 0.4}}) {
      const System system = prepare(orthoglide(knee, x, y));
      const StartProblem problem = problem_for(system, StartUnknowns::commands);
      expect_same(first_equilibrium_paper(system, problem), first_equilibrium(system, problem));
    }
}

TEST(PaperIteration, FindsTheCommandsOfALoadedPlatform) {
  const System system =
      prepare(three_rpr({.stiffness = 10, .actuated = true, .pose = Vector{{0.05, -0.03, 0.1}}}));
  StartProblem problem = problem_for(system, StartUnknowns::commands);
  problem.inputs.W = Vector{{0.5, -0.3, 0.04}};
  expect_same(first_equilibrium_paper(system, problem), first_equilibrium(system, problem));
}

TEST(PaperIteration, CountsItsIterationsPerChain) {
  const System system = prepare(orthoglide(model::LinearSpring{0.05, 0}, 0.3, 0.1));
  const FirstEquilibrium found =
      first_equilibrium_paper(system, problem_for(system, StartUnknowns::wrench));
  ASSERT_EQ(found.status, StartStatus::found);
  EXPECT_GT(found.iterations, 0);
  EXPECT_EQ(found.attempts, 1);
  ASSERT_EQ(found.chain_iterations.size(), 2u);
  for (const int iterations : found.chain_iterations) {
    EXPECT_GT(iterations, 0);
    EXPECT_LE(iterations, 60);
  }
}

TEST(PaperIteration, ReportsTheResidualAndHowFarItMoved) {
  const System system = prepare(two_link_arm(degrees(30), degrees(60)));
  StartProblem problem = problem_for(system, StartUnknowns::wrench);
  problem.z.tail(2) += Vector{{0.02, -0.01}};
  const FirstEquilibrium found = first_equilibrium_paper(system, problem);
  ASSERT_EQ(found.status, StartStatus::found);
  EXPECT_GT(found.moved, 0.001);
  EXPECT_LT(found.moved, 0.2);
  Workspace work;
  Vector r;
  equilibrium_residual(system, found.piece, found.z, found.inputs, work, r);
  EXPECT_NEAR(found.residual, r.lpNorm<Eigen::Infinity>(), 1e-15);
}

TEST(PaperIteration, GivesUpWhereItDoesNotConverge) {
  // A beam pushed together beyond its buckling load: the fixed point repels, Newton's does not.
  const System system = prepare(cantilever(5, 2, model::TaskSpace::xy));
  StartProblem problem = problem_for(system, StartUnknowns::wrench);
  problem.z.tail(2) = Vector{{0.5, 0.02}};
  EXPECT_EQ(first_equilibrium(system, problem).status, StartStatus::found);
  EXPECT_EQ(first_equilibrium_paper(system, problem).status, StartStatus::no_equilibrium);
}

/// Distances to the solution of one loaded chain at a held pose, after 0, 1, 2, ... iterations of
/// either method from the same start.
struct Speed {
  std::vector<double> paper{}, newton{};
};

Speed speed_of_both() {
  const System system = prepare(cantilever(5, 2, model::TaskSpace::xy));
  StartProblem problem = problem_for(system, StartUnknowns::wrench);
  problem.z.head(5).setConstant(0.1);  // straight it could not move along itself
  problem.z.tail(2) = Vector{{0.95, 0.25}};
  const FirstEquilibrium exact = first_equilibrium(system, problem);
  EXPECT_EQ(exact.status, StartStatus::found);
  const Index n = system.first_pose;
  Vector start = exact.z;
  for (Index i = 0; i < n; ++i) start[i] += i % 2 == 0 ? 0.03 : -0.03;
  Speed speed;
  for (int count = 0; count < 12; ++count) {
    Vector z = start;
    iterate_chain(system, 0, problem.inputs.rho, z, 0, count);
    speed.paper.push_back((z - exact.z).norm());
  }
  Vector z = start, r;
  Matrix A;
  Workspace work;
  for (int count = 0; count < 7; ++count) {
    speed.newton.push_back((z - exact.z).norm());
    equilibrium_matrix(system, {}, z, problem.inputs, work, r, A);
    z.head(n) -= A.topLeftCorner(n, n).partialPivLu().solve(r.head(n));
  }
  return speed;
}

TEST(PaperIteration, ConvergesLinearlyUnderLoad) {
  const std::vector<double> error = speed_of_both().paper;
  for (std::size_t k = 5; k + 1 < error.size(); ++k) {
    const double ratio = error[k + 1] / error[k], before = error[k] / error[k - 1];
    EXPECT_GT(ratio, 0.01) << "after " << k << " iterations";
    EXPECT_LT(ratio, 0.9);
    EXPECT_NEAR(ratio, before, 0.2 * before) << "the factor settles";
  }
}

TEST(PaperIteration, IsSlowerThanNewtonsMethodWhichConvergesQuadratically) {
  const Speed speed = speed_of_both();
  int seen = 0;
  for (std::size_t k = 1; speed.newton[k + 1] > 1e-12; ++k) {
    if (speed.newton[k] > 0.5 * speed.newton[k - 1]) continue;  // not close enough yet
    ++seen;
    const double order = std::log(speed.newton[k + 1] / speed.newton[k]) /
                         std::log(speed.newton[k] / speed.newton[k - 1]);
    EXPECT_GT(order, 1.8) << "after " << k << " iterations";
  }
  EXPECT_GE(seen, 1);
  EXPECT_LT(speed.newton.back(), 1e-13);
  EXPECT_GT(speed.paper[speed.newton.size() - 1], 1e-6);
}

}  // namespace
}  // namespace springfold::statics
