// All ways out of a junction, with places at which traces along them may begin. Private to the engine.
#pragma once

#include "continuation/locating/exits.hpp"
#include "continuation/points/step.hpp"
#include "springfold/continuation/diagram.hpp"

namespace springfold::continuation {

/// May other curves leave there?
bool is_junction(const Hit& hit);

/// Two ways out: an ordinary kink of one curve, or none at all.
bool is_one_curve(const Rays& rays);

/// A branch that leaves a singular point of one smooth piece, as a way out of it.
Way way_of(const CurvePoint& at, const Exit& exit);

/// One algorithm for starts, kinks and branch points: on every piece around the point the ways of its own
/// curve or, where it is singular, of its reduced equation; those that lead into their pieces; each with a
/// start before the next switching surface.
void find_ways(const Walker& walker, const DiagramOptions& options, const Hit& hit,
               Junction& junction);

}  // namespace springfold::continuation
