// Equilibria under a growing load as a problem for the engine, straight from the statics.
#pragma once

#include <cstddef>
#include <utility>

#include "springfold/statics/stiffness.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::bench {

/// The wrench on the only body is lambda * direction.
struct LoadPath {
  LoadPath(const model::Mechanism& mechanism, Vector d)
      : system{statics::prepare(mechanism)}, direction{std::move(d)} {}

  statics::System system;
  Vector direction;
  mutable statics::Workspace work{};
  mutable Vector scratch{};

  Index size() const { return system.size; }
  static bool symmetric() { return true; }
  statics::Inputs inputs(double lambda) const { return {system.commands, lambda * direction}; }
  bool residual(const Vector& z, double lambda, Vector& F) const {
    return statics::equilibrium_residual(system, {}, z, inputs(lambda), work, F);
  }
  bool derivatives(const Vector& z, double lambda, Matrix& dF_dz, Vector& dF_dlambda) const {
    dF_dlambda = statics::load_columns(system, z) * direction;
    return statics::equilibrium_matrix(system, {}, z, inputs(lambda), work, scratch, dF_dz);
  }
  Vector metric() const {  // chain wrenches do not count in the arc length
    Vector weights = Vector::Ones(system.size);
    for (Index i = 0; i < system.size; ++i)
      if (system.is_wrench[static_cast<std::size_t>(i)]) weights[i] = 0;
    return weights;
  }
};

}  // namespace springfold::bench
