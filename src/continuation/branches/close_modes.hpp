// Branch points of modes that vanish close together are one junction. Private to the engine.
#pragma once

#include "continuation/points/step.hpp"
#include "springfold/continuation/diagram.hpp"

namespace springfold::continuation {

/// Has a branch point, met right after another one, its own mode, which vanishes as near to it as special points need
/// not be told apart? The branches of both modes, and those on which both take part, are then ways of the first one:
/// where the others begin on them is nearer still. It gets these ways, and the reach within which special points belong
/// to it; ways that it had keep their numbers.
/// @returns whether it has; `untold` where it should have, but the branches around both are not the same on all spheres:
///          those on which both take part may begin nearer to the junction than its own ways do
enum class TakenIn { yes, no, untold };
TakenIn take_in(const Walker& walker, const DiagramOptions& options, const Hit& hit,
                Junction& junction);

/// Does this point belong to the junction?
bool belongs_to(const Walker& walker, const Junction& junction, const CurvePoint& point);

}  // namespace springfold::continuation
