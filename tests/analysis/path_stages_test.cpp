// Long chains as a path: in stages the same equations and derivatives as with all entries.
#include <Eigen/QR>

#include "analysis/path_problem.hpp"
#include "analysis/quaternion.hpp"
#include "statics/staged.hpp"

namespace springfold::analysis {
namespace {

using namespace springfold::statics;

/// 50 joints per chain, none of which moves freely: dozens of those make singular matrices.
statics::System long_chains(std::mt19937& random, bool elastic,
                            const std::vector<TaskSpace>& bodies,
                            const std::vector<std::pair<Index, Index>>& chains) {
  model::Mechanism m =
      random_mechanism(random, {in_plane(bodies), 50, elastic, true}, bodies, chains);
  for (model::Chain& chain : m.chains)
    for (auto& element : chain.elements)
      if (auto* joint = std::get_if<model::Joint>(&element); joint != nullptr)
        if (joint->role == JointRole::passive || joint->role == JointRole::preloaded) {
          joint->role = JointRole::compliant;
          joint->spring = model::LinearSpring{1 + std::abs(number(random, 1)), 0};
        }
  return statics::prepare(m);
}

/// All of the path's inputs change with lambda; `free` pose coordinates of the body are unknown.
PathRule rule_for(std::mt19937& random, const statics::System& system, Index free) {
  const Index d = system.body_slices[0].count;
  const auto loads = static_cast<Index>(system.mechanism.loads.size());
  PathRule rule{.body = 1};
  rule.t_start = random_vector(random, d, 0.5);
  rule.t_rate = free == d ? Vector(Vector::Zero(d)) : random_vector(random, d, 1);
  rule.N = Matrix::Identity(d, d);
  if (free < d)
    rule.N = Eigen::HouseholderQR<Matrix>(random_vector(random, d * d, 1).reshaped(d, d))
                 .householderQ() *
             Matrix::Identity(d, free);
  rule.rho_start = random_vector(random, system.commands.size(), 0.5);
  rule.rho_rate = random_vector(random, system.commands.size(), 1);
  rule.W_start = random_vector(random, system.load_size, 1);
  rule.W_rate = random_vector(random, system.load_size, 1);
  rule.load_start = random_vector(random, loads, 1);
  rule.load_rate = random_vector(random, loads, 1);
  return rule;
}

Vector state(std::mt19937& random, const PathProblem& problem) {
  Vector y = random_vector(random, problem.size(), 0.3);
  for (const Index q : problem.double_covers())
    y.segment<4>(q) = 1.1 * quaternion_of(2 * random_unit(random));
  return y;
}

void expect_equal(std::mt19937& random, const PathProblem& problem) {
  ASSERT_TRUE(problem.structured());
  const Vector y = state(random, problem);
  const Index n = problem.size();
  const Piece piece = piece_at(problem.layout(), problem.local(y, 0.4));
  Matrix A;
  Vector rate, rate_in_stages, F;
  StructuredMatrix J;
  ASSERT_TRUE(problem.derivatives(y, 0.4, piece, A, rate));
  ASSERT_TRUE(problem.structured_derivatives(y, 0.4, piece, J, rate_in_stages));
  const double size = A.cwiseAbs().maxCoeff();
  EXPECT_LT((rate - rate_in_stages).cwiseAbs().maxCoeff(), 1e-11 * size);
  EXPECT_GT(J.largest, 0.1 * size);
  EXPECT_LT(J.largest, 100 * size);
  const Vector v = random_vector(random, n, 1);
  EXPECT_LT((product(J, v) - A * v).cwiseAbs().maxCoeff(), 1e-11 * size);
  EXPECT_GE((magnitudes(J, v) - A.cwiseAbs() * v.cwiseAbs()).minCoeff(), -1e-10 * size);

  const FrontalBorders borders = random_borders(random, n, 2);
  const Matrix M = with_borders(A, borders), right = random_vector(random, n + 2, 1);
  for (const bool transposed : {false, true}) {
    Matrix X = right;
    ASSERT_TRUE(J.solve(borders, X, transposed));
    const Matrix left = (transposed ? Matrix(M.transpose()) : M) * X - right;
    EXPECT_LT(left.cwiseAbs().maxCoeff(), 1e-11 * (size * X.cwiseAbs().maxCoeff() + 1));
  }
  EXPECT_EQ(J.inertia(), inertia_of(A));
}

TEST(PathInStages, IsTheSameForAllMovingBodiesAndAnyFreePoseCoordinates) {
  std::mt19937 random(31);
  for (const auto& [bodies, chains] : kinds) {
    const statics::System system = long_chains(random, false, bodies, chains);
    const Index d = system.body_slices[0].count;
    for (const Index free : {Index{0}, Index{1}, d}) {
      SCOPED_TRACE(std::to_string(bodies.size()) + " bodies, first with " + std::to_string(d) +
                   " coordinates, free: " + std::to_string(free));
      expect_equal(random, PathProblem(system, rule_for(random, system, free)));
    }
  }
}

TEST(PathInStages, HasTheResidualOfThePathWithEntries) {
  std::mt19937 random(32);
  for (const auto& [bodies, chains] : kinds) {
    const statics::System system = long_chains(random, true, bodies, chains);
    const PathProblem problem(system, rule_for(random, system, system.body_slices[0].count));
    const Vector y = state(random, problem);
    const Piece piece = piece_at(system, problem.local(y, -0.3));
    Vector in_stages, dense;
    ASSERT_TRUE(problem.residual(y, -0.3, piece, in_stages));
    statics::Workspace work;
    ASSERT_TRUE(equilibrium_residual(problem.turned(y, -0.3), piece, problem.local(y, -0.3),
                                     problem.inputs(-0.3), work, dense));
    const Index first = system.first_pose;
    EXPECT_LT((in_stages.head(first) - dense.head(first)).cwiseAbs().maxCoeff(),
              1e-11 * (1 + dense.cwiseAbs().maxCoeff()));
  }
}

TEST(PathInStages, IsNotTakenForShortChains) {
  std::mt19937 random(33);
  const Sort sort{false, 6, true, true};
  const statics::System system = statics::prepare(
      random_mechanism(random, sort, {TaskSpace::spatial}, {{0, 1}, {0, 1}, {0, 1}}));
  EXPECT_FALSE(PathProblem(system, rule_for(random, system, 6)).structured());
}

TEST(PathInStages, MatricesOutliveTheNextEvaluation) {
  std::mt19937 random(34);
  const statics::System system = long_chains(random, false, {TaskSpace::planar}, {{0, 1}, {0, 1}});
  const PathProblem problem(system, rule_for(random, system, 3));
  const Vector y = state(random, problem), v = random_vector(random, problem.size(), 1);
  const Piece piece = piece_at(system, problem.local(y, 0));
  StructuredMatrix first, second;
  Vector rate;
  ASSERT_TRUE(problem.structured_derivatives(y, 0, piece, first, rate));
  const Vector before = product(first, v);
  ASSERT_TRUE(problem.structured_derivatives(1.5 * y, 0.2, piece, second, rate));
  EXPECT_EQ(product(first, v), before);
  EXPECT_NE(product(second, v), before);
}

}  // namespace
}  // namespace springfold::analysis
