// The piece between a junction and the first point of a branch that begins there. Private to the engine.
#pragma once

#include "continuation/points/step.hpp"
#include "springfold/continuation/diagram.hpp"

namespace springfold::continuation {

/// Puts the junction itself before the first point of a curve that begins beside it. The piece in
/// between is traced back: it must lead to the junction without passing anything else.
/// @returns false where it does not; the curve is then as it was
bool attach_to_junction(const Walker& walker, const DiagramOptions& options,
                        const CurvePoint& junction, const Way& way, Curve& curve);

}  // namespace springfold::continuation
