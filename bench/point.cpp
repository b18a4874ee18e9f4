// What an accepted point costs, and its floor: the evaluations, the factorisation and the solves
// without which there is no point, made of the same kernels (docs/performance.md).
#include <benchmark/benchmark.h>

#include <Eigen/LU>

#include "springfold/continuation/newton.hpp"
#include "springfold/statics/stiffness.hpp"
#include "walk.hpp"

namespace {

using namespace springfold;
using bench::Walk;
using benchmark::Counter;

/// Arc length from point to point at which the corrector needs one or two steps.
constexpr double step = 0.005;

/// Stiffness of one leg with the tool displaced: the leg's unknowns eliminated.
void chain_condensation(benchmark::State& state) {
  const Walk walk;
  Matrix A;
  Vector b;
  walk.path.derivatives(walk.from.x, walk.from.lambda, A, b);
  for (auto _ : state)
    benchmark::DoNotOptimize(statics::chain_stiffness(walk.path.system, 0, A, walk.path.work));
}
BENCHMARK(chain_condensation);

/// Derivatives at a point and one solve of the bordered system.
void newton_step(benchmark::State& state) {
  const Walk walk;
  continuation::Linearisation at;
  Vector F;
  for (auto _ : state) {
    walk.path.residual(walk.from.x, walk.from.lambda, F);
    if (!continuation::linearise(walk.path, walk.from.x, walk.from.lambda, {}, at))
      state.SkipWithError("outside of the domain");
    benchmark::DoNotOptimize(
        continuation::solve_bordered(at, walk.walker.weights, walk.from.tangent, -F, 0));
  }
}
BENCHMARK(newton_step);

/// Residual and matrix at the predicted point, one factorisation, the correction; residual and
/// matrix at the new point, and from the factorisation at hand three more solves: tangent, test
/// function of branch points, count of negative eigenvalues.
void floor_of_a_point(benchmark::State& state) {
  const Walk walk;
  const Index n = walk.path.size();
  Matrix A(n, n), bordered = Matrix::Zero(n + 1, n + 1);
  Vector b(n), F(n), right = Vector::Ones(n + 1), solution(n + 1);
  Eigen::PartialPivLU<Matrix> lu(n + 1);
  bordered.row(n).head(n) = walk.from.tangent.dx.transpose();
  bordered(n, n) = walk.from.tangent.dlambda;
  for (auto _ : state) {
    for (int point = 0; point < 2; ++point) {
      walk.path.residual(walk.from.x, walk.from.lambda, F);
      walk.path.derivatives(walk.from.x, walk.from.lambda, A, b);
    }
    bordered.topLeftCorner(n, n) = A;
    bordered.col(n).head(n) = b;
    lu.compute(bordered);
    for (int solve = 0; solve < 4; ++solve) {
      solution.noalias() = lu.solve(right);
      benchmark::DoNotOptimize(solution.data());
    }
  }
}
BENCHMARK(floor_of_a_point)->Unit(benchmark::kMicrosecond);

/// A trace of a thousand points with limit points, branch points and counts; the counter per_point is to be
/// compared with the floor.
/// @param verified  every step is examined for a jump to another branch as well
template <bool verified>
void accepted_point(benchmark::State& state) {
  const Walk walk;
  continuation::TraceOptions options;
  options.verify = verified;
  options.step.initial = options.step.maximum = step;
  options.maximum_points = 1000;
  double points = 0;
  for (auto _ : state)
    points += static_cast<double>(continuation::trace(walk.path, walk.from.x, walk.from.lambda,
                                                      {{}, walk.from.tangent}, {}, options)
                                      .points.size());
  state.counters["per_point"] = Counter(points, Counter::kIsRate | Counter::kInvert);
}
BENCHMARK(accepted_point<false>)->Unit(benchmark::kMillisecond);
BENCHMARK(accepted_point<true>)->Unit(benchmark::kMillisecond);

}  // namespace
