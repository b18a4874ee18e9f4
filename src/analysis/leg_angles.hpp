// Do the legs of a parallel manipulator stand where they are meant to? Private to analysis.
#pragma once

#include "springfold/analysis/snap.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::analysis {

/// For every chain with a driven slide and a hinge behind it: the angle between the slide's axis and
/// the line from the hinge to the chain's end, measured so that it is below 90 degrees in `start`. At 90
/// degrees the drive cannot move the end along the leg: a dead point.
/// @param rho  commands
/// @param start, landing  unknowns of the statics
std::vector<SnapWarning> leg_warnings(const statics::System& system, const Vector& rho,
                                      const Vector& start, const Vector& landing);

}  // namespace springfold::analysis
