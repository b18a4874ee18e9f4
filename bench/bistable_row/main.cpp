// Are the stable states of a row of bistable units with springs between neighbours all there are? The graph that
// springfold finds at zero load, against minima that a search of its own finds from random starts in the closed form of
// the energy.
//
//     build/release/bench/bistable_row [units] [coupling] [starts] [seed]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "random_mechanism.hpp"
#include "springfold/analysis/snap.hpp"

namespace {

using namespace springfold;
using bench::Unit;

/// The energy of the row in its own coordinates: gradient and Hessian.
struct Row {
  std::vector<Unit> units{};
  double coupling = 0;

  Vector gradient(const Vector& x) const {
    Vector g(x.size());
    for (Index i = 0; i < x.size(); ++i) {
      const Unit& u = units[static_cast<std::size_t>(i)];
      const double length = std::hypot(Unit::foot, x[i]);
      g[i] = u.straight * (x[i] - u.free) + u.oblique * (length - u.length) * x[i] / length;
      if (i > 0) g[i] += coupling * (x[i] - x[i - 1]);
      if (i + 1 < x.size()) g[i] += coupling * (x[i] - x[i + 1]);
    }
    return g;
  }
  Matrix hessian(const Vector& x) const {
    Matrix H = Matrix::Zero(x.size(), x.size());
    for (Index i = 0; i < x.size(); ++i) {
      const Unit& u = units[static_cast<std::size_t>(i)];
      const double length = std::hypot(Unit::foot, x[i]);
      H(i, i) += u.straight +
                 u.oblique * (1 - u.length / length * Unit::foot * Unit::foot / (length * length));
      if (i == 0) continue;
      H(i, i) += coupling;
      H(i - 1, i - 1) += coupling;
      H(i, i - 1) -= coupling;
      H(i - 1, i) -= coupling;
    }
    return H;
  }
  /// Downhill by short steps, then Newton's method.
  std::optional<Vector> minimum(Vector x) const {
    constexpr int down = 400, polish = 30;
    for (int k = 0; k < down; ++k) x -= 0.25 * gradient(x);
    for (int k = 0; k < polish; ++k) {
      const Vector step = hessian(x).ldlt().solve(gradient(x));
      x -= step;
      if (step.norm() < 1e-14) break;
    }
    const bool is_minimum = gradient(x).norm() < 1e-12 && hessian(x).llt().info() == Eigen::Success;
    return is_minimum ? std::optional(x) : std::nullopt;
  }
};

void add_new(const Vector& x, std::vector<Vector>& list) {
  const bool known = std::any_of(list.begin(), list.end(), [&](const Vector& other) {
    return (other - x).lpNorm<Eigen::Infinity>() < 1e-7;
  });
  if (!known) list.push_back(x);
}

std::vector<Vector> by_random_starts(const Row& row, int starts, std::mt19937_64& random) {
  std::vector<Vector> found;
  for (int s = 0; s < starts; ++s) {
    Vector x(static_cast<Index>(row.units.size()));
    for (double& value : x) value = bench::uniform(random, -2.5, 2.5);
    if (const auto at = row.minimum(x)) add_new(*at, found);
  }
  return found;
}

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The states of the graph that exist at zero load, as coordinates of the units there.
std::vector<Vector> by_springfold(const Row& row, analysis::SnapResult& result) {
  const bench::Draw draw = bench::row_of(row.units, row.coupling);
  analysis::SnapSettings settings{.starts = 0};
  settings.transitions = analysis::TransitionSettings{.search_at = {0}, .maximum = 100000};
  result = analysis::run_with_jumps(draw.mechanism, draw.study, nullptr, settings);
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < row.units.size(); ++i)
    for (std::size_t q = 0; q < result.traced.quantities.size(); ++q)
      if (result.traced.quantities[q].name == "row.unit" + std::to_string(i + 1))
        columns.push_back(q);
  std::vector<Vector> found;
  for (const analysis::StableState& state : result.report.transitions->states) {
    if (!(state.low < 0 && state.high > 0)) continue;
    // The row nearest to zero load is in the valley of the state there.
    const auto& samples =
        result.traced.branches[static_cast<std::size_t>(state.branch - 1)].samples;
    std::size_t lambda = 0;
    while (result.traced.quantities[lambda].name != "lambda") ++lambda;
    const auto near = std::min_element(samples.begin(), samples.end(), [&](auto& a, auto& b) {
      return std::abs(a.values[lambda]) < std::abs(b.values[lambda]);
    });
    Vector x(static_cast<Index>(columns.size()));
    for (std::size_t i = 0; i < columns.size(); ++i)
      x[static_cast<Index>(i)] = near->values[columns[i]];
    if (const auto at = row.minimum(x)) add_new(*at, found);
  }
  return found;
}

}  // namespace

int main(int argc, char** argv) {
  const auto number = [&](int i, double otherwise) {
    return argc > i ? std::strtod(argv[i], nullptr) : otherwise;
  };
  std::mt19937_64 random(static_cast<unsigned>(number(4, 1)));
  const Row row{bench::random_units(random, static_cast<int>(number(1, 6))), number(2, 0.02)};
  const double begin = seconds();
  analysis::SnapResult result;
  const auto own = by_springfold(row, result);
  const double graph = seconds() - begin;
  const auto& report = *result.report.transitions;
  std::printf(
      "springfold: %zu states at zero load (%zu in all, %zu transitions, closed: %d), %.1f s\n",
      own.size(), report.states.size(), report.transitions.size(), report.is_closed, graph);
  for (const auto& doubt : result.traced.doubts) std::printf("doubt: %s\n", doubt.c_str());
  const auto starts = static_cast<int>(number(3, 100000));
  if (starts == 0) return EXIT_SUCCESS;
  auto other = by_random_starts(row, starts, random);
  const std::size_t found = other.size();
  std::size_t missed = 0, common = 0;
  for (const Vector& x : own) {
    const std::size_t before = other.size();
    add_new(x, other);
    common += other.size() == before ? 1 : 0;
  }
  missed = found - common;
  std::printf(
      "random starts: %zu states of %d starts, %.1f s; in common %zu, missed by the graph %zu\n",
      found, starts, seconds() - begin - graph, common, missed);
  return missed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
