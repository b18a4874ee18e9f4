// In which order the unknowns of a sparse matrix are eliminated. Private to core.
#pragma once

#include <vector>

#include "springfold/core/types.hpp"

namespace springfold {

/// Neighbours of every node, without itself.
using Graph = std::vector<std::vector<Index>>;

/// All nodes by breadth, each part of the graph from a node at its edge, neighbours with fewer neighbours first
/// (Cuthill, McKee 1969), then turned round (George 1971).
std::vector<Index> order_by_breadth(const Graph& graph);

}  // namespace springfold
