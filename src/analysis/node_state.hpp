// The equilibrium at a node of a map. Private to analysis.
#pragma once

#include "not_held.hpp"
#include "springfold/analysis/study.hpp"

namespace springfold::analysis {

/// By the commands that the map asks for: those that hold the body there, those of plain inverse kinematics, or given
/// ones.
/// @param pose  of the body; with given commands the guess of it
/// @param near  a closed state of plain inverse kinematics nearby, replaced by that of this node
/// @returns why there is none
NotHeld solve_node(const Study& study, const CommandSetup& setup, const Vector& pose,
                   statics::KinematicInverse& near, CommandedState& state);

}  // namespace springfold::analysis
