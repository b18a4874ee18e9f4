// The same mechanism with other numbers, again and again.
#pragma once

#include "springfold/statics/first_equilibrium.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::statics {

/// What prepare(mechanism) gives. Where `old` was prepared from a mechanism that differs in numbers alone, its places,
/// its names and its memory are used.
/// @pre model::problems_in(mechanism).empty()
System prepare(model::Mechanism mechanism, System old);

/// first_equilibrium(system, problem) in storage that is kept for the next one.
FirstEquilibrium first_equilibrium(const System& system, const StartProblem& problem,
                                   Workspace& work);

}  // namespace springfold::statics
