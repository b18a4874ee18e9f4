// Ways out of a point on switching surfaces. Private to the engine.
#pragma once

#include "continuation/kinks/kink.hpp"

namespace springfold::continuation {

/// As rays_at, with the smallest ratio of singular values that counts as full rank of a piece.
/// @param along  tangent of the point's own piece, which is regular here although a branch point may be so near that its
///               equations look singular; nullptr: not known
Rays rays_around(const Walker& walker, const CurvePoint& at, const std::vector<Index>& active,
                 double full_rank, const Direction* along = nullptr);

/// Rate of g_j along a direction.
double switch_rate(const Matrix& dg_dx, const Vector& dg_dlambda, Index j, const Direction& along);

/// Do two unit directions agree to `tolerance`?
bool same_direction(const Vector& weights, const Direction& a, const Direction& b,
                    double tolerance);

}  // namespace springfold::continuation
