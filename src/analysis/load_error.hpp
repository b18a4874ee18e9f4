// How well the load at a special point is known. Private to analysis.
#pragma once

#include "fall.hpp"
#include "grow_diagram.hpp"

namespace springfold::analysis {

/// Special points are found to `promised_place` of the arc length: lambda to its rate along the branch times that. At
/// limit points it does not change to first order, and the error is rounding alone.
/// @param landscape  of the problem frozen at lambda [dimensionless]
LoadError error_of_load(const Tracing& t, const Event& event, const Landscape& landscape,
                        double lambda);

}  // namespace springfold::analysis
