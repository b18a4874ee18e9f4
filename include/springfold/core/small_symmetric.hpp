// L D L^T of small symmetric matrices: those of mechanisms have ten to a hundred rows, and a library made
// for large ones is slower and cannot delay pivots.
#pragma once

#include <array>

#include "springfold/core/types.hpp"

namespace springfold {

/// P S A S P^T = L D L^T with 1x1 and 2x2 blocks in D and S of powers of two, by the same decisions as LAPACK's
/// dsytf2 (Bunch, Kaufman 1977). Pivots that are small may be delayed: then
///
///                 | L_11      | | D_1    | | L_11^T  L_21^T |
///     P S A S P^T = |           | |        | |                |
///                 | L_21   I  | |      R | |         I      |
///
/// and nothing is divided by what is nearly zero. Borders of A are carried through L (`forward`), and
/// together with R make a small matrix that is regular wherever the bordered one is.
class SmallSymmetric {
 public:
  static constexpr Index largest = 128;

  /// Which pivots are delayed: those below a share of the largest entry that their row of S A S had, or of that of
  /// S border.
  struct DelayedPivots {
    double share = 0.1, share_of_border = 1e-3;
    const double* border = nullptr;  ///< as many numbers as A has rows
  };

  /// @param A  square, at most `largest` rows; its lower triangle is read
  /// @param delayed  nullptr: no pivots
  /// @returns false where a number of it is not finite
  bool factorise(const Eigen::Ref<const Matrix>& A, const DelayedPivots* delayed = nullptr);

  Index size() const { return n_; }
  /// The size() eigenvalues of the diagonal blocks of D, with L D L^T of R in place of R, into `values`.
  void pivot_values(double* values) const;
  /// Rows of R, and its entries.
  Index delayed() const { return n_ - done_; }
  double rest(Index i, Index j) const {
    return i >= j ? at(done_ + i, done_ + j) : at(done_ + j, done_ + i);
  }

  /// Replaces the columns of X (size() rows) by A^-1 X. @pre nothing is delayed, no value is zero
  void solve(Matrix& X) const;

  // Solutions with borders, for `width` columns side by side: row i of them are the width numbers from x + i * width
  // on, or from y + i * width in the order of the pivots. y is aligned to 16 bytes and has room for `padded` rows; with
  // width 1 the four numbers behind its last row must be zero, as forward() leaves them. Widths: 1 and 4, forward()
  // also 2.
  static constexpr Index padded = largest + 4;
  template <int width>
  void forward(const double* x, double* y) const;  ///< y = L^-1 P S x; the last rows go with R
  template <int width>
  void divide(double* y) const;  ///< y = D_1^-1 y; the last delayed() rows are left as they are
  template <int width>
  void backward(double* y, double* x) const;  ///< x = S P^T L^-T y; y is used up

 private:
  static constexpr std::size_t capacity = static_cast<std::size_t>(largest);
  using Column = std::array<double, capacity>;
  struct Pivot {
    Index row = 0;
    bool two = false;
  };

  static std::size_t to(Index i) { return static_cast<std::size_t>(i); }
  const double* column(Index j) const { return entries_.data() + j * length_; }
  double* column(Index j) { return entries_.data() + j * length_; }
  double& at(Index i, Index j) { return column(j)[i]; }
  double at(Index i, Index j) const { return column(j)[i]; }
  void begin(Index n);
  void rest_values(double* values) const;
  void measure();
  void equilibrate();
  void set_least(const DelayedPivots& delayed);
  void eliminate(bool may_delay);
  Pivot pivot_at(Index k) const;
  bool is_large(Index k, const Pivot& pivot) const;
  void exchange(Index k, Index next, Index p);
  void eliminate_one(Index k);
  void eliminate_two(Index k);

  Index n_ = 0, length_ = 0;  ///< of columns, a multiple of four
  Index done_ = 0;            ///< rows of L_11
  bool scaled_ = false;
  Vector entries_{};  ///< grown to what was needed: most of the largest size would lie idle
  alignas(64) Column sizes_,
      least_;  ///< of row i of S A S: its largest entry; the smallest pivot that is not delayed
  Column scale_;
  std::array<Index, capacity> order_;  ///< row i of the factors belongs to this one of A
  std::array<bool, capacity> is_two_;
};

}  // namespace springfold
