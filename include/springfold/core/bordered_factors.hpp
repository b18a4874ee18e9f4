// One factorisation for everything that is asked at a place of the curve.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "springfold/core/decompositions.hpp"
#include "springfold/core/linearisation.hpp"
#include "springfold/core/small_lu.hpp"
#include "springfold/core/small_symmetric.hpp"

namespace springfold {

/// dF/dx and dF/dlambda of a place, with a last row that may change:
///
///     | dF/dx    dF/dlambda |
///     | row^T    corner     |,     (n + 1) x (n + 1).
///
/// A symmetric dF/dx is factorised as L D L^T without its borders, pivots that are nearly zero delayed: the same
/// factors give the number of negative eigenvalues, and with every last row that is asked for (of the corrector, of the
/// tangent, of the test functions) solutions, also where dF/dx is singular. A structured dF/dx does the same its own
/// way. Other matrices are factorised as L U with their last row, again only where that is another one.
class BorderedFactors {
 public:
  BorderedFactors() {}  // most of the storage is never touched
  BorderedFactors(const BorderedFactors&) = delete;
  BorderedFactors& operator=(const BorderedFactors&) = delete;

  /// Begins with another place; nothing is computed yet. `at` must outlive this.
  void begin(const Linearisation& at, bool symmetric);

  /// Sets the last row, row = w border.dx, corner = border.dl. @returns false when the matrix is singular to working
  /// precision; of a structured one solve() says so
  bool set_border(const Vector& weights, const Direction& border);

  /// Replaces the n + 1 numbers x by the solution for them. @pre set_border() returned true
  /// @returns false when a structured matrix turns out singular
  bool solve(double* x);

  /// The solution for (0, 1), which is a multiple of the tangent, into the n + 1 numbers x. @pre and return value as
  /// above
  bool solve_for_tangent(double* x);

  /// Columns of the inverse of the bordered matrix that belong to some of its rows; of a dF/dx with entries.
  /// @pre set_border() returned true
  void invert(std::span<const Index> rows, Matrix& columns);

  /// Negative eigenvalues of a symmetric dF/dx; nothing where one of them is zero.
  std::optional<Index> negative();

 private:
  static constexpr std::size_t capacity = static_cast<std::size_t>(SmallSymmetric::padded);
  enum class Way { symmetric, small, large, structured };

  bool factorise_symmetric();
  bool border_symmetric();
  bool border_general();
  bool factorise_whole();
  template <int width>
  void solve_symmetric(double* x, bool only_last) const;

  const Linearisation* at_ = nullptr;
  Index n_ = 0;
  Way way_ = Way::large;
  bool factorised_ = false, finite_ = false;  ///< dF/dx as L D L^T
  bool bordered_ = false, regular_ = false;   ///< the whole, with the last row
  Vector row_{};
  double corner_ = 0;

  SmallSymmetric K_;
  alignas(
      16) std::array<double, capacity> b_;  ///< L^-1 of dF/dlambda, its first part divided by D_1
  alignas(16) std::array<double, capacity> z_;  ///< L^-1 of the row
  double last_ = 0;  ///< what is left of the corner where no pivot was delayed
  std::array<double, 2> front_factors_{1, 1};  ///< of the last row and the last column beside R
  Vector row_factors_{};                       ///< of the rows of all of it
  Lu large_{};                                 ///< all of it
  Matrix storage_{};
  Vector right_{};
  FrontalBorders borders_{};
  std::optional<SmallLu> front_{};  ///< R with its borders; or all of it
};

}  // namespace springfold
