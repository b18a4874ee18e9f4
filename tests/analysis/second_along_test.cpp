// Second derivatives of a path's equations against differences of the first ones.
#include "path_problems.hpp"
#include "springfold/core/differences.hpp"

namespace springfold::analysis {
namespace {

void expect_those_of_differences(const PathProblem& problem) {
  const Index n = problem.size();
  Vector y(n), w(n), V(n + 1), exact;
  for (Index i = 0; i < n; ++i) {
    y[i] = 0.1 + 0.07 * static_cast<double>(i);
    w[i] = std::cos(1.7 * static_cast<double>(i));
    V[i] = std::sin(2.3 * static_cast<double>(i) + 1);
  }
  V[n] = 0.4;
  const Piece piece = piece_at(problem, y);
  ASSERT_TRUE(problem.second_along(y, 0.3, piece, w, V, exact));
  const auto expected = six_point_derivative(
      [&](double t) -> std::optional<Vector> {
        Vector F, b, row(n + 1);
        Matrix A;
        if (!problem.equations(y + t * V.head(n), 0.3 + t * V[n], piece, F, A, b))
          return std::nullopt;
        row << A.transpose() * w, b.dot(w);
        return row;
      },
      0, 0x1p-7);
  ASSERT_TRUE(expected);
  EXPECT_GT(expected->norm(), 0.1);
  EXPECT_LT((exact - *expected).lpNorm<Eigen::Infinity>(), 1e-10 * (1 + expected->norm()));
}

TEST(SecondDerivativesOfAPath, UnderALoadAreThoseOfDifferences) {
  expect_those_of_differences(problem_of(linear(0.05), false));
  expect_those_of_differences(bows(4, 3, false));
  expect_those_of_differences(column(5));
}

TEST(SecondDerivativesOfAPath, OfABodyThatIsMovedAreThoseOfDifferences) {
  expect_those_of_differences(problem_of(linear(0.05), true));
  expect_those_of_differences(bows(4, 3, true));
}

TEST(SecondDerivativesOfAPath, OfDrivesThatMoveAreThoseOfDifferences) {
  const statics::System system = statics::prepare(orthoglide(linear(0.05)));
  const Vector none = Vector::Zero(2);
  PathRule rule{.t_start = none, .t_rate = none, .N = Matrix::Identity(2, 2)};
  rule.rho_start = system.commands;
  rule.rho_rate = Vector{{1, -0.5}};
  rule.W_start = rule.W_rate = none;
  expect_those_of_differences({system, rule});
}

TEST(SecondDerivativesOfAPath, AreNotGivenInSpace) {
  const PathProblem problem = column(3, model::TaskSpace::spatial);
  const Index n = problem.size();
  Vector value;
  EXPECT_FALSE(
      problem.second_along(Vector::Zero(n), 0, {}, Vector::Ones(n), Vector::Ones(n + 1), value));
}

}  // namespace
}  // namespace springfold::analysis
