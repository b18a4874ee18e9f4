#include "parameters/solve_augmented.hpp"

#include <algorithm>
#include <stdexcept>

#include "parameters/freed.hpp"
#include "parameters/held_modes.hpp"
#include "springfold/continuation/entry_checks.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/parameters/imperfection.hpp"

namespace springfold::continuation {
namespace {

/// Sizes of what the caller gives; the equations are checked wherever they are asked for (base_terms).
void check_start(const Family& family, const CriticalStart& start) {
  if (!family.at) throw std::invalid_argument("the family has no problems");
  const auto problem = family.at(start.mu);
  if (!problem) return;  // not defined there: told as such
  check_point(*problem, start.x, start.lambda, start.piece);
  if (start.kind == CriticalKind::branch_point &&
      (start.corank < 1 || start.corank > start.x.size()))
    throw std::invalid_argument("corank: need a number from 1 to that of the unknowns");
  if (start.kind == CriticalKind::surface && !start.value &&
      (start.switching < 0 || start.switching >= problem->switch_count()))
    throw std::invalid_argument("switching: there is no such switch");
  if (start.kind == CriticalKind::zero && !start.value)
    throw std::invalid_argument("value: a point of kind zero needs one");
}

/// What is asked of a limit point of the force, of its equations with the coordinate free.
std::optional<CriticalPoint> in_freed(const Family& family, const CriticalStart& start,
                                      std::optional<CriticalPoint> (*asked)(const Family&,
                                                                            const CriticalStart&)) {
  const FreedFamily freed(family, start.freed);
  const auto begin = freed.start(start);
  const auto found = begin ? asked(freed.family(), *begin) : std::nullopt;
  return found ? std::optional{freed.own(*found)} : std::nullopt;
}

}  // namespace

std::optional<Vector> solve_at(const Augmented& system, Vector X, double mu) {
  Vector F, by_mu;
  Matrix J;
  const bool found = settles(12, [&](double) -> std::optional<IterationStep> {
    if (!system.residual(X, mu, F) || !system.derivatives(X, mu, J, by_mu)) return std::nullopt;
    const Vector step = -Lu(J).solve(F);
    if (!(step.norm() <= 1)) return std::nullopt;
    X += step;
    return IterationStep{step.norm(), refined_step * (1 + X.norm()), one_place};
  });
  return found ? std::optional(X) : std::nullopt;
}

std::optional<Augmented> system_at(const Family& family, const CriticalStart& start) {
  check_start(family, start);
  NullVectors borders;
  const bool bordered =
      start.kind == CriticalKind::limit_point || start.kind == CriticalKind::branch_point;
  if (bordered) {
    auto found =
        null_vectors(family, start, start.kind == CriticalKind::branch_point ? start.corank : 1);
    if (!found) return std::nullopt;
    borders = std::move(*found);
  }
  return Augmented(family, start, std::move(borders));
}

std::optional<Vector> second_order_force(const Family& family, const CriticalStart& start) {
  const auto system = system_at(family, start);
  if (!system || start.kind != CriticalKind::branch_point) return std::nullopt;
  const Index k = start.corank;
  // Even part of the unfolding coefficients, over the square of the step.
  const auto even_part = [&](double step) -> std::optional<Vector> {
    Vector sum = Vector::Zero(k);
    for (const double sign : {1.0, -1.0}) {
      const auto X = solve_at(*system, system->start_unknowns(), start.mu + sign * step);
      if (!X) return std::nullopt;
      sum += X->tail(k);
    }
    return Vector(sum / (2 * step * step));
  };
  const double step = 2 * family.step;
  const auto near = even_part(step), middle = even_part(2 * step), far = even_part(4 * step);
  if (!near || !middle || !far) return std::nullopt;
  const Matrix& left = system->borders().left;
  // Rounding does not grow with the square of the step, or is no more than residuals have.
  const double largest = far->lpNorm<Eigen::Infinity>() * (4 * step) * (4 * step);
  if (largest <= refined_step || !((*near - *middle).norm() <= near_share * near->norm()))
    return Vector(Vector::Zero(left.rows()));
  // Richardson: errors of the second and the fourth order in the step.
  const Vector closer = (4 * *near - *middle) / 3, farther = (4 * *middle - *far) / 3;
  return Vector(-left * (16 * closer - farther) / 15);
}

bool Augmented::sure_derivatives(const Vector& X, double mu, Matrix& dF_dX, Vector& dF_dmu) const {
  if (!derivatives(X, mu, dF_dX, dF_dmu)) return false;
  double off = 0;  // of a function of the caller, which may bend within the step of differences
  if (!is_bordered() && !surface_gradient(state(X), lambda(X), mu, &off)) return false;
  const Differences* exact = known_differences(X, mu);
  return off <= root_of_rounding && (exact == nullptr || exact->error <= root_of_rounding);
}

double Augmented::rate_of_parting(const Vector& X, double mu, const Vector& rate) const {
  if (k_ < 2) return 0;
  const auto parted = [&](double t) -> std::optional<Vector> {
    const auto there = place(X + t * rate, mu + t);
    return there ? std::optional{Vector(there->G.reshaped())} : std::nullopt;
  };
  if (const auto G = derivative_at_zero(parted, family_.step)) return G->lpNorm<Eigen::Infinity>();
  const double h = 2 * family_.step;
  const auto near = place(X + h * rate, mu + h), far = place(X + 2 * h * rate, mu + 2 * h);
  if (!near || !far) return infinity;
  return ((4 * near->G - far->G) / (2 * h)).lpNorm<Eigen::Infinity>();  // without the second order
}

std::optional<CriticalPoint> polish_critical(const Family& family, const CriticalStart& start) {
  if (is_of_freed(start)) return in_freed(family, start, polish_critical);
  if (holds_modes(start)) {
    const HeldFamily held(family, start);
    const auto point = polish_critical(held.family(), held.start());
    // A start off the path by its modes is held there: the residual that is left grows with the square of that.
    if (!point || held.unfolding(*point) > function_noise) return std::nullopt;
    return held.own(*point);
  }
  const auto system = system_at(family, start);
  if (!system) return std::nullopt;
  const auto X = solve_at(*system, system->start_unknowns(), start.mu);
  if (!X || system->unfolding(*X) > kept_within) return std::nullopt;
  return CriticalPoint{.x = system->state(*X), .lambda = system->lambda(*X), .mu = start.mu};
}

std::optional<CriticalPoint> critical_rate(const Family& family, const CriticalStart& start) {
  if (is_of_freed(start)) return in_freed(family, start, critical_rate);
  if (holds_modes(start)) {
    const HeldFamily held(family, start);
    const auto point = critical_rate(held.family(), held.start());
    if (!point) return std::nullopt;
    const double size = std::max(1.0, point->dx.lpNorm<Eigen::Infinity>());
    if (held.unfolding_of_rate(*point) > kept_within * size) return std::nullopt;
    const CriticalPoint own = held.own(*point);
    return parts_modes(family, start, own) ? std::nullopt : std::optional{own};
  }
  const auto system = system_at(family, start);
  if (!system) return std::nullopt;
  const auto X = solve_at(*system, system->start_unknowns(), start.mu);
  if (!X) return std::nullopt;
  Matrix J;
  Vector by_mu;
  if (!system->sure_derivatives(*X, start.mu, J, by_mu)) return std::nullopt;
  const FullPivotLu lu(J);
  if (!lu.is_invertible()) return std::nullopt;
  const Vector rate = -lu.solve(by_mu);
  // With a unit of a small parameter everything changes little: then only rounding of differences is nothing.
  const double own = rate.lpNorm<Eigen::Infinity>(), size = std::max(1.0, own);
  if (!rate.allFinite() || system->unfolding(rate) > kept_within * size ||
      system->rate_of_parting(*X, start.mu, rate) > std::max(poor * own, residual_level))
    return std::nullopt;
  return CriticalPoint{.x = system->state(*X),
                       .lambda = system->lambda(*X),
                       .mu = start.mu,
                       .dx = system->state(rate),
                       .dlambda = system->lambda(rate),
                       .dmu = 1};
}

}  // namespace springfold::continuation
