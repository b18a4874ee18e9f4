// Closing chains as pure geometry.
#pragma once

#include <vector>

#include "springfold/statics/system.hpp"

namespace springfold::statics {

/// Closes all chains by minimum-norm Newton steps of bounded length in the chosen unknowns alone.
/// Forces play no part.
/// @param unknowns  entries of z; numbers from system.size on are commands
/// @returns false when they cannot be closed to 1e-12; z and rho are where it ended
bool close_chains(const System& system, const std::vector<Index>& unknowns, Vector& z, Vector& rho);

}  // namespace springfold::statics
