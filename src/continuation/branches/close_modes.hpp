// Branch points of modes that vanish close together are one junction. Private to the engine.
#pragma once

#include "continuation/points/step.hpp"
#include "springfold/continuation/diagram.hpp"

namespace springfold::continuation {

/// Has a branch point, met right after another one, its own mode, which vanishes within `together` of it, and no third
/// one? The branches of both modes, and those on which both take part, are then ways of the first one: where these
/// begin on the others is nearer still. It gets these ways, and its reach; ways that it had keep their numbers.
/// @param junction  just found, by the branch that is traced: none of its ways belongs to another one
/// @returns whether it has; `untold` where branches on which both modes take part may be missed
enum class TakenIn { yes, no, untold };
TakenIn take_in(const Walker& walker, const DiagramOptions& options, const Hit& hit,
                Junction& junction);

/// The same of a branch point at which a diagram begins, before anything is traced: does another mode vanish within
/// `together` of it along its way on which lambda is steepest?
TakenIn take_in_beside_start(const Walker& walker, const DiagramOptions& options,
                             Junction& junction);

/// Does this special point belong to a junction that has taken in another one?
bool belongs_to(const Walker& walker, const Junction& junction, const Hit& hit);

}  // namespace springfold::continuation
