// Inertia of symmetric indefinite matrices: stability is an integer, not a guess.
#pragma once

#include <optional>

#include "springfold/core/types.hpp"

namespace springfold {

/// Numbers of negative, zero and positive eigenvalues.
struct Inertia {
  Index negative = 0;
  Index zero = 0;  ///< eigenvalues of pivot blocks below `zero_tolerance` times the largest pivot
  Index positive = 0;
  friend bool operator==(const Inertia&, const Inertia&) = default;
};

/// Inertia of the symmetric matrix A (its lower triangle is read), by Bunch-Kaufman with 2x2 pivots (LAPACK dsytrf; up
/// to 128 rows the same on the stack) and Sylvester's law, after rows and columns have been brought to one size. A
/// pivot block's eigenvalue counts as zero when it is below zero_tolerance * (largest pivot eigenvalue).
/// @returns nothing when A holds a value that is not finite
std::optional<Inertia> inertia_of(const Eigen::Ref<const Matrix>& A, double zero_tolerance = 1e-13);

/// A^-1 B and the inertia of A.
struct SymmetricSolution {
  Matrix X{};
  Inertia inertia{};
};

/// Both of them from one factorisation.
/// @returns nothing where solve_symmetric does
std::optional<SymmetricSolution> solve_and_count(const Eigen::Ref<const Matrix>& A,
                                                 const Eigen::Ref<const Matrix>& B);

/// Solves A X = B for symmetric indefinite A by the same factorisation of the equilibrated matrix.
/// @returns nothing when A is singular to working precision or not finite
std::optional<Matrix> solve_symmetric(const Eigen::Ref<const Matrix>& A,
                                      const Eigen::Ref<const Matrix>& B);

}  // namespace springfold
