// One dense front: its pivots and its elimination. Private to core.
#pragma once

#include <vector>

#include "springfold/core/frontal.hpp"

namespace springfold {

/// The rows of B and C that belong to a variable, as the elimination leaves them.
struct BorderRows {
  Index count = 0;              ///< k
  std::vector<double> rows{};   ///< per variable 2k numbers: of B, of C
  std::vector<double> scale{};  ///< 1 / largest entry of each column
  Matrix corner{};              ///< D - (L^-1 C)^T D_pivots^-1 (L^-1 B)

  double* of(Index id) { return rows.data() + 2 * count * id; }
  const double* of(Index id) const { return rows.data() + 2 * count * id; }
  double size_of(Index id) const;  ///< largest entry of a variable's row, columns scaled
};

/// What is kept of the eliminated fronts.
struct FrontFactors {
  struct Front {
    Index size = 0, pivots = 0;
    std::size_t ids = 0, L = 0, D = 0;  ///< places in the lists below
  };
  std::vector<Front> fronts{};
  std::vector<Index> ids{};        ///< per front: its variables, pivots first
  std::vector<double> L{};         ///< per front: size x pivots, column by column, diagonal 1
  std::vector<double> D{};         ///< per pivot: diagonal, and the entry below it in a 2x2 block
  std::vector<std::int8_t> two{};  ///< per pivot: 0 alone, 1 and 2 the two of a 2x2 block
  void clear();
};

/// A square symmetric matrix, both triangles, column by column.
struct Front {
  Index size = 0, candidates = 0;  ///< candidates come first
  std::vector<double> values{};
  std::vector<Index> ids{};
  std::vector<std::int8_t> two{};  ///< of the pivots so far
};

/// Eliminates what can be: pivots come to the front, then candidates that wait, then the others.
/// @returns the number of pivots
Index eliminate(Front& front, BorderRows& borders, const FrontalOptions& options);

/// Appends L, D and the order of the first `pivots` variables.
void keep(const Front& front, Index pivots, FrontFactors& factors);

/// Rows of `right` (n columns, `stride` numbers apart per variable) of the pivots: D^-1 L^-1 of them
/// is not formed; forward leaves L^-1 of the columns, backward takes the part D^-1 (...) to L^-T.
void forward(const FrontFactors& factors, std::size_t f, double* right, Index stride,
             Index columns);
void backward(const FrontFactors& factors, std::size_t f, double* right, Index stride,
              Index columns);

/// x = D^-1 x for the pivots of a front.
void divide(const FrontFactors& factors, std::size_t f, double* right, Index stride, Index columns);

/// corner -= C^T D^-1 B over the pivots of a front.
void add_to_corner(const FrontFactors& factors, std::size_t f, BorderRows& borders);

}  // namespace springfold
