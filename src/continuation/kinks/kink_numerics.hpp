// The tolerances with which points on switching surfaces are judged. Private to the engine.
#pragma once

#include "continuation/points/numerics.hpp"
#include "springfold/core/types.hpp"

namespace springfold::continuation {

/// Special points are located to 1e-10 of their size; matrices there are singular to this, and rates
/// of switches zero to this, with two orders to spare.
inline constexpr double located_rank = 1e-8;

/// Ratio of singular values from which a piece is regular at a kink on a curve, which is corrected to rounding.
inline constexpr double regular_at_kinks = 1e-9;

/// So near to a singular point corrected points may be off by the root of their rounding.
inline constexpr double perhaps_singular = 1e-4;

/// 1 - cosine of a way and the direction in which a curve arrives at a singular point, where its tangent is
/// known only roughly.
inline constexpr double nearly_same_line = 1e-3;

/// Arc length over which lambda must stand still to be a family beyond a kink: an inflection that is flat to
/// 1e-12 on it would need a third derivative of lambda below 1e-5.
inline constexpr double level_reach = 1e-2;

/// A direction shorter than this in the metric, compared with its entries, has no length.
inline constexpr double no_length = 1e-14;

/// Error of the tangent of a piece that is regular at a located point.
inline constexpr double regular_tangent = 1e-9;

/// The same, times the piece's conditioning, where the point is exact to rounding.
inline constexpr double exact_tangent = 1000 * rounding_unit;

/// Rates of switches below this along a unit tangent run along the surface.
inline constexpr double along_surface = 1e-8;

/// 1 - cosine of directions that are one line.
inline constexpr double same_line = 1e-12;

/// Up to so many unknowns all derivatives may vanish at once; then their size is looked for nearby.
inline constexpr Index most_of_one_size = 4;

/// Switches at one point whose 2^k pieces are looked at.
inline constexpr std::size_t most_active = 12;

}  // namespace springfold::continuation
