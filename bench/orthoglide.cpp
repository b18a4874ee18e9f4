// What a curve costs: the planar Orthoglide (paper Section 6) with linear preload springs, pushed
// along the diagonal. The counter per_point is the time per accepted point of the branch.
#include "orthoglide.hpp"

#include <benchmark/benchmark.h>

#include <cmath>

#include "springfold/analysis/run.hpp"

namespace {

using springfold::Vector;
namespace analysis = springfold::analysis;
namespace model = springfold::model;
using springfold::bench::orthoglide;

analysis::Study push(analysis::StudyKind kind) {
  analysis::Study study{.name = "push", .kind = kind, .control = analysis::ControlMode::mixed};
  study.direction = Vector::Constant(2, -std::sqrt(0.5));
  study.until = {{.quantity = "lambda", .low = -0.5, .high = 0.5}};
  return study;
}

void whole_branch(benchmark::State& state) {
  const model::Mechanism mechanism = orthoglide();
  const analysis::Study study = push(analysis::StudyKind::force_deflection);
  double points = 0;
  for (auto _ : state) {
    const analysis::StudyResult result = analysis::run_study(mechanism, study);
    if (!complete(result)) state.SkipWithError("the branch is not complete");
    for (const analysis::Branch& branch : result.branches)
      points += static_cast<double>(branch.samples.size());
  }
  using benchmark::Counter;
  state.counters["per_point"] = Counter(points, Counter::kIsRate | Counter::kInvert);
  state.counters["points"] = Counter(points, Counter::kAvgIterations);
}
BENCHMARK(whole_branch)->Unit(benchmark::kMillisecond);

void first_equilibrium(benchmark::State& state) {
  const model::Mechanism mechanism = orthoglide();
  const analysis::Study study = push(analysis::StudyKind::equilibrium);
  for (auto _ : state) benchmark::DoNotOptimize(analysis::run_study(mechanism, study).start.found);
}
BENCHMARK(first_equilibrium)->Unit(benchmark::kMicrosecond);

}  // namespace
