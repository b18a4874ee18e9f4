// Dimensionless mechanisms. Private to analysis.
#pragma once

#include "springfold/model/mechanism.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::analysis {

/// Powers of two, so that scaling is exact.
struct Scales {
  double length = 1;
  double force = 1;
  double moment() const { return force * length; }
};

/// Length: the largest length in the mechanism; force: the median spring stiffness times it (the
/// median size of loads and weights, then the constant load's, where there is no spring).
Scales scales_for(const model::Mechanism& mechanism, const Vector& constant_load);

/// The mechanism with lengths / scales.length and forces / scales.force.
model::Mechanism dimensionless(const model::Mechanism& mechanism, const Scales& scales);

/// Factors from dimensionless to physical pose coordinates of a body (d entries).
Vector pose_scales(model::TaskSpace space, const Scales& scales);

/// Factors from dimensionless to physical wrench components of a body (d entries).
Vector wrench_scales(model::TaskSpace space, const Scales& scales);

/// Factors from dimensionless to physical entries of the unknowns z.
Vector unknown_scales(const statics::System& system, const Scales& scales);

}  // namespace springfold::analysis
