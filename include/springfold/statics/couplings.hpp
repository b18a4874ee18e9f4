// Which unknowns of a mechanism meet in one of its members: trusses have many unknowns, but few together.
#pragma once

#include <vector>

#include "springfold/statics/system.hpp"

namespace springfold::statics {

/// For every chain, spring and load the unknowns in z that it couples, and for every body its pose: all
/// entries of the equilibrium's matrix that may be other than zero lie within one of these lists.
/// @pre system.redundant == 0
std::vector<std::vector<Index>> couplings(const System& system);

/// Should the equilibrium's matrix be treated as a sparse one? Many unknowns, bodies that do not turn in space,
/// short chains, no redundant closures, and members that couple few unknowns each.
bool prefers_sparse(const System& system);

/// Do StageJacobians of this system hold entries instead of stages? Those of long chains do not.
bool has_entries(const System& system);

}  // namespace springfold::statics
