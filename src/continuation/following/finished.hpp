// What is said of a finished curve: has it kept to its branch, and why did it take so many points? Private to the
// engine.
#pragma once

#include <string>

#include "continuation/points/step.hpp"

namespace springfold::continuation {

/// Looks at the stretches of a curve that were followed in short steps beside a branch that rounding hardly tells
/// apart: the curve before and behind such a stretch must be one smooth curve, seen from some way off, where the
/// branches stand apart. Where it is not, an unresolved point is added.
void check_narrow_places(const Walker& walker, Curve& curve);

/// In words: how far the curve went, what its last steps were like, and which options let it go on or end it.
std::string why_so_many(const Walker& walker, const Curve& curve);

}  // namespace springfold::continuation
