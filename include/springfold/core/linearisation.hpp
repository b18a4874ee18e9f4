// Equations F(x, lambda) = 0 to first order at one place, and directions in which they change.
#pragma once

#include <memory>
#include <optional>

#include "springfold/core/structured_matrix.hpp"
#include "springfold/core/types.hpp"

namespace springfold {

/// dF/dx and dF/dlambda at one point, on one piece.
struct Linearisation {
  Matrix dF_dx{};       ///< n x n; empty where the problem gives it without its entries
  Vector dF_dlambda{};  ///< n
  std::shared_ptr<const StructuredMatrix> structured{};  ///< then this is dF/dx
};

/// Direction in the extended space R^(n+1).
struct Direction {
  Vector dx{};
  double dlambda = 0;
};

/// dF/dx v, and |dF/dx| |v| entry by entry.
Vector product(const Linearisation& at, const Vector& v);
Vector magnitudes(const Linearisation& at, const Vector& v);

/// Negative eigenvalues of a symmetric dF/dx; nothing where one of them is zero.
std::optional<Index> negative_eigenvalues(const Linearisation& at);

}  // namespace springfold
