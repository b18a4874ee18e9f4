// What the jumps of a curve cost: the planar Orthoglide pushed along its diagonal, traced with its jumps there and
// back, less the trace alone.
#include <benchmark/benchmark.h>

#include <cmath>

#include "springfold/analysis/snap.hpp"

namespace {

using namespace springfold;

/// Drives of stiffness 1, legs of length 1, at the pose Q2 of the paper, without knee springs.
model::Chain leg(const char* name, const model::Vec3<double>& axis,
                 const model::Vec3<double>& knee_axis, double command) {
  const model::Joint drive{.name = "drive",
                           .kind = model::JointKind::prismatic,
                           .axis = axis,
                           .role = model::JointRole::actuated,
                           .spring = model::LinearSpring{.stiffness = 1},
                           .command = command};
  const model::Joint knee{.name = "knee", .axis = knee_axis};
  model::RigidLink link;
  link.transform.p = -axis;
  return {.name = name, .elements = {drive, knee, link}};
}

void trace(benchmark::State& state, bool with_jumps) {
  constexpr double pose = 0.454;
  const double command = pose + std::sqrt(1 - pose * pose);
  model::Mechanism mechanism{
      .bodies = {{.name = "tool",
                  .task_space = model::TaskSpace::xy,
                  .pose = Vector::Constant(2, pose)}},
      .chains = {
          leg("leg_x", model::Vec3<double>::UnitX(), -model::Vec3<double>::UnitZ(), command),
          leg("leg_y", model::Vec3<double>::UnitY(), model::Vec3<double>::UnitZ(), command)}};
  analysis::Study study{.name = "Q2", .direction = Vector::Constant(2, std::sqrt(0.5))};
  study.until = {{"tool.x", 0.3, 0.97}};
  study.branches.depth = 1;
  std::size_t jumps = 0;
  for (auto _ : state) {
    if (with_jumps) {
      const auto result = analysis::run_with_jumps(mechanism, study);
      jumps = result.report.jumps.size();
    } else {
      benchmark::DoNotOptimize(analysis::run_study(mechanism, study).branches.size());
    }
  }
  state.counters["jumps"] = static_cast<double>(jumps);
}

void orthoglide_without_jumps(benchmark::State& state) { trace(state, false); }
BENCHMARK(orthoglide_without_jumps)->Unit(benchmark::kMillisecond);

void orthoglide_with_its_jumps(benchmark::State& state) { trace(state, true); }
BENCHMARK(orthoglide_with_its_jumps)->Unit(benchmark::kMillisecond);

}  // namespace
