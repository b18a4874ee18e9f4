#include "path_work.hpp"

#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>

#include "curve_chord.hpp"
#include "springfold/continuation/newton.hpp"
#include "springfold/core/differences.hpp"

namespace springfold::analysis {
namespace {

using continuation::Direction;

/// Gauss' rule on [-1, 1]: exact up to degree 11.
constexpr std::array<std::pair<double, double>, 3> gauss{
    {{0.2386191860831969, 0.4679139345726910},
     {0.6612093864662645, 0.3607615730481386},
     {0.9324695142031521, 0.1713244923791704}}};
/// Difference steps in lambda, where its unit is that of the path: error O(h^6). The unit may be long beside a spring,
/// and a spring may switch nearby: shorter ones follow until two agree.
constexpr std::array difference_steps{1e-2, 2e-3, 4e-4, 8e-5};
/// Two that differ by less, relative to what they are differences of, agree to rounding.
constexpr double agreed = 1e-12;

/// Pi and the closures times their wrenches: stationary at an equilibrium, so its derivative by lambda at
/// fixed unknowns is that of Pi along the path.
std::optional<Vector> lagrangian(const PathProblem& problem, const Vector& x, double lambda,
                                 const Piece& piece) {
  Vector F;
  if (!problem.residual(x, lambda, piece, F)) return std::nullopt;
  double value = path_energy(problem, {x, lambda});
  const statics::System& system = problem.layout();
  for (Index i = 0; i < system.first_pose; ++i)
    if (system.is_wrench[static_cast<std::size_t>(i)]) value += x[i] * F[i];
  return Vector::Constant(1, value);
}

/// The derivative by lambda at fixed unknowns: of all steps that which the next one changes least.
std::optional<double> rate_by_lambda(const PathProblem& problem, const Vector& x, double lambda,
                                     const Piece& piece) {
  const auto value = [&](double at) { return lagrangian(problem, x, at, piece); };
  std::optional<double> before, best;
  double least = std::numeric_limits<double>::infinity();
  for (const double h : difference_steps) {
    const auto rate = six_point_derivative(value, lambda, h);
    if (!rate) continue;  // the path does not reach so far
    const double here = (*rate)[0];
    const double change = before ? std::abs(here - *before) : least;
    if (!best || change < least) best = here;
    least = std::min(least, change);
    if (least <= agreed * std::max(1.0, std::abs(here))) break;
    before = here;
  }
  return best;
}

std::optional<Piece> piece_between(const PathProblem& problem, const PathState& from,
                                   const PathState& to) {
  Vector g;
  if (!problem.switches((from.x + to.x) / 2, (from.lambda + to.lambda) / 2, g)) return std::nullopt;
  Piece piece(static_cast<std::size_t>(g.size()), std::int8_t{1});
  for (Index j = 0; j < g.size(); ++j)
    if (g[j] < 0) piece[static_cast<std::size_t>(j)] = -1;
  return piece;
}

}  // namespace

double path_energy(const PathProblem& problem, const PathState& state) {
  const Vector z = problem.expand(state.x, state.lambda);
  const statics::Inputs inputs = problem.inputs(state.lambda);
  const statics::System& system = problem.system(state.lambda);
  return spring_energy(system, z, inputs.rho) + load_potential(system, z, inputs);
}

std::optional<PathState> state_at_level(const PathProblem& problem, const PathState& from,
                                        const PathState& to, double target) {
  const CurveChord chord(problem, from, to);
  if (!chord.is_a_way()) return from;
  const auto piece = piece_between(problem, from, to);
  if (!piece) return std::nullopt;
  // Beside a limit load lambda hardly changes along the curve, and at constant lambda the state is hardly determined:
  // the way along the chord determines it.
  const auto state_at = [&](double part) { return chord.at(part, *piece); };
  bool is_known = true;
  const auto missing = [&](double part) {
    const auto state = state_at(part);
    is_known = is_known && state;
    return state ? state->lambda - target : 0;
  };
  const double before = from.lambda - target, behind = to.lambda - target;
  if (before == 0) return from;
  if (behind == 0) return to;
  if ((before < 0) == (behind < 0)) return std::nullopt;
  std::uintmax_t most = 100;
  const auto is_close = [](double a, double b) {
    return std::abs(a - b) <= 2 * std::numeric_limits<double>::epsilon();
  };
  const auto [low, high] =
      boost::math::tools::toms748_solve(missing, 0.0, 1.0, before, behind, is_close, most);
  const auto state = is_known ? state_at((low + high) / 2) : std::nullopt;
  if (!state) return std::nullopt;
  const Direction only_lambda{Vector::Zero(state->x.size()), 1};
  const auto solved =
      continuation::correct(problem, chord.weights, state->x, target, *piece, only_lambda, {});
  return PathState{continuation::converged(solved) ? solved.x : state->x, target};
}

std::optional<double> path_work(const PathProblem& problem, const PathState& from,
                                const PathState& to) {
  const CurveChord chord(problem, from, to);
  if (!chord.is_a_way()) return 0.0;
  const auto piece = piece_between(problem, from, to);
  if (!piece) return std::nullopt;
  double work = 0;
  for (const auto& [node, weight] : gauss)
    for (const double sign : {-1.0, 1.0}) {
      const double part = (1 + sign * node) / 2;
      const auto solved = chord.at(part, *piece);
      continuation::Linearisation at;
      if (!solved || !continuation::linearise(problem, solved->x, solved->lambda, *piece, at))
        return std::nullopt;
      const auto tangent = continuation::tangent_at(at, chord.weights, chord.border);
      const auto rate = rate_by_lambda(problem, solved->x, solved->lambda, *piece);
      if (!tangent || !rate) return std::nullopt;
      // The curve is passed at unit speed along the chord.
      const double along = continuation::metric_product(chord.weights, *tangent, chord.border);
      work += weight / 2 * *rate * chord.length * tangent->dlambda / along;
    }
  return work;
}

}  // namespace springfold::analysis
