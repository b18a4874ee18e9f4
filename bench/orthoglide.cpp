// What a curve costs: the planar Orthoglide (paper Section 6) with linear preload springs, pushed
// along the diagonal. The counter per_point is the time per accepted point of the branch.
#include <benchmark/benchmark.h>

#include <cmath>

#include "springfold/analysis/run.hpp"
#include "springfold/statics/system.hpp"

namespace {

using springfold::Vector;
namespace analysis = springfold::analysis;
namespace model = springfold::model;
namespace statics = springfold::statics;

using Axis = model::Vec3<double>;

/// Slider of stiffness 1 along `axis`, knee with preload stiffness 0.01, link of length 1.
model::Chain leg(const char* name, const Axis& axis) {
  const model::Joint drive{.name = "drive",
                           .kind = model::JointKind::prismatic,
                           .axis = axis,
                           .role = model::JointRole::actuated,
                           .spring = model::LinearSpring{.stiffness = 1},
                           .command = -1};
  const model::Joint knee{.name = "knee",
                          .role = model::JointRole::preloaded,
                          .spring = model::LinearSpring{.stiffness = 0.01}};
  model::RigidLink link;
  link.transform.p = axis;
  return {.name = name, .elements = {drive, knee, link}};
}

model::Mechanism orthoglide() {
  return {.bodies = {{.name = "tool", .task_space = model::TaskSpace::xy, .pose = Vector::Zero(2)}},
          .chains = {leg("leg_x", Axis::UnitX()), leg("leg_y", Axis::UnitY())}};
}

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

void equilibrium_matrix(benchmark::State& state) {
  const statics::System system = statics::prepare(orthoglide());
  const Vector z = statics::guess(system);
  const springfold::Piece piece = statics::piece_at(system, z);
  const statics::Inputs inputs{.rho = system.commands, .W = Vector::Zero(system.load_size)};
  statics::Workspace work;
  Vector residual;
  springfold::Matrix A;
  for (auto _ : state)
    benchmark::DoNotOptimize(
        statics::equilibrium_matrix(system, piece, z, inputs, work, residual, A));
}
BENCHMARK(equilibrium_matrix)->Unit(benchmark::kMicrosecond);

}  // namespace
