// Bordered linear systems, tangents and the corrector.
#pragma once

#include <optional>
#include <string_view>

#include "springfold/continuation/curve.hpp"
#include "springfold/continuation/options.hpp"
#include "springfold/continuation/problem.hpp"

namespace springfold::continuation {

/// Scalar product of the arc length: sum of weight_i a_i b_i + a_lambda b_lambda.
double metric_product(const Vector& weights, const Direction& a, const Direction& b);

/// Gives a direction the length 1. @returns false where its length is not finite or at most `least`: it stays as it is
bool set_length_one(const Vector& weights, Direction& d, double least = 0);

/// Evaluates the derivatives, structured where the problem wants it; false outside the domain or when a
/// number is not finite.
[[nodiscard]] bool linearise(ProblemView problem, const Vector& x, double lambda,
                             const Piece& piece, Linearisation& at);

/// The same with the entries of dF/dx in any case.
[[nodiscard]] bool linearise_densely(ProblemView problem, const Vector& x, double lambda,
                                     const Piece& piece, Linearisation& at);

using springfold::magnitudes;
using springfold::negative_eigenvalues;
using springfold::product;

/// Solves the bordered system of arc-length continuation,
///
///     | dF/dx           dF/dlambda | | dx |   | r   |
///     |                            | |    | = |     |
///     | (w border.dx)^T border.dl  | | dl |   | rho |
///
/// which stays regular at limit points, where dF/dx alone is singular (Keller 1977).
/// @returns nothing when the matrix is singular to working precision
std::optional<Direction> solve_bordered(const Linearisation& at, const Vector& weights,
                                        const Direction& border, const Vector& r, double rho);

/// Unit tangent at a point, oriented along `reference`.
/// @returns nothing when the bordered matrix is singular
std::optional<Direction> tangent_at(const Linearisation& at, const Vector& weights,
                                    const Direction& reference);

enum class NewtonStatus { converged, too_many_iterations, diverges, singular, outside_domain };

std::string_view to_string(NewtonStatus status);

/// Plain data. `x` and `lambda` are the last iterate, also when the solve failed.
struct NewtonResult {
  NewtonStatus status = NewtonStatus::outside_domain;
  Vector x{};
  double lambda = 0;
  int iterations = 0;
  double residual_norm = 0;           ///< max |F| at the last iterate
  double contraction = 0;             ///< largest ratio of neighbouring corrections
  std::vector<double> corrections{};  ///< lengths of the corrections in the metric
};

[[nodiscard]] inline bool converged(const NewtonResult& result) {
  return result.status == NewtonStatus::converged;
}

/// Residuals of corrected points are at most this: the tolerance, or the rounding of terms that are larger
/// on this piece than at the start, see ProblemView::growth.
/// @param size  of the point: the largest of 1, |x|, |lambda|
double residual_bound(ProblemView problem, const Piece& piece, const NewtonOptions& options,
                      double size);

/// Newton's method with the exact matrix on F(u) = 0, border . (u - u_predicted) = 0, u = (x, lambda).
/// No clamping, no state: callers decide what a failure means.
NewtonResult correct(ProblemView problem, const Vector& weights, Vector x, double lambda,
                     const Piece& piece, const Direction& border, const NewtonOptions& options);

}  // namespace springfold::continuation
