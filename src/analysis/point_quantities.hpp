// What is read off points: where they are, and the springs between them. Private to analysis.
#pragma once

#include <vector>

#include "quantities.hpp"

namespace springfold::analysis {

/// Positions of named points of chains; lengths and forces of springs between points, values and forces of those of
/// shapes, the last coordinates of springs in series.
void add_point_quantities(const statics::System& system, const Scales& scales,
                          std::vector<QuantityDefinition>& list);

/// The value of one of these in the units of the case; nothing of another kind.
/// @param piece  laws in its segments, continued beyond their ends; nullptr: each in the segment of the state
std::optional<double> point_quantity(const statics::System& system, const QuantityDefinition& q,
                                     const Vector& z, const statics::Inputs& inputs,
                                     const Piece* piece = nullptr);

}  // namespace springfold::analysis
