// Second derivatives of the equilibrium, exact where they are known.
#pragma once

#include "springfold/statics/system.hpp"

namespace springfold::statics {

/// Are they known: chains in the plane, springs of any law on their coordinates, dead wrenches on bodies? Points at
/// which something acts, shapes, spatial chains and redundant closures have none.
bool has_second_derivatives(const System& system);

/// A direction of the state and of the commands, or a derivative by both.
struct StateDirection {
  Vector z{};    ///< size entries
  Vector rho{};  ///< one per command
};

/// result = the derivative of w^T [dr/dz dr/drho] along `b`, r the residual of the equilibrium.
/// @param w  size entries, one per row of r
/// @pre has_second_derivatives(system)
void put_second_derivatives(const System& system, const Piece& piece, const Vector& z,
                            const Vector& rho, const Vector& w, const StateDirection& b,
                            Workspace& work, StateDirection& result);

}  // namespace springfold::statics
