// Memory from the heap: none for the equations of a path, and for a step only what is kept of it.
#include <gtest/gtest.h>

#include "path_problems.hpp"
#include "springfold/continuation/trace.hpp"
#include "statics/allocations.hpp"

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

/// Allocations of a trace with so many points.
long allocations_for(const PathProblem& problem, int points,
                     const std::vector<continuation::Event>& events = {}) {
  continuation::TraceOptions options;
  options.step.initial = options.step.maximum = 1e-3;
  options.maximum_points = points;
  const Vector start = problem.reduce(statics::guess(problem.layout()));
  const auto rays = continuation::rays_from(problem, start, 0, piece_at(problem, start), options);
  const long before = allocations;
  const auto curve = continuation::trace(problem, start, 0, rays.rays.front(), events, options);
  EXPECT_EQ(curve.points.size(), static_cast<std::size_t>(points)) << curve.stop_detail;
  EXPECT_TRUE(curve.hits.empty() && curve.log.empty());
  return allocations - before;
}

/// Of one step, beyond the list of points, which grows a few times.
double per_step(const PathProblem& problem, const std::vector<continuation::Event>& events = {}) {
  constexpr int few = 50, many = 250;
  allocations_for(problem, many, events);  // the problem keeps memory that it needs on the way
  const long extra = allocations_for(problem, many, events) - allocations_for(problem, few, events);
  return static_cast<double>(extra) / (many - few);
}

/// The position and the tangent of the point that is kept, and its piece where there are switches.
TEST(AStep, AsksForNoMemoryButThatOfThePointItKeeps) {
  constexpr double point = 2, list = 0.05;
  EXPECT_LE(per_step(problem_of(linear(0.05), false)), point + list);
  EXPECT_LE(per_step(problem_of(linear(0.05), true)), point + list);
  EXPECT_LE(per_step(column(30)), point + list);
  EXPECT_LE(per_step(problem_of(one_sided(0.05, 0.8), false)), point + 4 + list);
}

TEST(AStep, AsksForNoMoreWhereAChainIsEvaluatedInStages) {
  using enum model::TaskSpace;
  constexpr double point = 2, list = 0.05;
  for (const auto& [links, space] :
       {std::pair{60, xy}, std::pair{200, xy}, std::pair{60, planar}, std::pair{60, spatial}}) {
    const PathProblem problem = column(links, space);
    ASSERT_TRUE(problem.structured());
    EXPECT_LE(per_step(problem), point + list)
        << links << " links, " << model::dimension(space) << " coordinates of the tip";
  }
  for (const bool held : {false, true}) {
    const PathProblem closed = bows(60, 5, held);
    ASSERT_TRUE(closed.structured());
    EXPECT_LE(per_step(closed), point + list) << (held ? "held" : "free");
  }
}

TEST(AStep, AsksForNoneWhereEventsAreWatchedEither) {
  const std::vector<continuation::Event> far{
      {"far", [](const continuation::CurvePoint& p) { return p.lambda - 5; }}};
  EXPECT_LE(per_step(problem_of(linear(0.05), false), far), 2.05);
}

}  // namespace
}  // namespace springfold::analysis
#endif
