// Rotations without whole turns. Private to statics.
#pragma once

#include "kinsol_newton.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::statics {

/// Near a whole turn rotation vectors are singular: J_l^T m = 0 says nothing there about moments across
/// the axis. The same rotation by a vector of less than half a turn does.
/// @param z  unknowns of the statics
/// @returns whether one had to be shortened
bool shorten_turns(const System& system, Vector& z);

/// Takes whole turns back from each angle of y that has left its guess by more than half a turn, where the equations
/// are the same without them. They are not where a spring counts turns.
/// @param guess, y  unknowns of the system
void take_back_turns(const SquareSystem& system, const Vector& guess, Vector& y);

}  // namespace springfold::statics
