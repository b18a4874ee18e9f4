// Does lambda stand still? The equations say so, where its rate along a curve cannot. Private to the engine.
#pragma once

#include <vector>

#include "continuation/points/step.hpp"

namespace springfold::continuation {

/// Do points of a piece, three at least, solve its equations at one and the same lambda? It is that of the point at
/// which F relies on lambda most; there it is known to the residual's tolerance, so that F at the others is known to
/// twice that.
bool same_level(const Walker& walker, const std::vector<const CurvePoint*>& points);

/// Does lambda stand still from here on? Its rate alone does not tell where F hardly relies on lambda.
/// @param direction  +1: ahead along the tangent, -1: back
/// @param room       no further away than this
bool is_level(const Walker& walker, const CurvePoint& at, int direction, double room);

}  // namespace springfold::continuation
