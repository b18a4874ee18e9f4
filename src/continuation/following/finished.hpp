// Has a curve kept to its branch where another one is so near that rounding could have led across? Private to the engine.
#pragma once

#include "continuation/points/step.hpp"

namespace springfold::continuation {

/// Looks at the stretches of a curve that were followed in short steps beside a branch that rounding hardly tells apart: the
/// curve before and behind such a stretch must be one smooth curve, seen from some way off, where the branches stand apart.
/// Where it is not, an unresolved point is added.
void check_narrow_places(const Walker& walker, Curve& curve);

}  // namespace springfold::continuation
