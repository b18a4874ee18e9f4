// Few equations in many unknowns, factorised once for all that is asked of them.
#pragma once

#include <vector>

#include "springfold/core/types.hpp"

namespace springfold {

/// A^T P = Q R with column pivots, by Householder's reflections. Where the rows of A are independent it gives what
/// kernel_of(A), least_squares(A, b) and least_squares(A^T, g) give, each of which factorises anew.
class RowQr {
 public:
  RowQr() = default;
  explicit RowQr(const Matrix& A) { compute(A); }
  void compute(const Matrix& A);

  /// All rows independent to rounding? Nothing else may be asked where they are not.
  bool independent() const { return independent_; }
  Matrix kernel() const;                      ///< orthonormal columns z with A z = 0
  Vector least_norm(const Vector& b) const;   ///< the shortest x with A x = b
  Vector multipliers(const Vector& g) const;  ///< mu with the least |A^T mu - g|

 private:
  void reflect(Index k, double* x) const;

  Matrix factors_{};  ///< R, below its diagonal the reflections
  Vector tau_{};
  std::vector<Index> order_{};  ///< the row of A that column k belongs to
  bool independent_ = false;
};

}  // namespace springfold
