#include "springfold/continuation/newton.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "small_lu.hpp"
#include "springfold/core/finite.hpp"
#include "springfold/core/inertia.hpp"

namespace springfold::continuation {
namespace {

/// Smallest over largest pivot below this counts as singular.
constexpr double singular_pivot = 1e-15;

/// Newton stops only when the next correction would be shorter than this.
constexpr double refined_step = 1e-14;

/// Corrections below this may be rounding of F, magnified by a nearly singular matrix.
constexpr double noise_step = 1e-8;

/// The same where the residual itself is no more than rounding.
constexpr double blurred_step = 1e-6;

/// Rounding errors that the terms of F have, estimated from its derivatives.
double rounding_of_residual(const Linearisation& at, const Vector& x, double lambda) {
  return std::numeric_limits<double>::epsilon() *
         (magnitudes(at, x) + std::abs(lambda) * at.dF_dlambda.cwiseAbs())
             .lpNorm<Eigen::Infinity>();
}

double norm(const Vector& weights, const Direction& d) {
  return std::sqrt(metric_product(weights, d, d));
}

bool is_small(const Linearisation& at) {
  return !at.structured && SmallLu::fits(at.dF_dlambda.size() + 1);
}

/// solve_bordered() with few unknowns, on the stack. @param x  (r, rho), replaced by the solution
bool solve_small(const Linearisation& at, const Vector& weights, const Direction& border,
                 double* x) {
  const Index n = at.dF_dlambda.size();
  std::array<double, static_cast<std::size_t>(SmallLu::largest)> row;
  for (Index i = 0; i < n; ++i) row[static_cast<std::size_t>(i)] = weights[i] * border.dx[i];
  const SmallLu lu(at.dF_dx, at.dF_dlambda, Eigen::Map<const Vector>(row.data(), n),
                   border.dlambda);
  if (!(lu.smallest_pivot() > singular_pivot * lu.largest_pivot())) return false;
  lu.solve(x);
  return true;
}

/// The correction for a residual F, with lambda's as its last entry. @returns false where the matrix is singular
bool correction_for(const Linearisation& at, const Vector& weights, const Direction& border,
                    const Vector& F, Vector& step) {
  const Index n = F.size();
  step.resize(n + 1);
  if (is_small(at)) {
    step.head(n) = -F;
    step[n] = 0;
    return solve_small(at, weights, border, step.data());
  }
  const auto solution = solve_bordered(at, weights, border, -F, 0.0);
  if (solution) step << solution->dx, solution->dlambda;
  return solution.has_value();
}

}  // namespace

double metric_product(const Vector& weights, const Direction& a, const Direction& b) {
  return (weights.array() * a.dx.array() * b.dx.array()).sum() + a.dlambda * b.dlambda;
}

bool linearise(ProblemView problem, const Vector& x, double lambda, const Piece& piece,
               Linearisation& at) {
  if (!problem.structured()) return linearise_densely(problem, x, lambda, piece, at);
  at.structured.reset();
  auto matrix = std::make_shared<StructuredMatrix>();
  if (!problem.structured_derivatives(x, lambda, piece, *matrix, at.dF_dlambda) ||
      !at.dF_dlambda.allFinite())
    return false;
  at.structured = std::move(matrix);
  return true;
}

bool linearise_densely(ProblemView problem, const Vector& x, double lambda, const Piece& piece,
                       Linearisation& at) {
  at.structured.reset();
  return problem.derivatives(x, lambda, piece, at.dF_dx, at.dF_dlambda) && all_finite(at.dF_dx) &&
         all_finite(at.dF_dlambda);
}

Vector product(const Linearisation& at, const Vector& v) {
  return at.structured ? at.structured->product(v) : Vector(at.dF_dx * v);
}

Vector magnitudes(const Linearisation& at, const Vector& v) {
  return at.structured ? at.structured->magnitudes(v) : Vector(at.dF_dx.cwiseAbs() * v.cwiseAbs());
}

std::optional<Index> negative_eigenvalues(const Linearisation& at) {
  const auto inertia = at.structured ? at.structured->inertia() : inertia_of(at.dF_dx);
  if (!inertia || inertia->zero > 0) return std::nullopt;
  return inertia->negative;
}

std::optional<Direction> solve_bordered(const Linearisation& at, const Vector& weights,
                                        const Direction& border, const Vector& r, double rho) {
  const Index n = r.size();
  assert(at.dF_dlambda.size() == n && border.dx.size() == n);
  if (at.structured) {
    const FrontalBorders borders{at.dF_dlambda, weights.cwiseProduct(border.dx),
                                 Matrix::Constant(1, 1, border.dlambda)};
    Matrix X(n + 1, 1);
    X << r, rho;
    if (!at.structured->solve(borders, X, false)) return std::nullopt;
    return Direction{X.col(0).head(n), X(n, 0)};
  }
  assert(at.dF_dx.rows() == n && at.dF_dx.cols() == n);
  if (is_small(at)) {
    std::array<double, static_cast<std::size_t>(SmallLu::largest)> x;
    std::copy_n(r.data(), n, x.data());
    x[static_cast<std::size_t>(n)] = rho;
    if (!solve_small(at, weights, border, x.data())) return std::nullopt;
    return Direction{Eigen::Map<const Vector>(x.data(), n), x[static_cast<std::size_t>(n)]};
  }
  Matrix A(n + 1, n + 1);
  A << at.dF_dx, at.dF_dlambda, (weights.array() * border.dx.array()).matrix().transpose(),
      border.dlambda;
  const Eigen::PartialPivLU<Matrix> lu(A);
  const auto pivots = lu.matrixLU().diagonal().cwiseAbs();
  if (!(pivots.minCoeff() > singular_pivot * pivots.maxCoeff())) return std::nullopt;
  Vector right(n + 1);
  right << r, rho;
  const Vector solution = lu.solve(right);
  return Direction{solution.head(n), solution[n]};
}

std::optional<Direction> tangent_at(const Linearisation& at, const Vector& weights,
                                    const Direction& reference) {
  const Index n = at.dF_dlambda.size();
  std::optional<Direction> tangent;
  if (is_small(at)) {
    std::array<double, static_cast<std::size_t>(SmallLu::largest)> x{};
    x[static_cast<std::size_t>(n)] = 1;
    if (solve_small(at, weights, reference, x.data()))
      tangent = Direction{Eigen::Map<const Vector>(x.data(), n), x[static_cast<std::size_t>(n)]};
  } else {
    tangent = solve_bordered(at, weights, reference, Vector::Zero(n), 1.0);
  }
  if (!tangent) return std::nullopt;
  const double length = norm(weights, *tangent);
  if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
  tangent->dx /= length;
  tangent->dlambda /= length;
  return tangent;
}

std::string_view to_string(NewtonStatus status) {
  switch (status) {
    case NewtonStatus::converged:
      return "converged";
    case NewtonStatus::too_many_iterations:
      return "corrector needs too many iterations";
    case NewtonStatus::diverges:
      return "corrector diverges";
    case NewtonStatus::singular:
      return "bordered matrix is singular";
    case NewtonStatus::outside_domain:
      return "left the domain of the problem";
  }
  return "unknown";
}

NewtonResult correct(ProblemView problem, const Vector& weights, Vector x, double lambda,
                     const Piece& piece, const Direction& border, const NewtonOptions& options) {
  CorrectorStorage storage;
  return correct(problem, weights, std::move(x), lambda, piece, border, options, storage);
}

NewtonResult correct(ProblemView problem, const Vector& weights, Vector x, double lambda,
                     const Piece& piece, const Direction& border, const NewtonOptions& options,
                     CorrectorStorage& storage) {
  NewtonResult result{.x = std::move(x), .lambda = lambda};
  Linearisation& at = storage.at;
  Vector &F = storage.F, &step = storage.step;
  const Index n = result.x.size();
  double before = 0;
  for (;; ++result.iterations) {
    const bool inside = problem.residual(result.x, result.lambda, piece, F) && F.allFinite();
    if (!inside) return result;  // status is still outside_domain
    result.residual_norm = F.size() > 0 ? F.lpNorm<Eigen::Infinity>() : 0;
    const double scale =
        std::max({1.0, result.x.lpNorm<Eigen::Infinity>(), std::abs(result.lambda)});
    const bool small = result.residual_norm <= options.residual_tolerance * scale;
    // What is left to correct: the residual times the size of the inverse matrix that the last
    // correction has shown.
    const auto left_over = [&] {
      return result.residual_norm * (result.corrections.back() / before);
    };
    const auto rounded = [&] {
      return result.residual_norm <= 4 * rounding_of_residual(at, result.x, result.lambda);
    };
    const bool refined = !result.corrections.empty() &&
                         (result.residual_norm == 0 ||
                          (before > 0 && left_over() <= refined_step * scale) || rounded());
    before = result.residual_norm;
    if (small && refined) {
      result.status = NewtonStatus::converged;
      return result;
    }
    const bool settled =
        small && (result.corrections.empty() || result.corrections.back() < noise_step);
    if (result.iterations == options.maximum_iterations) {
      result.status = settled ? NewtonStatus::converged : NewtonStatus::too_many_iterations;
      return result;
    }
    if (!linearise(problem, result.x, result.lambda, piece, at)) return result;
    if (!correction_for(at, weights, border, F, step)) {
      result.status = settled ? NewtonStatus::converged : NewtonStatus::singular;
      return result;
    }
    const double length =
        std::sqrt((weights.array() * step.head(n).array().square()).sum() + step[n] * step[n]);
    if (!result.corrections.empty() && result.corrections.back() > 1e-9) {
      const double ratio = length / result.corrections.back();
      // Beside a singular point rounding of F alone makes corrections that do not contract.
      if (small && ratio > 0.1 && (length < noise_step || (length < blurred_step && rounded()))) {
        result.status = NewtonStatus::converged;
        return result;
      }
      result.contraction = std::max(result.contraction, ratio);
      if (ratio > 1) {
        result.status = NewtonStatus::diverges;
        return result;
      }
    }
    if (result.corrections.empty()) result.corrections.reserve(4);
    result.corrections.push_back(length);
    result.x += step.head(n);
    result.lambda += step[n];
  }
}

}  // namespace springfold::continuation
