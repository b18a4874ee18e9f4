// Sparse symmetric indefinite systems with a few dense borders, in time linear in their length:
// the frontal method with 1x1 and 2x2 pivots, and a dense root for what no front may eliminate.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "springfold/core/inertia.hpp"
#include "springfold/core/types.hpp"

namespace springfold {

/// Which variables of a symmetric matrix A meet in which front. A is the sum of one small dense
/// matrix per front. Fronts follow each other in strings; a variable belongs to one string, and is
/// eliminated behind the last front of the string that holds it:
///
///     string 1:  front -> front -> ... -> front  \                    root variables may stand in any
///     string 2:  front -> front -> ... -> front   ->  dense root      front, and are left for the root
///
struct FrontalPattern {
  Index size = 0;                              ///< of A
  Index root_first = 0, root_count = 0;        ///< root variables: root_first, root_first + 1, ...
  std::vector<Index> variables{};              ///< of all fronts, one list behind the other
  std::vector<std::size_t> first_variable{0};  ///< per front, and where the last one ends
  std::vector<std::size_t> first_value{0};     ///< the same for the values of the fronts' matrices
  std::vector<char> ends_string{};             ///< per front: it is the last one of its string

  std::size_t front_count() const { return ends_string.size(); }
};

/// Appends a front. Its values are a matrix in the order of `variables`, column by column.
void add_front(FrontalPattern& pattern, std::span<const Index> variables, bool ends_string);

/// M = | A   B |   A: size x size,  B, C: size x k,  D: k x k; no k at all: M = A.
///     | C^T D |
struct FrontalBorders {
  Matrix B{}, C{}, D{};
};

struct FrontalOptions {
  /// A pivot's multipliers are at most 1/threshold; what would need larger ones waits. Where more than
  /// `few` variables wait, `relaxed` takes its place.
  double threshold = 0.1, relaxed = 0.01;
  Index few = 8;
  /// The same for the borders, whose columns are seen scaled to the largest entry 1. Where more than
  /// `many` variables wait, borders may have larger multipliers.
  double border_threshold = 0.01;
  Index many = 32;
  /// Smaller pivots are left for the root. A should be scaled so that its usual pivots are near 1.
  double smallest_pivot = 1e-10;
};

/// Factorisation A = L D L^T and what it takes to solve with M, also where A is singular and M is
/// not. A variable without an acceptable pivot waits in the next front of its string, at last in the
/// root, which is solved with complete pivoting. Storage is reused from call to
/// call: once it is large enough nothing is allocated.
///
/// Duff, Reid, "The multifrontal solution of indefinite sparse symmetric linear equations" (1983),
/// for the pivots; Irons, "A frontal solution program" (1970).
class Frontal {
 public:
  explicit Frontal(FrontalPattern pattern, FrontalOptions options = {});
  ~Frontal();
  Frontal(Frontal&&) noexcept;
  Frontal& operator=(Frontal&&) noexcept;

  /// @param values  of all fronts, first_value.back() numbers; lower triangles are read
  /// @param root    root_count x root_count, added to A; need not be symmetric
  /// @returns false when a number is not finite; nothing else may be asked then
  bool factorise(const std::vector<double>& values, const Matrix& root,
                 const FrontalBorders& borders = {});

  /// Other borders with the same A. Their sizes did not take part in the choice of pivots:
  /// `border_growth` says whether that was well.
  bool set_borders(const FrontalBorders& borders);

  /// Replaces the columns of X (size + k rows) by M^-1 X or M^-T X.
  /// @returns false when M is singular to working precision; X is undefined then
  bool solve(Matrix& X);
  bool solve_transposed(Matrix& X);

  /// Inertia of A with the symmetric part of `root`. What the root holds of A is eliminated with
  /// complete pivoting; where only entries below zero_tolerance times its largest entry, or times 1
  /// where that is larger, are left, the rest counts as zero.
  Inertia inertia(double zero_tolerance = 1e-13);

  const FrontalPattern& pattern() const;
  Index waiting() const;  ///< variables that came to the root without having been meant for it
  Index largest_front() const;   ///< variables
  double border_growth() const;  ///< largest entry of L^-1 B and L^-1 C, their columns scaled to 1

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// M X, from the same numbers that factorise() takes.
Matrix product(const FrontalPattern& pattern, const std::vector<double>& values, const Matrix& root,
               const FrontalBorders& borders, const Matrix& X);

}  // namespace springfold
