// What the parts of a curve cost, from the closure of one leg to one accepted step: the planar
// Orthoglide under a growing force along the diagonal.
#include <benchmark/benchmark.h>

#include <cmath>

#include "continuation/points/locate.hpp"
#include "orthoglide.hpp"
#include "springfold/continuation/trace.hpp"
#include "springfold/core/inertia.hpp"
#include "springfold/statics/first_equilibrium.hpp"
#include "springfold/statics/stiffness.hpp"
#include "walk.hpp"

namespace {

using namespace springfold;
using bench::Walk;
using continuation::CurvePoint;

void closure_and_jacobian(benchmark::State& state) {
  const model::Mechanism m = bench::orthoglide();
  const model::CompiledChain chain = compile(m, m.chains[0]);
  const Vector v{{-0.9, 0.2, 0.1, 0.2}};
  model::Closure<double> at;
  for (auto _ : state) {
    model::evaluate_closure<double>(chain, v, nullptr, at);
    benchmark::DoNotOptimize(at.J.data());
  }
}
BENCHMARK(closure_and_jacobian);

void closure_with_hessian(benchmark::State& state) {
  const model::Mechanism m = bench::orthoglide();
  const model::CompiledChain chain = compile(m, m.chains[0]);
  const Vector v{{-0.9, 0.2, 0.1, 0.2}}, F{{1, 2}};
  model::Closure<double> at;
  for (auto _ : state) {
    model::evaluate_closure<double>(chain, v, &F, at);
    benchmark::DoNotOptimize(at.H.data());
  }
}
BENCHMARK(closure_with_hessian);

void spatial_closure_with_hessian(benchmark::State& state) {
  const auto joints = static_cast<Index>(state.range(0));
  model::CompiledChain chain;
  for (Index j = 0; j < joints; ++j)
    chain.joints.push_back(
        {{model::Mat3<double>::Identity(), {0.3, 0.1, 0}}, model::Vec3<double>::Unit(j % 3), true});
  const Vector v = Vector::LinSpaced(chain.variable_count(), 0.1, 0.8), F = Vector::Ones(6);
  model::Closure<double> at;
  for (auto _ : state) {
    model::evaluate_closure<double>(chain, v, &F, at);
    benchmark::DoNotOptimize(at.H.data());
  }
}
BENCHMARK(spatial_closure_with_hessian)->Arg(6)->Arg(12)->Arg(24);

void equilibrium_matrix(benchmark::State& state) {
  const Walk walk;
  Matrix A;
  Vector b;
  for (auto _ : state)
    benchmark::DoNotOptimize(walk.path.derivatives(walk.from.x, walk.from.lambda, A, b));
}
BENCHMARK(equilibrium_matrix);

void inertia(benchmark::State& state) {
  const Walk walk;
  Matrix A;
  Vector b;
  walk.path.derivatives(walk.from.x, walk.from.lambda, A, b);
  for (auto _ : state) benchmark::DoNotOptimize(inertia_of(A));
}
BENCHMARK(inertia);

void platform_stiffness_and_indices(benchmark::State& state) {
  const Walk walk;
  Matrix A;
  Vector b;
  walk.path.derivatives(walk.from.x, walk.from.lambda, A, b);
  for (auto _ : state) {
    benchmark::DoNotOptimize(statics::platform_stiffness(walk.path.system, A).eigenvalues.data());
    benchmark::DoNotOptimize(statics::stability(walk.path.system, A));
  }
}
BENCHMARK(platform_stiffness_and_indices)->Unit(benchmark::kMicrosecond);

/// About 0.02, never the same twice in a while: a walker remembers the last places at which it was.
class Lengths {
 public:
  double next() { return 0.02 * (1 + 1e-6 * (count_++ % 64)); }

 private:
  int count_ = 0;
};

void newton_corrector(benchmark::State& state) {
  const Walk walk;
  Lengths lengths;
  Vector x;
  double iterations = 0;
  for (auto _ : state) {
    const double ds = lengths.next();
    x = walk.from.x + ds * walk.from.tangent.dx;
    iterations += continuation::correct(walk.path, walk.walker.weights, x,
                                        walk.from.lambda + ds * walk.from.tangent.dlambda, {},
                                        walk.from.tangent, {})
                      .iterations;
  }
  state.counters["iterations"] = benchmark::Counter(iterations, benchmark::Counter::kAvgIterations);
}
BENCHMARK(newton_corrector)->Unit(benchmark::kMicrosecond);

void one_step(benchmark::State& state) {
  const Walk walk;
  Lengths lengths;
  for (auto _ : state)
    benchmark::DoNotOptimize(
        continuation::try_step(walk.walker, walk.from, lengths.next()).point.has_value());
}
BENCHMARK(one_step)->Unit(benchmark::kMicrosecond);

void event_location(benchmark::State& state) {
  const Walk walk;
  Lengths lengths;
  const double wanted = walk.from.x.tail(1)[0] + 0.013 * walk.from.tangent.dx.tail(1)[0];
  const auto value = [wanted](const CurvePoint& p) { return p.x.tail(1)[0] - wanted; };
  for (auto _ : state)
    benchmark::DoNotOptimize(
        continuation::locate(walk.walker, walk.from, 0, lengths.next(), value).has_value());
}
BENCHMARK(event_location)->Unit(benchmark::kMicrosecond);

/// A whole trace of two hundred points; the counter per_point is the time for one of them.
void trace_of_the_load_path(benchmark::State& state) {
  const Walk walk;
  continuation::TraceOptions options;
  options.maximum_points = 200;
  double points = 0;
  for (auto _ : state)
    points += static_cast<double>(continuation::trace(walk.path, walk.from.x, walk.from.lambda,
                                                      {{}, walk.from.tangent}, {}, options)
                                      .points.size());
  using benchmark::Counter;
  state.counters["per_point"] = Counter(points, Counter::kIsRate | Counter::kInvert);
}
BENCHMARK(trace_of_the_load_path)->Unit(benchmark::kMillisecond);

}  // namespace
