// Memory from the heap: none for the equations of a path, a bounded number of pieces for a step.
#include <gtest/gtest.h>

#include "allocations.hpp"
#include "analysis/path_problem.hpp"
#include "command_mechanisms.hpp"
#include "springfold/continuation/trace.hpp"

#ifdef SPRINGFOLD_COUNTS_ALLOCATIONS
long allocations = 0;
// Every allocation of this program is counted, Eigen's too.
extern "C" void* __libc_malloc(std::size_t);
extern "C" void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}

namespace springfold::analysis {
namespace {

/// The tool pushed by lambda along a direction, or moved where `held`.
PathProblem problem_of(const model::SpringLaw& knee, bool held) {
  const statics::System system = statics::prepare(orthoglide(knee));
  const Vector along = Vector{{1, -0.3}}.normalized(), none = Vector::Zero(2);
  PathRule rule{.t_start = none, .t_rate = held ? along : none};
  rule.N = held ? Matrix(Vector{{-along[1], along[0]}}) : Matrix(Matrix::Identity(2, 2));
  rule.rho_start = system.commands;
  rule.rho_rate = none;
  rule.W_start = none;
  rule.W_rate = held ? none : along;
  return {system, rule};
}

TEST(EquationsOfAPath, NeedNoMemoryAfterTheFirstTime) {
  for (const bool held : {false, true}) {
    const PathProblem problem = problem_of(linear(0.05), held);
    Vector y = Vector::Constant(problem.size(), 0.05), F, b;
    Matrix A;
    ASSERT_TRUE(problem.residual(y, 0, {}, F) && problem.derivatives(y, 0, {}, A, b));
    const long before = allocations;
    bool inside = true;
    for (int k = 1; k <= 50; ++k) {
      y[0] = 1e-3 * k;
      inside = problem.residual(y, y[0], {}, F) && problem.derivatives(y, y[0], {}, A, b) && inside;
    }
    EXPECT_EQ(allocations, before) << (held ? "held" : "free");
    EXPECT_TRUE(inside);
    const std::vector<int> counted(10);
    EXPECT_GT(allocations, before);  // the counter counts
  }
}

long allocations_for(const PathProblem& problem, int points) {
  continuation::TraceOptions options;
  options.step.initial = options.step.maximum = 1e-3;
  options.maximum_points = points;
  const Vector start = problem.reduce(statics::guess(problem.layout()));
  const auto rays = continuation::rays_from(problem, start, 0, {}, options);
  const long before = allocations;
  const auto curve = continuation::trace(problem, start, 0, rays.rays.front(), {}, options);
  EXPECT_EQ(curve.points.size(), static_cast<std::size_t>(points));
  EXPECT_TRUE(curve.hits.empty() && curve.log.empty());
  return allocations - before;
}

/// Two vectors of every point are kept. The rest is what the examination of a step and the search for special
/// points still ask for, see docs/performance.md.
TEST(AStep, TakesMemoryABoundedNumberOfTimes) {
  constexpr long at_most = 44;
  const PathProblem problem = problem_of(linear(0.05), false);
  const long few = allocations_for(problem, 50), many = allocations_for(problem, 150);
  EXPECT_LE(many - few, 100 * at_most) << static_cast<double>(many - few) / 100 << " per step";
}

}  // namespace
}  // namespace springfold::analysis
#endif
