// A large square matrix without its entries: what is asked of it, as functions.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "springfold/core/frontal.hpp"
#include "springfold/core/inertia.hpp"
#include "springfold/core/types.hpp"

namespace springfold {

/// A matrix J, n x n, known by what can be done with it. The functions may work in storage that they share with all
/// copies: one thread may ask at a time. They take no memory from the heap if they capture no more than a pointer, and
/// what they need is kept by `owner`.
struct StructuredMatrix {
  double largest = 0;  ///< size of the largest entries, at least roughly
  /// J v; neither of the vectors is the other one.
  std::function<void(const Vector& v, Vector& Jv)> product{};
  /// |J| |v| or more, entry by entry.
  std::function<void(const Vector& v, Vector& sizes)> magnitudes{};
  /// Replaces the columns of X (n + k rows) by M^-1 X, or by M^-T X if `transposed`, with
  ///
  ///     M = | J   B |      B, C: n x k,  D: k x k; J may be singular where M is not.
  ///         | C^T D |
  ///
  /// @returns false when M is singular to working precision or not finite; X is undefined then
  std::function<bool(const FrontalBorders&, Matrix& X, bool transposed)> solve{};
  std::function<std::optional<Inertia>()> inertia{};  ///< of a symmetric J
  std::shared_ptr<const void>
      owner{};  ///< keeps what the functions need, a factorisation above all
};

/// J v and |J| |v| as values.
Vector product(const StructuredMatrix& J, const Vector& v);
Vector magnitudes(const StructuredMatrix& J, const Vector& v);

/// diag(rows) J diag(columns) with positive factors. The inertia is that of J: that of the result only
/// where `rows` are a multiple of `columns`.
StructuredMatrix scaled(StructuredMatrix J, const Vector& rows, const Vector& columns);

/// Makes many of them, one after the other: the storage of those that nobody has any more is used again.
class ScaledMatrices {
 public:
  /// Where the next matrix J is to be put. It is empty: what stood there is let go.
  StructuredMatrix& next();
  /// scaled() of the matrix there.
  void put(const Vector& rows, const Vector& columns, StructuredMatrix& result);

 private:
  struct Slot;
  std::vector<std::shared_ptr<Slot>> slots_{};
  std::shared_ptr<Slot> next_{};
};

}  // namespace springfold
