// The curve on one side of a kink, as near as the rate of lambda can be told from zero; does lambda stand still? The
// equations say so, where its rate along a curve cannot. Private to the engine.
#pragma once

#include <optional>
#include <vector>

#include "continuation/kinks/kink.hpp"

namespace springfold::continuation {

struct Beside {
  CurvePoint point{};
  int sense = 0;       ///< sign of lambda's rate; 0: it stays zero
  bool moved = false;  ///< `point` is not the kink itself
};

inline int sense_of(const CurvePoint& p) { return p.tangent.dlambda > 0 ? 1 : -1; }

/// Is the rate of lambda told from zero?
bool told_from_zero(const CurvePoint& p);

/// @param direction  +1: ahead along the tangent, -1: back
/// @param room       no further away than this
Beside beside(const Walker& walker, const CurvePoint& at, int direction, double room);

/// The curve just before a kink at which its own piece is singular: the branch point belongs to the kink.
Beside before_singular(const Walker& walker, const CurvePoint& at, double room);

/// Do points of a piece, three at least, solve its equations at one and the same lambda? It is that of the point at
/// which F relies on lambda most; there it is known to the residual's tolerance, so that F at the others is known to
/// twice that.
bool same_level(const Walker& walker, const std::vector<const CurvePoint*>& points);

/// Does lambda stand still from here on? Its rate alone does not tell where F hardly relies on lambda.
/// @param direction  +1: ahead along the tangent, -1: back
/// @param room       no further away than this
bool is_level(const Walker& walker, const CurvePoint& at, int direction, double room);

/// From the singular point to the first surface.
struct Opening {
  Beside
      middle{};  ///< half-way; how lambda moves and how many eigenvalues are negative on the stretch
  KinkSearch kink{};  ///< the surface, found
};

/// Beside a singular point rounding of F moves lambda by eps / q at the distance q, but lambda changes by q^2 only:
/// what a branch does within 1e-5 of the point cannot be seen there. F of one piece is smooth beyond its surfaces, so
/// the branch is corrected farther out and read from the polynomial through the singular point, its tangent, and these
/// points.
/// @param junction  the singular point, off all surfaces, with the branch's tangent and piece; s = 0
/// @param farther   a point of the branch on the smooth continuation of the piece
/// @returns nothing where no surface lies within `told_apart`, or more than one thing may happen before it, or the
///          polynomial is not the curve
std::optional<Opening> opening_of(const Walker& walker, const CurvePoint& junction,
                                  const CurvePoint& farther);

}  // namespace springfold::continuation
