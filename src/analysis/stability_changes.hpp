// Places on a curve at which the count of modes that are unstable under dead load changes while the
// study holds the body. Private to analysis.
#pragma once

#include "within_limits.hpp"

namespace springfold::analysis {

/// Under control of poses the engine watches the stability of what the study holds; `index_force` tells what would
/// happen under dead load, and changes where the stiffness of the platform is singular. Every change between two points
/// becomes an event of its own, located by bisection with corrected points, unless a special point already stands
/// there. Changes that cancel within one step are not seen. Under every control special points that share a step get a
/// point between them, which the counts beside them are told from.
void add_stability_changes(const Following& with, continuation::Curve& forward,
                           continuation::Curve& backward);

}  // namespace springfold::analysis
