// Factors that bring the rows and columns of a matrix to one size: stiff members beside soft ones make nothing
// singular by that alone.
#pragma once

#include "springfold/core/types.hpp"

namespace springfold {

/// Factors for rows and columns.
struct Equilibration {
  Vector rows{}, columns{};
};

/// Factors, powers of two, after which the largest entries of rows and columns lie near 1: diag(rows) A
/// diag(columns). For a symmetric A both are the same, so that inertia stays (Ruiz 2001). What a row holds
/// beside 1e-13 of the median row is rounding: such rows and columns keep their size relative to the others.
Equilibration equilibrate(const Matrix& A);

/// Largest entries of the rows; 0 where a row holds nothing but rounding beside the others, as above.
Vector row_sizes_of(const Matrix& A);

/// How many singular values of the square matrix A are zero: after equilibration below 1e-13, and a thousand
/// times smaller than the next larger one.
/// @returns rows() if A holds a value that is not finite
Index corank(const Matrix& A);

/// Orthonormal basis of those directions x with A x = 0, in the equilibrated unknowns x/columns.
/// @returns rows() x corank; no columns if A is not finite
Matrix null_directions(const Matrix& A);

}  // namespace springfold
