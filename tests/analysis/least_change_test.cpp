// The search for a minimum under inequalities: it ends where nothing is gained any more.
#include "analysis/least_change.hpp"

#include <gtest/gtest.h>

namespace springfold::analysis {
namespace {

/// Half of the squared distance from 0, and how many points of it were asked for.
struct Counted {
  InequalityProblem problem{Vector::Constant(1, -10), Vector::Constant(1, 10), 1};
  int evaluations = 0;

  /// @param g  the inequality and its slope at x
  explicit Counted(std::function<std::pair<double, double>(double x)> g) {
    problem.at = [this, g = std::move(g)](const Vector& x) -> std::optional<InequalityValues> {
      ++evaluations;
      const auto [value, slope] = g(x[0]);
      return InequalityValues{0.5 * x.squaredNorm(), x, Vector::Constant(1, value),
                              Matrix::Constant(1, 1, slope)};
    };
  }
};

TEST(LeastChangeSearch, OfASmoothProblemComesToTheMinimumInFewEvaluations) {
  Counted curved{[](double x) { return std::pair{4 - x * x, -2 * x}; }};
  EXPECT_NEAR(search_minimum(curved.problem, Vector::Constant(1, 5))[0], 2, 1e-9);
  EXPECT_LT(curved.evaluations, 40);
}

/// Slopes lead across the jump of g from 1 to -1 at x = 2, from both sides.
TEST(LeastChangeSearch, BesideAJumpEndsAtTheBestPointWhenItGetsNoFurther) {
  Counted jump{[](double x) { return std::pair{x < 2 ? 3 - x : -1, -1.0}; }};
  const double x = search_minimum(jump.problem, Vector::Zero(1))[0];
  EXPECT_GE(x, 2);
  EXPECT_LT(x, 2.1);
  EXPECT_LT(jump.evaluations, 150);
}

/// Nowhere is the inequality met: its least violation is at the bound, which is come to at once.
TEST(LeastChangeSearch, OfWhatCannotBeMetEndsAtTheLeastViolation) {
  Counted never{[](double x) { return std::pair{20 - x, -1.0}; }};
  EXPECT_NEAR(search_minimum(never.problem, Vector::Zero(1))[0], 10, 1e-9);
  EXPECT_LT(never.evaluations, 100);
}

}  // namespace
}  // namespace springfold::analysis
