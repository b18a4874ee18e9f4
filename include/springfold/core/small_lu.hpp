// L U with partial pivoting of small matrices, on the stack: the bordered systems of most problems have
// ten to forty rows, where a library made for large ones takes several times as long.
#pragma once

#include <array>

#include "springfold/core/types.hpp"

namespace springfold {

/// L and U stand apart, with zeros in the other half, and columns are filled up with zeros to a length known when
/// this is compiled: all loops then run over whole columns.
class SmallLu {
 public:
  static constexpr Index largest = 40;
  static bool fits(Index rows) { return rows <= largest; }

  /// @param A  square, at most `largest` rows
  explicit SmallLu(const Eigen::Ref<const Matrix>& A);
  /// | A    b |
  /// | c^T  d |   @pre A.rows() < largest
  SmallLu(const Matrix& A, const Vector& b, const Eigen::Ref<const Vector>& c, double d);

  Index size() const { return n_; }
  double smallest_pivot() const { return smallest_; }  ///< magnitudes; NaN where a number is NaN
  double largest_pivot() const { return greatest_; }
  /// Of the determinant; 0 where a pivot is zero.
  int sign() const;
  /// Replaces the size() numbers x by the solution for them. @pre smallest_pivot() > 0
  void solve(double* x) const;
  /// The same for all columns of X, which is faster than one by one.
  void solve(Matrix& X) const;

 private:
  static constexpr std::size_t capacity = static_cast<std::size_t>(largest * largest);
  struct Ways;  ///< the loops for one length of columns

  void prepare(Index n);
  void factorise();
  double* column(Index j) { return numbers_.data() + j * length_; }  ///< of U
  const double* U() const { return numbers_.data(); }
  double* L() { return numbers_.data() + n_ * length_; }
  const double* L() const { return numbers_.data() + n_ * length_; }

  Index n_ = 0, length_ = 0;
  const Ways* ways_ = nullptr;
  double smallest_ = 0, greatest_ = 0;
  std::array<Index, static_cast<std::size_t>(largest)> exchanged_;  ///< row k with this one
  alignas(64) std::array<double, 2 * capacity> numbers_;  ///< U; right behind it, strictly lower, L
};

}  // namespace springfold
