// What a chain of N joints costs in stages: evaluation, factorisation with one border, solution, count.
#include <benchmark/benchmark.h>

#include "springfold/statics/stages.hpp"

namespace {

using namespace springfold;

constexpr double load = -2;  // below the first buckling load

/// N links of length 1/N on torsion springs N, as in the closed form of the straight chain.
model::Mechanism planar_chain(int N) {
  model::Mechanism m;
  m.bodies = {{"tip", model::TaskSpace::xy, Vector{{1, 0}}}};
  m.chains = {{.name = "chain"}};
  for (int i = 0; i < N; ++i) {
    m.chains[0].elements.push_back(model::Joint{.name = "hinge" + std::to_string(i),
                                                .role = model::JointRole::compliant,
                                                .spring = model::LinearSpring{double(N), 0},
                                                .initial = 0.3 / N});
    m.chains[0].elements.push_back(
        model::RigidLink{{model::Mat3<double>::Identity(), {1.0 / N, 0, 0}}});
  }
  return m;
}

/// A beam of N / 6 segments, each with six virtual joints and one 6x6 spring.
model::Mechanism spatial_beam(int N) {
  const int segments = N / 6;
  model::Mechanism m;
  m.bodies = {{"tip", model::TaskSpace::spatial, Vector::Unit(6, 0)}};
  m.chains = {{.name = "beam"}};
  model::Chain& chain = m.chains[0];
  const Vector stiffness{{1e4, 1e3, 1e3, 1, 2, 2}};
  for (int s = 0; s < segments; ++s) {
    chain.elements.push_back(
        model::RigidLink{{model::Mat3<double>::Identity(), {1.0 / segments, 0, 0}}});
    model::CoupledSpring spring{.name = "s" + std::to_string(s)};
    for (Index i = 0; i < 6; ++i) {
      spring.elements.push_back(chain.elements.size());
      chain.elements.push_back(
          model::Joint{.name = "j" + std::to_string(6 * s + i),
                       .kind = i < 3 ? model::JointKind::prismatic : model::JointKind::revolute,
                       .axis = model::Vec3<double>::Unit(i % 3),
                       .role = model::JointRole::compliant,
                       .initial = 0.1 / N});
    }
    spring.stiffness = Matrix(segments * stiffness.asDiagonal());
    spring.free = Vector::Zero(6);
    chain.coupled_springs.push_back(spring);
  }
  return m;
}

struct LongChain {
  statics::System system;
  statics::StagePlan plan;
  statics::StageSolver solver;
  statics::StageMatrix matrix{};
  statics::Inputs inputs{};
  Vector z{}, residual{};
  FrontalBorders borders{};

  explicit LongChain(const model::Mechanism& m)
      : system{statics::prepare(m)}, plan{statics::plan_stages(system)}, solver{plan} {
    inputs = {system.commands, Vector::Zero(system.load_size)};
    z = guess(system);
    z[system.chain_slices[0].F] = load;
    const Vector ones = Vector::Ones(plan.size());
    borders = {ones, ones, Matrix::Zero(1, 1)};
    evaluate();
    solver.factorise(matrix, borders);
  }
  bool evaluate() {
    return equilibrium_stages(plan, system, {}, z, inputs, {}, {}, residual, matrix);
  }
};

void report(benchmark::State& state) {
  using benchmark::Counter;
  state.counters["per_joint"] = Counter(static_cast<double>(state.range(0)),
                                        Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.SetComplexityN(state.range(0));
}

template <auto mechanism>
void evaluate_in_stages(benchmark::State& state) {
  LongChain chain(mechanism(static_cast<int>(state.range(0))));
  for (auto _ : state) benchmark::DoNotOptimize(chain.evaluate());
  report(state);
}

template <auto mechanism>
void factorise_in_stages(benchmark::State& state) {
  LongChain chain(mechanism(static_cast<int>(state.range(0))));
  for (auto _ : state)
    benchmark::DoNotOptimize(chain.solver.factorise(chain.matrix, chain.borders));
  report(state);
}

template <auto mechanism>
void solve_in_stages(benchmark::State& state) {
  LongChain chain(mechanism(static_cast<int>(state.range(0))));
  const Matrix right = Matrix::Ones(chain.plan.size() + 1, 1);
  Matrix X;
  for (auto _ : state) {
    X = right;
    benchmark::DoNotOptimize(chain.solver.solve(X));
  }
  report(state);
}

template <auto mechanism>
void inertia_in_stages(benchmark::State& state) {
  LongChain chain(mechanism(static_cast<int>(state.range(0))));
  for (auto _ : state) benchmark::DoNotOptimize(chain.solver.inertia());
  report(state);
}

/// The residual alone as it is evaluated without stages: linear in N, too, without loads at points.
template <auto mechanism>
void residual_of_a_long_chain(benchmark::State& state) {
  LongChain chain(mechanism(static_cast<int>(state.range(0))));
  statics::Workspace work;
  for (auto _ : state)
    benchmark::DoNotOptimize(statics::equilibrium_residual(chain.system, {}, chain.z, chain.inputs,
                                                           work, chain.residual));
  report(state);
}

void lengths(benchmark::internal::Benchmark* b) {
  for (const int N : {102, 300, 1002, 3000, 10002}) b->Arg(N);
  b->Unit(benchmark::kMicrosecond)->Complexity();
}

BENCHMARK(evaluate_in_stages<planar_chain>)->Apply(lengths);
BENCHMARK(factorise_in_stages<planar_chain>)->Apply(lengths);
BENCHMARK(solve_in_stages<planar_chain>)->Apply(lengths);
BENCHMARK(inertia_in_stages<planar_chain>)->Apply(lengths);
BENCHMARK(residual_of_a_long_chain<planar_chain>)->Apply(lengths);
BENCHMARK(evaluate_in_stages<spatial_beam>)->Apply(lengths);
BENCHMARK(factorise_in_stages<spatial_beam>)->Apply(lengths);
BENCHMARK(solve_in_stages<spatial_beam>)->Apply(lengths);

}  // namespace
