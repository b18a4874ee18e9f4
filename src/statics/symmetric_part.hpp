// What the ways to the Cartesian stiffness share. Private to statics.
#pragma once

#include "springfold/core/types.hpp"

namespace springfold::statics {

/// Beside the largest entries of A a stiffness like this is that of a rigid chain, blurred by rounding: a
/// straight one gives way along itself with the square of its bend.
inline constexpr double rigidity = 1e12;

inline Matrix symmetric_part(const Matrix& K) { return 0.5 * (K + K.transpose()); }

}  // namespace springfold::statics
