// What inverse kinetostatics costs: one command of the planar Orthoglide on a circle, from the
// solution before it as on-line use does, and from the plain inverse kinematics as maps do.
#include <benchmark/benchmark.h>

#include <cmath>

#include "orthoglide.hpp"
#include "springfold/statics/kinetostatic_control.hpp"

namespace {

using namespace springfold;

void warm_started_command(benchmark::State& state) {
  const statics::System system = statics::prepare(bench::orthoglide());
  auto solver =
      statics::control_solver(system, {}, statics::guess(system), Vector::Constant(2, -1));
  const Vector W{{0.001, -0.002}};
  Vector target{{0.35, 0}};
  if (!solve_control(system, solver, target, W)) state.SkipWithError("no first solution");
  double iterations = 0, angle = 0;
  for (auto _ : state) {
    angle += 0.01;
    target[0] = 0.35 * std::cos(angle);
    target[1] = 0.35 * std::sin(angle);
    if (!solve_control(system, solver, target, W)) state.SkipWithError("not solved");
    iterations += solver.iterations;
  }
  state.counters["iterations"] = benchmark::Counter(iterations, benchmark::Counter::kAvgIterations);
}
BENCHMARK(warm_started_command)->Unit(benchmark::kMicrosecond);

void command_from_inverse_kinematics(benchmark::State& state) {
  const statics::System system = statics::prepare(bench::orthoglide());
  statics::ControlProblem problem{.target = Vector{{0.3, 0.2}},
                                  .W = Vector::Zero(2),
                                  .z = statics::guess(system),
                                  .rho = Vector::Constant(2, -1)};
  for (auto _ : state)
    benchmark::DoNotOptimize(statics::kinetostatic_control(system, problem).iterations);
}
BENCHMARK(command_from_inverse_kinematics)->Unit(benchmark::kMicrosecond);

}  // namespace
