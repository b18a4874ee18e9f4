// The matrix of the curve's own equations, dense or with a structured dF/dx.
#pragma once

#include <optional>
#include <vector>

#include "springfold/core/linearisation.hpp"

namespace springfold {

/// The matrix of the curve's own equations with the step's direction as last row,
///
///     E = | dF/dx            dF/dlambda |
///         | (w tau.dx)^T     tau.dl     |,     (n + 1) x (n + 1):
///
/// regular at limit points, singular exactly at branch points; its corank is theirs.
struct ExtendedMatrix {
  Matrix dense{};      ///< empty where dF/dx is structured
  Linearisation at{};  ///< then this and the last row
  Vector row{};        ///< w tau.dx
  double corner = 0;   ///< tau.dl

  Index rows() const { return at.structured ? row.size() + 1 : dense.rows(); }
};

ExtendedMatrix extended_matrix(const Linearisation& at, const Vector& weights,
                               const Direction& tau);

/// Fixed borders and the m x m function that they define (Govaerts 2000, chapter 3),
///
///     | E    B | | *     |   | 0 |
///     |        | |       | = |   |,      Sigma singular <=> E singular, with equal corank.
///     | C^T  0 | | Sigma |   | I |
struct Borders {
  Matrix B{}, C{};  ///< (n + 1) x m
};

/// E X, and |E| |X| entry by entry.
Matrix product(const ExtendedMatrix& E, const Matrix& X);
Matrix magnitudes(const ExtendedMatrix& E, const Matrix& X);

/// Solves with the bordered matrix, or with its transpose; (n + 1 + m) rows.
/// @returns nothing when it is singular
std::optional<Matrix> solve_with(const ExtendedMatrix& E, const Borders& borders,
                                 const Matrix& right, bool transposed = false);

/// Left and right singular vectors of the m smallest singular values, m = 1...
/// A structured E has them by inverse iteration with bordered matrices.
Borders borders_of(const ExtendedMatrix& E, Index m);

/// borders_of(E, 1) to some digits, as rates of the smallest singular value need them: by inverse iteration, at a fraction of
/// the cost.
Borders weakest_borders(const ExtendedMatrix& E);

/// Of any matrix of entries, in descending order.
Vector singular_values(const Matrix& M);

/// The m smallest ones of E, ascending.
Vector least_singular_values(const ExtendedMatrix& E, Index m);

/// Magnitudes of the largest eigenvalues of E^-1 (E1 - E0), descending: all of them, or those that some
/// steps of Arnoldi's method show where E is structured. Infinity where E is singular.
std::vector<double> relative_motion(const ExtendedMatrix& E, const ExtendedMatrix& E0,
                                    const ExtendedMatrix& E1);

/// Matrices of more rows are not formed with their entries where they are structured.
inline constexpr Index most_entries = 4000;

/// Orthonormal columns of a fixed, irregular kind to start iterations from.
Matrix irregular_columns(Index rows, Index columns);
Matrix orthonormal(const Matrix& columns);

}  // namespace springfold
