// Loads and springs at points of a path's equations: no memory from the heap either.
#include <gtest/gtest.h>

#include "analysis/path_problem.hpp"
#include "command_mechanisms.hpp"
#include "statics/allocations.hpp"

#ifdef SPRINGFOLD_COUNTS_ALLOCATIONS
namespace springfold::analysis {
namespace {

/// A load and a spring to the base at the tool, and a weight at a chain's knee; lambda pushes.
PathProblem with_points() {
  model::Mechanism m = orthoglide(linear(0.05));
  m.gravity = {0, -0.01, 0};
  m.chains[0].points.push_back(
      {.name = "knee", .elements_before = 2, .at = {0.1, 0, 0}, .mass = 1});
  m.loads.push_back({.name = "load", .on = {.body = 1}, .vector = {0.01, 0, 0}});
  m.line_springs.push_back({.name = "spring",
                            .from = {.body = 0, .at = {2, 1, 0}},
                            .to = {.body = 1},
                            .stiffness = 0.1,
                            .free = 1});
  const statics::System system = statics::prepare(m);
  const Vector none = Vector::Zero(2);
  PathRule rule{.t_start = none, .t_rate = none, .N = Matrix::Identity(2, 2)};
  rule.rho_start = system.commands;
  rule.rho_rate = rule.W_start = none;
  rule.W_rate = Vector{{1, -0.3}};
  rule.load_start = rule.load_rate = Vector::Ones(1);
  return {system, rule};
}

TEST(EquationsOfAPath, NeedNoMemoryForWhatActsAtPoints) {
  const PathProblem problem = with_points();
  Vector y = Vector::Constant(problem.size(), 0.05), F, b;
  Matrix A;
  ASSERT_TRUE(problem.residual(y, 0, {}, F) && problem.derivatives(y, 0, {}, A, b));
  const long before = allocations;
  bool inside = true;
  for (int k = 1; k <= 50; ++k) {
    y[0] = 1e-3 * k;
    inside = problem.residual(y, y[0], {}, F) && problem.derivatives(y, y[0], {}, A, b) && inside;
  }
  EXPECT_EQ(allocations, before);
  EXPECT_TRUE(inside);
}

}  // namespace
}  // namespace springfold::analysis
#endif
