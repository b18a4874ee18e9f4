// Counts of unstable modes at critical points. Private to analysis.
#pragma once

#include "quantities.hpp"

namespace springfold::analysis {

/// At a critical point the count is undefined: there the smaller count of the two sides is the number of negative
/// eigenvalues. Between two of them the engine gives a point of the curve: what stands beside them is the index there.
void fill_indices(Branch& branch, const std::vector<QuantityDefinition>& quantities);

}  // namespace springfold::analysis
