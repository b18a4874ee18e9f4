// Branches that leave to one side of a surface on which the curve rests. Private to the engine.
#pragma once

#include "continuation/locating/events.hpp"
#include "continuation/points/arc.hpp"

namespace springfold::continuation {

/// On a step along which the switches `resting` stay zero, the equations of 2^r pieces have the same
/// curve but different dF/dx. Where an eigenvalue of one of them passes zero, a branch of that piece
/// crosses; the half of it that lies in the piece is an equilibrium path. Such points become
/// branching kinks in `found`; branch points of the step's own piece are judged in the same way. A
/// zero whose branch has no part in its piece is noted in the log, and is a kink with one way out if
/// the number of negative eigenvalues of the step's own piece changes there.
/// @param samples  the step's ends and points between them, in order
void add_half_branches(const Walker& walker, Samples samples, const std::vector<Index>& resting,
                       StepEvents& found, Curve& curve);

}  // namespace springfold::continuation
