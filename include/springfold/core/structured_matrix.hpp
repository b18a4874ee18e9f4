// A large square matrix without its entries: what is asked of it, as functions.
#pragma once

#include <functional>
#include <optional>

#include "springfold/core/frontal.hpp"
#include "springfold/core/inertia.hpp"
#include "springfold/core/types.hpp"

namespace springfold {

/// A matrix J, n x n, known by what can be done with it. Whoever makes one keeps what the functions need,
/// a factorisation above all, for as long as they live.
struct StructuredMatrix {
  double largest = 0;  ///< size of the largest entries, at least roughly
  std::function<Vector(const Vector&)> product{};     ///< J v
  std::function<Vector(const Vector&)> magnitudes{};  ///< |J| |v| or more, entry by entry
  /// Replaces the columns of X (n + k rows) by M^-1 X, or by M^-T X if `transposed`, with
  ///
  ///     M = | J   B |      B, C: n x k,  D: k x k; J may be singular where M is not.
  ///         | C^T D |
  ///
  /// @returns false when M is singular to working precision or not finite; X is undefined then
  std::function<bool(const FrontalBorders&, Matrix& X, bool transposed)> solve{};
  std::function<std::optional<Inertia>()> inertia{};  ///< of a symmetric J
};

/// diag(rows) J diag(columns) with positive factors. The inertia is that of J: that of the result only
/// where `rows` are a multiple of `columns`.
StructuredMatrix scaled(StructuredMatrix J, const Vector& rows, const Vector& columns);

}  // namespace springfold
