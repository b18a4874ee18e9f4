// The first stretch of a branch whose first switching surface lies just beside the singular point that it leaves. Private to
// the engine.
#pragma once

#include <optional>

#include "continuation/kinks/beside.hpp"
#include "continuation/kinks/kink.hpp"

namespace springfold::continuation {

/// From the singular point to the first surface.
struct Opening {
  Beside
      middle{};  ///< half-way; how lambda moves and how many eigenvalues are negative on the stretch
  KinkSearch kink{};  ///< the surface, found
};

/// Beside a singular point rounding of F moves lambda by eps / q at the distance q, but lambda changes by q^2 only: what a
/// branch does within 1e-5 of the point cannot be seen there. F of one piece is smooth beyond its surfaces, so the branch is
/// corrected farther out and read from the polynomial through the singular point, its tangent, and these points.
/// @param junction  the singular point, off all surfaces, with the branch's tangent and piece; s = 0
/// @param farther   a point of the branch on the smooth continuation of the piece
/// @returns nothing where no surface lies within `told_apart`, or more than one thing may happen before it, or the polynomial
///          is not the curve
std::optional<Opening> opening_of(const Walker& walker, const CurvePoint& junction,
                                  const CurvePoint& farther);

}  // namespace springfold::continuation
