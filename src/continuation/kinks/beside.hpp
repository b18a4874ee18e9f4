// The curve on one side of a kink, as near as the rate of lambda can be told from zero; does lambda stand still? The equations
// say so, where its rate along a curve cannot. Private to the engine.
#pragma once

#include <vector>

#include "continuation/points/step.hpp"

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

}  // namespace springfold::continuation
