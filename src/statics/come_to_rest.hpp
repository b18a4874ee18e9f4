// From a guess downhill: where its loads let a mechanism sink. Private to statics.
#pragma once

#include <functional>

#include "start_equations.hpp"

namespace springfold::statics {

/// Closes the chains of a state, as far as it can.
using CloseChains = std::function<bool(StartState& state)>;

/// Where nothing is stiff at the guess, as between the stops of a gap, Newton's method has no direction, but the loads
/// have one. The mechanism follows them as it would in a viscous fluid, by implicit Euler steps of growing length along
/// minus the gradient of the potential: it comes to the equilibrium that lies downhill, on the springs that stop it.
/// @param state  with closed chains
/// @returns false if it does not come to rest within some steps; then the state is the last one
bool come_to_rest(const System& system, StartEquations& equations, const CloseChains& close,
                  StartState& state);

}  // namespace springfold::statics
