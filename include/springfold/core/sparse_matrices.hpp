// Large symmetric matrices with few entries in a row, in the form in which the engine asks for large
// matrices: many small members that each couple few unknowns, in any graph.
#pragma once

#include <memory>
#include <vector>

#include "springfold/core/structured_matrix.hpp"
#include "springfold/core/types.hpp"

namespace springfold {

/// Which entries of a matrix may be other than zero, and in which order its unknowns are eliminated: by
/// breadth, from an unknown at the edge of the graph (Cuthill, McKee 1969). What is left of an elimination at
/// any time is one layer of the graph: with n unknowns and layers of w of them a factorisation costs n w^2.
class SparseLayout {
 public:
  /// @param couplings  lists of unknowns that meet in one member; one may stand in many, each in one at least
  SparseLayout(Index size, const std::vector<std::vector<Index>>& couplings);

  Index size() const;
  Index largest_front()
      const;  ///< unknowns that are held together at most, without those that wait
  const FrontalPattern& pattern() const;
  /// Place in a square matrix, i + j size, per value of the pattern; -1: no entry.
  const std::vector<Index>& sources() const;
  /// Per unknown the unknowns that it meets, increasing, itself among them.
  const std::vector<std::vector<Index>>& rows() const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

/// Hands out matrices of one layout. Each lives as long as its StructuredMatrix; storage is used again
/// afterwards. One object serves one thread.
class SparseMatrices {
 public:
  explicit SparseMatrices(SparseLayout layout);

  /// The entries of A that the layout has, as a matrix without the others.
  /// @param A  symmetric, of the layout's size; what is asked of `result` does not look at it again
  void take(const Matrix& A, StructuredMatrix& result);

  const SparseLayout& layout() const { return layout_; }

 private:
  struct Slot;
  SparseLayout layout_;
  std::vector<std::shared_ptr<Slot>> slots_{};
};

}  // namespace springfold
