// Springs that rest exactly at their threshold along a branch. Private to analysis.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "path_problem.hpp"
#include "springfold/continuation/curve.hpp"
#include "springfold/core/piecewise_form.hpp"

namespace springfold::analysis {

/// Numbers of switches.
using Switches = std::vector<std::size_t>;

/// Numbers of the switches that are zero within their own rounding, and do not leave zero along the curve, seen from
/// this point (without a tangent: are zero). The rounding of a switch is what that of the equations makes of it: the
/// force of a stiff spring tells distances from its threshold that are far below those of places.
Switches resting_switches(const PathProblem& problem, const continuation::CurvePoint& point);

/// What the rest of a curve says of the switches at one of its points.
struct KnownSwitches {
  Switches leaving{};  ///< near their threshold, and they do not rest there
  Switches staying{};  ///< they rest, wherever rounding has put the point
};

/// For every point of one smooth curve the switches that are so near to zero that they might rest, and do not: the
/// curve is clear of their surface elsewhere. A function that is zero along a part of it is zero along all of it: those
/// that are zero at all points rest at those as well that a special point beside them displaces.
/// @param points  of one piece, between two special points
std::vector<KnownSwitches> known_switches(
    const PathProblem& problem, const std::vector<const continuation::CurvePoint*>& points);

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
