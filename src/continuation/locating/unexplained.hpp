// What a trace says where special points could not be told from each other. Private to the engine.
#pragma once

#include "continuation/locating/events.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {

/// Steps are not shortened below this to separate special points; what is left is one cluster.
inline constexpr double unresolved_length = poor;

/// Neighbouring unresolved steps are one cluster with its total multiplicity.
void add_unresolved(const CurvePoint& from, const CurvePoint& to, const StepEvents& found,
                    Curve& curve);

/// Steps may end where an eigenvalue is zero to rounding. From the last point before them with a count of negative
/// eigenvalues to the new one, the special points must explain its change.
void account_over_gap(Curve& curve);

}  // namespace springfold::continuation
