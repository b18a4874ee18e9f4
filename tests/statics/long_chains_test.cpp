// Long chains in stages: buckling loads in closed form, and states that are hard on pivots.
#include <cmath>
#include <numbers>

#include "allocations.hpp"
#include "springfold/statics/first_equilibrium.hpp"
#include "staged.hpp"

namespace springfold::statics {
namespace {

/// The straight chain of N links of length 1/N on springs N under the force P towards its base.
struct StraightChain {
  System system;
  Inputs inputs{};
  Vector z{};
  StagePlan plan{};
  StageMatrix matrix{};
  Vector residual{};

  explicit StraightChain(int N)
      : system{prepare(cantilever(N, 1, TaskSpace::xy))}, plan{plan_stages(system)} {
    inputs = {system.commands, Vector::Zero(2)};
    z = guess(system);
  }
  /// Bordered with the j-th buckling mode: the test function, zero at its load.
  double test_function(double P, Index j, StageSolver& solver) {
    evaluate(P);
    const Index N = plan.chain_unknowns - 2;
    Vector mode = Vector::Zero(plan.size());
    const auto angle = [&](Index i) {
      return std::sin(static_cast<double>((2 * j - 1) * i) * std::numbers::pi /
                      static_cast<double>(2 * N + 1));
    };
    for (Index i = 0; i < N; ++i) mode[i] = angle(i + 1) - angle(i);
    mode.normalize();
    EXPECT_TRUE(solver.factorise(matrix, {mode, mode, Matrix::Zero(1, 1)}));
    Matrix X = Vector::Unit(plan.size() + 1, plan.size());
    EXPECT_TRUE(solver.solve(X));
    return X(plan.size(), 0);
  }
  void evaluate(double P) {
    inputs.W = Vector{{-P, 0}};
    z[plan.chain_unknowns - 2] = -P;
    EXPECT_TRUE(equilibrium_stages(plan, system, {}, z, inputs, {}, {}, residual, matrix));
    EXPECT_LT(residual.cwiseAbs().maxCoeff(), 1e-12);
  }
};

double buckling_load(Index N, Index j) {
  const double n = static_cast<double>(N), odd = static_cast<double>(2 * j - 1);
  const double s = std::sin(odd * std::numbers::pi / (2 * (2 * n + 1)));
  return 4 * n * n * s * s;
}

TEST(Stages, AStraightChainHasAsManyUnstableModesAsBucklingLoadsBelow) {
  for (const int N : {2, 5, 20, 100, 500, 2000}) {
    StraightChain chain(N);
    StageSolver solver(chain.plan);
    for (const Index j : {Index{1}, Index{2}, Index{3}, Index{N / 2}, Index{N - 1}}) {
      if (j < 1 || j >= N) continue;
      const double P = 0.5 * (buckling_load(N, j) + buckling_load(N, j + 1));
      chain.evaluate(P);
      ASSERT_TRUE(solver.factorise(chain.matrix));
      EXPECT_EQ(solver.inertia().negative - 2, j) << N;
      EXPECT_EQ(solver.inertia().zero, 0);
    }
    chain.evaluate(0.9 * buckling_load(N, 1));
    ASSERT_TRUE(solver.factorise(chain.matrix));
    EXPECT_EQ(solver.inertia(), (Inertia{2, 0, N + 2})) << N;
  }
}

TEST(Stages, TheBorderedTestFunctionVanishesAtTheBucklingLoads) {
  for (const int N : {2, 5, 20, 100, 500, 2000, 10000}) {
    StraightChain chain(N);
    StageSolver solver(chain.plan);
    for (const Index j : {Index{1}, Index{2}, Index{5}}) {
      if (j > N) continue;
      const double P = buckling_load(N, j), h = 1e-4 * P;
      const double slope =
          (chain.test_function(P + h, j, solver) - chain.test_function(P - h, j, solver)) / (2 * h);
      EXPECT_LT(std::abs(chain.test_function(P, j, solver) / slope), 1e-9 * P) << N << " " << j;
    }
  }
}

TEST(Stages, AStraightChainAtItsBucklingLoadIsSolvedWithABorder) {
  std::mt19937 random(9);
  for (const int N : {5, 20, 60}) {
    const double P = buckling_load(N, 2);
    StraightChain chain(N);
    chain.evaluate(P);
    Both both(cantilever(N, 1, TaskSpace::xy), chain.z);
    expect_equal(both, random);
    expect_solved(both, random_borders(random, both.plan.size(), 1), random);
  }
}

/// Straight links on passive joints, some of them, with and without force: the wrench along the chain
/// is not determined where there is none.
TEST(Stages, PassiveJointsAndUndeterminedWrenchesWaitForTheirPartners) {
  std::mt19937 random(10);
  for (const int N : {3, 8, 30, 60})
    for (const double P : {0.0, 1e-9, -3.0, 40.0})
      for (const TaskSpace space : {TaskSpace::xy, TaskSpace::planar}) {
        model::Mechanism m = cantilever(N, 1, space);
        for (std::size_t j = 0; j < m.chains[0].elements.size(); j += 20) {
          auto& joint = std::get<model::Joint>(m.chains[0].elements[j]);
          joint.role = JointRole::passive;
          joint.spring.reset();
        }
        const System system = prepare(m);
        Vector z = guess(system);
        z[system.chain_slices[0].F] = -P;
        const Both both(m, z);
        expect_equal(both, random);
        StageSolver solver(both.plan);
        ASSERT_TRUE(solver.factorise(both.matrix));
        EXPECT_EQ(solver.inertia(), inertia_of(both.A)) << N << " " << P;
        const Index zero = inertia_of(both.A)->zero;
        expect_solved(both, random_borders(random, both.plan.size(), zero + 1), random);
      }
}

#ifdef SPRINGFOLD_COUNTS_ALLOCATIONS
TEST(Stages, AllocateNothingOnceTheStorageIsThere) {
  std::mt19937 random(11);
  const Sort sort{false, 12, true, true};
  const Both both(random, random_mechanism(random, sort, {TaskSpace::spatial, TaskSpace::spatial},
                                           {{0, 1}, {1, 2}, {0, 2}}));
  const FrontalBorders borders = random_borders(random, both.plan.size(), 2);
  const Matrix R = random_vector(random, both.plan.size() + 2, 1);
  const Matrix basis = Matrix::Identity(12, 12);
  StageMatrix matrix;
  StageSolver solver(both.plan);
  Vector residual;
  Matrix X = R;
  const auto once = [&] {
    EXPECT_TRUE(equilibrium_stages(both.plan, both.system, both.piece, both.z, both.inputs, basis,
                                   {}, residual, matrix));
    EXPECT_TRUE(solver.factorise(matrix, borders));
    X = R;
    EXPECT_TRUE(solver.solve(X));
    EXPECT_TRUE(solver.set_borders(borders));
    EXPECT_TRUE(solver.solve_transposed(X));
    return solver.inertia().negative;
  };
  const Index negative = once();
  const long before = allocations;
  EXPECT_EQ(once(), negative);
  EXPECT_EQ(allocations, before);
  EXPECT_TRUE(Vector(Vector::Ones(100)).allFinite());
  EXPECT_GT(allocations, before);  // the counter counts
}
#endif

/// Moments in every joint of a cantilever balance the force at its tip.
void expect_moments(const System& system, const FirstEquilibrium& found, int links) {
  ASSERT_EQ(found.status, StartStatus::found);
  EXPECT_TRUE(found.in_stages);
  const Vector tip = found.z.tail(2), W = found.inputs.W;
  double x = 0, y = 0, angle = 0;
  for (int i = 0; i < links; ++i) {
    const double turn = found.z[system.chain_slices[0].x + i];
    EXPECT_NEAR(links * turn, (tip[0] - x) * W[1] - (tip[1] - y) * W[0], 1e-11) << "joint " << i;
    angle += turn;
    x += std::cos(angle) / links;
    y += std::sin(angle) / links;
  }
  EXPECT_NEAR(x, tip[0], 1e-12);
  EXPECT_NEAR(y, tip[1], 1e-12);
}

TEST(LongChains, AreFoundInEquilibriumUnderAForceThatBendsThemFar) {
  constexpr int links = 400;
  const System system = prepare(cantilever(links, 1, TaskSpace::xy));
  for (const Vector& W : {Vector{{0.0, 0.1}}, Vector{{-1.0, 1.0}}, Vector{{0.0, 4.0}}})
    expect_moments(system,
                   first_equilibrium(system, {.z = guess(system), .inputs = {system.commands, W}}),
                   links);
}

TEST(LongChains, AreHeldAtAGivenPoseByTheWrenchThatIsFound) {
  constexpr int links = 400;
  const System system = prepare(cantilever(links, 1, TaskSpace::xy));
  StartProblem problem{.unknowns = StartUnknowns::wrench, .z = guess(system)};
  problem.inputs = {system.commands, Vector::Zero(2)};
  problem.z.tail(2) << 0.8, 0.4;
  for (int i = 0; i < links; ++i) problem.z[system.chain_slices[0].x + i] = 1.0 / links;
  const FirstEquilibrium found = first_equilibrium(system, problem);
  EXPECT_EQ(Vector(found.z.tail(2)), Vector(problem.z.tail(2)));
  expect_moments(system, found, links);
}

}  // namespace
}  // namespace springfold::statics
