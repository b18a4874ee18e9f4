// Derivatives of closures, factorised once for all that is asked of them. Private to analysis.
#pragma once

#include <utility>

#include "springfold/core/row_qr.hpp"
#include "springfold/core/types.hpp"

namespace springfold::analysis {

/// J, a row for every closure e = 0, a column for everything that moves. Where its rows are independent, but for those
/// that are known to depend on the others, one factorisation gives all; elsewhere the rank is found anew for each.
class Closings {
 public:
  Closings() = default;
  /// @param redundant  so many rows depend on the others
  explicit Closings(Matrix J, Index redundant = 0) { compute(std::move(J), redundant); }
  void compute(Matrix J, Index redundant = 0);

  const Matrix& derivatives() const { return J_; }
  /// Are all but the redundant rows independent?
  bool independent() const { return rows_.independent(); }
  /// Orthonormal columns z with J z = 0: all motions that keep the closures.
  Matrix motions() const;
  /// The shortest x with J x = `rates`, or as near to that as the closures allow.
  Vector least_norm(const Vector& rates) const;
  /// mu with the least |J^T mu - force|, force by everything that moves.
  Vector multipliers(const Vector& force) const;
  /// The motion that keeps the closures and is nearest to v.
  Vector kept(const Vector& v) const { return v - least_norm(J_ * v); }

 private:
  Matrix J_{};
  RowQr rows_{};
};

}  // namespace springfold::analysis
