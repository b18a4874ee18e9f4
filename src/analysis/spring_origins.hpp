// Springs whose coordinates are counted from where the mechanism stands at the start. Private to
// analysis.
#pragma once

#include <optional>
#include <vector>

#include "springfold/analysis/study.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::analysis {

/// Coordinates of the joints in the start pose; of every chain one per element, zero where it has
/// none.
using Origins = std::vector<std::vector<double>>;

/// Coordinates in the start pose of the joints whose springs are counted from it: the chains are
/// closed at the bodies' start poses by the passive and preloaded joints and those joints alone (by
/// the commands too, if the start chooses them), or, if that is impossible, by all joints.
/// @param mechanism  dimensionless
/// @param z          guess of all unknowns with the start pose in it
/// @returns nothing when the chains cannot be closed there; empty when no spring asks for it
std::optional<Origins> spring_origins(const model::Mechanism& mechanism, const Study& study,
                                      const statics::System& system, const Vector& z);

/// The mechanism with those springs moved by their origins.
model::Mechanism with_origins(model::Mechanism mechanism, const Origins& origins);

}  // namespace springfold::analysis
