#include "solve_beside.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "springfold/core/decompositions.hpp"

namespace springfold::statics {
namespace {

/// Sums of a few terms of a state's own size are rounded by no more than this, relative to it.
constexpr double rounding_of_sums = 4 * std::numeric_limits<double>::epsilon();

/// Newton's method with the factors of a neighbour's matrix: steps cost a residual each. They have to shrink fast and
/// to end in rounding; otherwise false, and the state is of no use. @param steps those that have shown that they shrink
bool go_by_factors(StartEquations& equations, const Lu& factors, StartState& state, int& steps,
                   double& residual) {
  constexpr int most = 8;
  constexpr double fast = 0.125;
  Vector r, y = equations.pack(state), step(y.size());
  double before = infinity, way_before = infinity;
  for (steps = 0; steps < most; ++steps) {
    if (!equations.residual(state, r)) return false;
    residual = r.lpNorm<Eigen::Infinity>();
    factors.solve(r, step);
    const double way = equations.way(step);
    // Where a stiff spring leaves rounding a soft one may still be far from its equilibrium: the step tells.
    if (equations.vanishes(state, r, rounding_of_sums)) {
      if (!equations.moves(state, step)) return true;
      if (way > fast * way_before) {
        --steps;
        return true;
      }
    } else if (!(residual <= fast * before)) {
      return false;
    }
    before = residual;
    way_before = way;
    y -= step;
    equations.unpack(y, state);
  }
  return false;
}

/// Newton's method from the solution of a neighbour, no farther than where its steps shrink as they do near one
/// solution (Kantorovich: the first one bounds the way to it by twice its length while a step is at most a quarter of
/// the one before). A step that does not is the sign of a singular matrix on the way, and behind that may be another
/// equilibrium. So is a determinant of another sign than the neighbour's, at its own state too. Where a spring switches
/// the step behind that is another one however short the way is: it has to be short itself.
bool go_by_newton(const System& system, StartEquations& equations, const Lu* neighbour,
                  StartState& state, int& steps, double& residual) {
  constexpr int most = 8;
  constexpr double contracts = 0.25;
  constexpr double beside_kink =
      1e-4;  // where both determinants agree the equilibrium goes on over it
  const double rounding = std::sqrt(std::numeric_limits<double>::epsilon());
  Vector r;
  Matrix J;
  double before = infinity;
  Piece piece = piece_at(system, state.z, state.inputs.rho);
  bool has_switched = false;
  for (steps = 0; steps < most; ++steps) {
    if (!equations.residual(state, r) || !equations.jacobian(state, J)) return false;
    residual = r.lpNorm<Eigen::Infinity>();
    const Lu lu(J);
    if (neighbour != nullptr && lu.sign() != neighbour->sign()) return false;
    const Vector step = lu.solve(r);
    if (!step.allFinite()) return false;
    const Vector here = state.z;
    equations.unpack(equations.pack(state) - step, state);
    const double moved = farthest_coordinate(system, state.z, here);
    if (moved > std::max(contracts * before, has_switched ? beside_kink : rounding)) return false;
    Piece now = piece_at(system, state.z, state.inputs.rho);
    has_switched = now != piece;
    if (moved <= rounding && !has_switched) break;
    before = moved;
    piece = std::move(now);
  }
  residual = polish(equations, state, steps);
  return equations.solved(state, start_tolerance);
}

}  // namespace

double polish(StartEquations& equations, StartState& state, int& iterations) {
  constexpr int most = 12;
  constexpr double half = 0.5;
  constexpr double contracts = 0.4;  // less than the half by which steps to a singular state shrink
  Vector r, step;
  Matrix J;
  std::vector<StartState> reached;             // one nearer than the other
  double residual = infinity, way = infinity;  // at the last one, and how far the next one is
  bool by_steps = false;
  for (int i = 0; i < most; ++i) {
    if (!equations.residual(state, r)) break;
    const double size = r.lpNorm<Eigen::Infinity>();
    const bool falls = size <= half * residual;
    const bool is_better = size < residual;
    // What the stiff springs leave may be rounding already and hide what the soft ones do: then the step tells.
    const bool may_go_on = size > 0 && (falls || i == 0 || equations.moves(reached.back(), step));
    const bool has_step = may_go_on && equations.jacobian(state, J);
    if (has_step) step = Lu(J).solve(r);
    const double next = has_step && step.allFinite() ? equations.way(step) : infinity;
    const bool comes_nearer = next <= contracts * way;
    if (!is_better && !comes_nearer) break;
    by_steps = by_steps || !is_better;
    reached.push_back(state);
    residual = size;
    way = next;
    if (!(falls || comes_nearer) || !(next <= longest_newton)) break;
    equations.unpack(equations.pack(state) - step, state);
    ++iterations;
  }
  // Steps that turn a stiff member stretch it first, and the next ones take that back: the last state may be between
  // both.
  while (by_steps && reached.size() > 1 && !equations.solved(reached.back(), start_tolerance))
    reached.pop_back();
  if (reached.empty()) return residual;
  state = reached.back();
  return equations.residual(state, r) ? r.lpNorm<Eigen::Infinity>() : infinity;
}

double farthest_coordinate(const System& system, const Vector& a, const Vector& b) {
  double moved = 0;
  for (Index i = 0; i < system.size; ++i)
    if (!system.is_wrench[static_cast<std::size_t>(i)])
      moved = std::max(moved, std::abs(a[i] - b[i]));
  return moved;
}

std::shared_ptr<const Lu> factors_at(const System& system, const StartProblem& problem,
                                     const FirstEquilibrium& found, Workspace& work) {
  StartEquations equations(system, problem, work);
  Matrix J;
  if (!equations.jacobian({found.z, found.inputs}, J)) return nullptr;
  return std::make_shared<Lu>(J);
}

bool solve_beside(const System& system, const StartProblem& problem, StartEquations& equations,
                  const StartState& guess, FirstEquilibrium& result) {
  constexpr int few = 3;  // with more steps factors are worth being renewed
  const Foresight& foresight = problem.foresight;
  StartState state = guess;
  bool found = false;
  int steps = 0;
  if (foresight.factors) {
    if (foresight.z.size() == state.z.size()) state.z = foresight.z;
    if (foresight.rho.size() == state.inputs.rho.size()) state.inputs.rho = foresight.rho;
    found = go_by_factors(equations, *foresight.factors, state, steps, result.residual);
    result.iterations = steps;
  }
  // Steps that shrink by these factors show that the matrix is near theirs; without a step nothing does, but that what
  // is expected between close neighbours solves the equations.
  const bool is_shown = steps > 0 ? steps <= few : foresight.enclosed;
  if (found && is_shown) result.factors = foresight.factors;
  if (!found) {
    state = guess;
    const Lu* const neighbour = foresight.factors.get();
    if (!go_by_newton(system, equations, neighbour, state, result.iterations, result.residual))
      return false;
  }
  Matrix J;
  if (!result.factors) {
    if (!equations.jacobian(state, J)) return false;
    const auto here = std::make_shared<Lu>(J);
    // Between determinants of two signs the matrix is singular, and solutions cross or merge.
    if (foresight.factors && here->sign() != foresight.factors->sign()) return false;
    result.factors = here;
  }
  result.z = std::move(state.z);
  result.inputs = std::move(state.inputs);
  result.attempts = 1;
  result.status = StartStatus::found;
  return true;
}

}  // namespace springfold::statics
