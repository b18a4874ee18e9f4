// Counts of unstable modes at critical points. Private to analysis.
#pragma once

#include "quantities.hpp"

namespace springfold::analysis {

/// Adds rows at which springs rest, to the last ones if they follow them with the same answer.
void add_resting(const RestingRows& next, std::vector<RestingRows>& list);

/// Beside a critical point, nearer than points are told apart, the count is that of the first row beyond on that side.
/// At a critical point the count is undefined: there the smaller count of the two sides is the number of negative
/// eigenvalues. Between two of them the engine gives a point of the curve: what stands beside them is the index there.
void fill_indices(Branch& branch, const std::vector<QuantityDefinition>& quantities);

}  // namespace springfold::analysis
