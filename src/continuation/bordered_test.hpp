// Test functions for branch points: smooth along the curve, zero exactly where the curve's own
// extended Jacobian loses rank. Private to the engine.
#pragma once

#include <optional>
#include <vector>

#include "springfold/continuation/newton.hpp"

namespace springfold::continuation {

/// The matrix of the curve's own equations with the step's direction as last row,
///
///     E = | dF/dx            dF/dlambda |
///         | (w tau.dx)^T     tau.dl     |,     (n + 1) x (n + 1):
///
/// regular at limit points, singular exactly at branch points; its corank is theirs.
Matrix extended_matrix(const Linearisation& at, const Vector& weights, const Direction& tau);

/// False if a matrix that moves from E0 = E[middle] to one of the others may become singular on the way.
/// With X = E0^-1 (E1 - E0), I + t X is regular for all t in [0, 1] if the spectral radius of |X| is
/// below 1; it is bounded by max (|X| d)_i / d_i for any positive d (Collatz and Wielandt). A factor of
/// two is left for motion that is not straight.
bool surely_regular(const std::vector<Matrix>& E, std::size_t middle);

/// Fixed borders and the m x m function that they define (Govaerts 2000, chapter 3),
///
///     | E    B | | *     |   | 0 |
///     |        | |       | = |   |,      Sigma singular <=> E singular, with equal corank.
///     | C^T  0 | | Sigma |   | I |
struct Borders {
  Matrix B{}, C{};  ///< (n + 1) x m
};

/// Left and right singular vectors of the m smallest singular values, m = 1...
Borders borders_of(const Matrix& E, Index m);

/// In descending order.
Vector singular_values(const Matrix& E);

/// How many singular values are smaller than `reach`; at least one.
Index small_singular_values(const Matrix& E, double reach);

/// @returns nothing when the bordered matrix is singular
std::optional<Matrix> sigma_of(const Matrix& E, const Borders& borders);

/// What rounding of E's entries, a few units in their last places, makes of Sigma: the norm of
/// |Psi|^T (epsilon |E|) |Phi| with the solutions of the bordered system and of its transpose.
double sigma_noise(const Matrix& E, const Borders& borders);

/// The same of the lambda-component of the unit tangent, which is E^-1 times the last unit vector.
/// Infinity where E is singular.
double rate_noise(const Matrix& E);

}  // namespace springfold::continuation
