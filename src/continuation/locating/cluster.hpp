// Special points too close together to be told apart: how many there are. Private to the engine.
#pragma once

#include <optional>

#include "continuation/points/arc.hpp"
#include "continuation/points/step.hpp"

namespace springfold::continuation {

/// All special points of a step as one unresolved hit with their total multiplicity. lambda's rate and
/// det Sigma are interpolated over the whole step, where rounding matters little; their complex zeros
/// beside the step are counted, however much rounding scatters them. They must lie close together
/// compared with the step, far from any other, and explain the change of the number of negative
/// eigenvalues.
/// @param samples  the step's ends and its middle, in order; all on one piece
std::optional<Hit> cluster_on_step(const Walker& walker, Samples samples);

}  // namespace springfold::continuation
