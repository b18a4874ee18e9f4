// Few equations in many unknowns, factorised once for all that is asked of them.
#pragma once

#include <vector>

#include "springfold/core/types.hpp"

namespace springfold {

/// A^T P = Q R with column pivots, by Householder's reflections. Where the rows of A are independent it gives what
/// kernel_of(A), least_squares(A, b) and least_squares(A^T, g) give, each of which factorises anew. Of rows of which
/// some are known to depend on the others, those with the smallest pivots are left out.
class RowQr {
 public:
  RowQr() = default;
  explicit RowQr(const Matrix& A, Index dependent = 0) { compute(A, dependent); }
  /// @param dependent  so many rows depend on the others
  void compute(const Matrix& A, Index dependent = 0);

  /// All other rows independent to rounding? Nothing else may be asked where they are not.
  bool independent() const { return independent_; }
  Matrix kernel() const;  ///< orthonormal columns z with A z = 0
  Vector least_norm(
      const Vector& b) const;  ///< the shortest x with A x = b, for a b that the rows can give
  Vector multipliers(
      const Vector& g) const;  ///< mu with the least |A^T mu - g|, zero for rows left out
  Matrix relations() const;  ///< orthonormal columns mu with A^T mu = 0, one for each row left out

 private:
  void reflect(Index k, double* x) const;

  Matrix factors_{};            ///< R, below its diagonal the reflections
  Vector tau_{};                ///< of the reflections, one for each row that is kept
  std::vector<Index> order_{};  ///< the row of A that column k belongs to
  bool independent_ = false;
};

}  // namespace springfold
