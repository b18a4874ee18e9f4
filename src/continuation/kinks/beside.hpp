// The curve on one side of a kink, as near as the rate of lambda can be told from zero. Private to the engine.
#pragma once

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

}  // namespace springfold::continuation
