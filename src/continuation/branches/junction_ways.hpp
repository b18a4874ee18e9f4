// All ways out of a junction, with places at which traces along them may begin. Private to the engine.
#pragma once

#include "continuation/points/step.hpp"
#include "springfold/continuation/diagram.hpp"

namespace springfold::continuation {

/// One algorithm for starts, kinks and branch points: on every piece around the point the ways of its own
/// curve or, where it is singular, of its reduced equation; those that lead into their pieces; each with a
/// start before the next switching surface.
void find_ways(const Walker& walker, const DiagramOptions& options, const Hit& hit,
               Junction& junction);

}  // namespace springfold::continuation
