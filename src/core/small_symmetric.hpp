// L D L^T of small symmetric matrices on the stack: chains of a mechanism have a few unknowns each, and
// a library made for large matrices takes longer to begin than these take to end. Private to core.
#pragma once

#include <array>

#include "springfold/core/types.hpp"

namespace springfold {

/// S A S = L D L^T with 1x1 and 2x2 blocks in D and S of powers of two, by the same decisions as LAPACK's
/// dsytf2 (Bunch, Kaufman 1977).
class SmallSymmetric {
 public:
  static constexpr Index largest = 24;

  /// @param A  square, at most `largest` rows; its lower triangle is read
  /// @returns false where a number of it is not finite
  bool factorise(const Eigen::Ref<const Matrix>& A);

  Index size() const { return n_; }
  /// Eigenvalue i of the diagonal blocks of D.
  double value(Index i) const { return values_[to(i)]; }
  /// Replaces the columns of X (size() rows) by A^-1 X. @pre no value is zero
  void solve(Matrix& X) const;

 private:
  static constexpr std::size_t capacity = static_cast<std::size_t>(largest);
  using Column = std::array<double, capacity>;
  struct Pivot {
    Index row = 0;
    bool two = false;
  };

  static std::size_t to(Index i) { return static_cast<std::size_t>(i); }
  double& at(Index i, Index j) { return columns_[to(j)][to(i)]; }
  double at(Index i, Index j) const { return columns_[to(j)][to(i)]; }
  void measure(Column& sizes) const;
  void equilibrate();
  Pivot pivot_at(Index k) const;
  void exchange(Index k, Index next, Index p);
  void eliminate_one(Index k);
  void eliminate_two(Index k);
  template <class Row>
  void solve_rows(Row* x) const;

  Index n_ = 0;
  bool scaled_ = false;
  alignas(64) std::array<Column, capacity> columns_;
  Column scale_, values_;
  std::array<Index, capacity> row_;  ///< the row that was exchanged with this one
  std::array<bool, capacity> is_two_;
};

}  // namespace springfold
