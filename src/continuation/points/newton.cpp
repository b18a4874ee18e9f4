#include "springfold/continuation/newton.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "continuation/points/workspace.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/finite.hpp"

namespace springfold::continuation {
namespace {

/// Corrections below this may be rounding of F, magnified by a nearly singular matrix.
constexpr double noise_step = root_of_rounding;

/// The same where the residual itself is no more than rounding.
constexpr double blurred_step = poor;

/// Are these residuals no more than a few times the rounding errors that the terms of F have?
bool is_rounding(double residual, const Linearisation& at, const Vector& x, double lambda,
                 Vector& sizes) {
  if (at.structured) {
    at.structured->magnitudes(x, sizes);
  } else {
    sizes.setZero(x.size());
    for (Index j = 0; j < x.size(); ++j)
      sizes.array() += at.dF_dx.col(j).array().abs() * std::abs(x[j]);
  }
  sizes.array() += std::abs(lambda) * at.dF_dlambda.array().abs();
  return residual <= few_roundings * sizes.lpNorm<Eigen::Infinity>();
}

}  // namespace

double metric_product(const Vector& weights, const Direction& a, const Direction& b) {
  return (weights.array() * a.dx.array() * b.dx.array()).sum() + a.dlambda * b.dlambda;
}

bool set_length_one(const Vector& weights, Direction& d, double least) {
  const double length = std::sqrt(metric_product(weights, d, d));
  if (!(length > least) || !std::isfinite(length)) return false;
  d.dx /= length;
  d.dlambda /= length;
  return true;
}

bool linearise(ProblemView problem, const Vector& x, double lambda, const Piece& piece,
               Linearisation& at) {
  if (!problem.structured()) return linearise_densely(problem, x, lambda, piece, at);
  // The same object again if nobody else has it; what it holds is let go first, for the problem to use.
  auto matrix = std::const_pointer_cast<StructuredMatrix>(std::move(at.structured));
  at.structured.reset();
  if (matrix.use_count() == 1)
    *matrix = {};
  else
    matrix = std::make_shared<StructuredMatrix>();
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

std::optional<Direction> solve_bordered(const Linearisation& at, const Vector& weights,
                                        const Direction& border, const Vector& r, double rho) {
  const Index n = r.size();
  assert(at.dF_dlambda.size() == n && border.dx.size() == n);
  BorderedFactors factors;
  factors.begin(at, false);
  if (!factors.set_border(weights, border)) return std::nullopt;
  Vector x(n + 1);
  x << r, rho;
  if (!factors.solve(x.data())) return std::nullopt;
  return Direction{x.head(n), x[n]};
}

std::optional<Direction> tangent_at(const Linearisation& at, const Vector& weights,
                                    const Direction& reference) {
  const Index n = at.dF_dlambda.size();
  auto tangent = solve_bordered(at, weights, reference, Vector::Zero(n), 1.0);
  if (!tangent) return std::nullopt;
  if (!set_length_one(weights, *tangent)) return std::nullopt;
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

double residual_bound(ProblemView problem, const Piece& piece, const NewtonOptions& options,
                      double size) {
  return std::max(options.residual_tolerance, few_roundings * problem.growth(piece)) * size;
}

bool tangent_at(Workspace& memory, LinearisedPoint& place, const Vector& weights,
                const Direction& reference, Direction& tangent) {
  if (!place.factors.set_border(weights, reference)) return false;
  const Index n = place.x.size();
  Vector& u = memory.step;
  u.resize(n + 1);
  if (!place.factors.solve_for_tangent(u.data())) return false;
  const auto dx = u.head(n).array();
  const double length = std::sqrt((weights.array() * dx * dx).sum() + u[n] * u[n]);
  if (!(length > 0) || !std::isfinite(length)) return false;
  tangent.dx = u.head(n) / length;
  tangent.dlambda = u[n] / length;
  return true;
}

NewtonResult correct(ProblemView problem, const Vector& weights, Vector x, double lambda,
                     const Piece& piece, const Direction& border, const NewtonOptions& options) {
  const auto memory = workspace();
  memory->newton.x = std::move(x);
  memory->newton.lambda = lambda;
  correct(problem, weights, piece, border, options, *memory);
  return std::move(memory->newton);
}

namespace {

/// F at the iterate, together with its derivatives, which are needed there or, at the end, for the tangent.
/// @param here  the place, where they were evaluated
/// @returns false outside the domain
bool evaluate(ProblemView problem, const Piece& piece, Workspace& memory, LinearisedPoint*& here) {
  NewtonResult& at = memory.newton;
  Vector& F = memory.F;
  here = problem.structured() ? nullptr
                              : linearised_with_residual(problem, memory, at.x, at.lambda, piece);
  if (here)
    F = here->F;
  else if (!problem.residual(at.x, at.lambda, piece, F) || !F.allFinite())
    return false;
  at.residual_norm = F.size() > 0 ? F.lpNorm<Eigen::Infinity>() : 0;
  return true;
}

/// What the residual of an iterate says.
struct Judged {
  bool small = false;    ///< it is at the tolerance
  bool refined = false;  ///< nothing is left to correct but rounding
  bool settled = false;  ///< it would do where nothing better can be had
};

/// @param place   of the last correction
/// @param before  the residual there
Judged judge(ProblemView problem, const Piece& piece, const NewtonOptions& options,
             Workspace& memory, const LinearisedPoint* place, double before) {
  const NewtonResult& at = memory.newton;
  const double scale = std::max({1.0, at.x.lpNorm<Eigen::Infinity>(), std::abs(at.lambda)});
  const bool first = at.corrections.empty(), fine = !first && at.corrections.back() < noise_step;
  // What is left to correct: the residual times the size of the inverse matrix that the last
  // correction has shown.
  const double left_over =
      before > 0 ? at.residual_norm * (at.corrections.back() / before) : infinity;
  // Where the matrix is nearly singular, a residual of rounding's size may leave much to correct. It is rounding only
  // when it gets no smaller.
  const auto at_its_least = [&] {
    return !(before > 0) || left_over <= exact_model * scale ||
           at.residual_norm > still_falls * before;
  };
  Judged judged;
  judged.small = at.residual_norm <= options.residual_tolerance * scale ||
                 (fine && at.residual_norm <= residual_bound(problem, piece, options, scale));
  judged.refined =
      !first &&
      (at.residual_norm == 0 || left_over <= refined_step * scale ||
       (is_rounding(at.residual_norm, place->at, at.x, at.lambda, memory.sizes) && at_its_least()));
  judged.settled = judged.small && (first || fine);
  return judged;
}

}  // namespace

void correct(ProblemView problem, const Vector& weights, const Piece& piece,
             const Direction& border, const NewtonOptions& options, Workspace& memory) {
  NewtonResult& result = memory.newton;
  Vector& step = memory.step;
  const Index n = result.x.size();
  LinearisedPoint* here = nullptr;
  double before = 0;
  result.iterations = 0;
  result.residual_norm = result.contraction = 0;
  result.corrections.clear();
  const auto ends = [&result](NewtonStatus status) { result.status = status; };
  for (;; ++result.iterations) {
    const LinearisedPoint* const last = here;  // of the last correction
    if (!evaluate(problem, piece, memory, here)) return ends(NewtonStatus::outside_domain);
    const Judged judged = judge(problem, piece, options, memory, last, before);
    before = result.residual_norm;
    if (judged.small && judged.refined) return ends(NewtonStatus::converged);
    if (result.iterations == options.maximum_iterations)
      return ends(judged.settled ? NewtonStatus::converged : NewtonStatus::too_many_iterations);
    if (!here) here = linearised_at(problem, memory, result.x, result.lambda, piece);
    if (!here) return ends(NewtonStatus::outside_domain);
    step.resize(n + 1);
    step.head(n) = -memory.F;
    step[n] = 0;
    if (!here->factors.set_border(weights, border) || !here->factors.solve(step.data()))
      return ends(judged.settled ? NewtonStatus::converged : NewtonStatus::singular);
    const double length =
        std::sqrt((weights.array() * step.head(n).array().square()).sum() + step[n] * step[n]);
    if (!result.corrections.empty() && result.corrections.back() > one_place) {
      const double ratio = length / result.corrections.back();
      // Beside a singular point rounding of F alone makes corrections that do not contract.
      if (judged.small && ratio > still_falls &&
          (length < noise_step ||
           (length < blurred_step &&
            is_rounding(result.residual_norm, here->at, result.x, result.lambda, memory.sizes))))
        return ends(NewtonStatus::converged);
      result.contraction = std::max(result.contraction, ratio);
      if (ratio > 1) return ends(NewtonStatus::diverges);
    }
    result.corrections.push_back(length);
    result.x += step.head(n);
    result.lambda += step[n];
  }
}

}  // namespace springfold::continuation
