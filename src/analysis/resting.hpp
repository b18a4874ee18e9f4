// Springs that rest exactly at their threshold along a branch. Private to analysis.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "path_problem.hpp"
#include "springfold/continuation/curve.hpp"
#include "springfold/core/piecewise_form.hpp"

namespace springfold::analysis {

/// Numbers of the switches that do not leave zero along the curve, seen from this point (without a tangent: are zero).
std::vector<std::size_t> resting_switches(const PathProblem& problem,
                                          const continuation::CurvePoint& point);

/// All pieces that meet where these switches rest, the given one among them; at most 2^6.
std::vector<Piece> pieces_around(const Piece& piece, const std::vector<std::size_t>& resting);

/// What the 2^k pieces around a resting state say of its stability together.
struct RestingIndex {
  Definiteness verdict = Definiteness::undecided;  ///< positive: stable
  Index fewest = 0, most = 0;  ///< unstable modes of the pieces that have room beside the state
  /// 0 if stable, at least 1 if not; NaN: undecided.
  double index() const;
};

/// The symmetric matrix of the equations of one piece; nothing where it is not defined.
using MatrixOfPiece = std::function<std::optional<Matrix>(const Piece&)>;

/// A state is stable if the quadratic form of its energy is positive on the cone of every piece. The form is
/// that of the springs' own coordinates, with everything else at its best (core/piecewise_form.hpp).
/// @param directions  gradients of the resting switches by the unknowns of the matrix, one per column
/// @param closures    negative eigenvalues that belong to constraints
/// @returns nothing for more than twelve springs, or where all pieces are singular
std::optional<RestingIndex> resting_index(const MatrixOfPiece& matrix, const Piece& piece,
                                          const std::vector<std::size_t>& resting,
                                          const Matrix& directions, Index closures);

}  // namespace springfold::analysis
