// Equilibria under a growing load as a problem for the engine, straight from the statics.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>

#include "springfold/statics/stage_jacobians.hpp"
#include "springfold/statics/stiffness.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::bench {

/// The wrench on the only body is lambda * direction.
struct LoadPath {
  LoadPath(const model::Mechanism& mechanism, Vector d)
      : system{statics::prepare(mechanism)}, direction{std::move(d)}, present{inputs(0)} {
    if (statics::prefers_stages(system)) stages.emplace(system);
  }

  statics::System system;
  Vector direction;
  mutable statics::Workspace work{};
  mutable statics::Inputs present{};
  mutable Vector scratch{};
  mutable std::optional<statics::StageJacobians> stages{};  ///< of long chains

  Index size() const { return system.size; }
  static bool symmetric() { return true; }
  statics::Inputs inputs(double lambda) const { return {system.commands, lambda * direction}; }
  bool structured() const { return stages.has_value(); }
  bool structured_derivatives(const Vector& z, double lambda, StructuredMatrix& dF_dz,
                              Vector& dF_dlambda) const {
    present.W = lambda * direction;
    dF_dlambda.setZero(system.size);
    statics::add_wrench_rate(system, z, direction, dF_dlambda);
    return stages->matrix(system, {}, z, present, {}, {}, scratch, dF_dz);
  }
  bool residual(const Vector& z, double lambda, Vector& F) const {
    present.W = lambda * direction;
    if (stages) return stages->residual(system, {}, z, present, F);
    return statics::equilibrium_residual(system, {}, z, present, work, F);
  }
  bool derivatives(const Vector& z, double lambda, Matrix& dF_dz, Vector& dF_dlambda) const {
    return equations(z, lambda, scratch, dF_dz, dF_dlambda);
  }
  bool equations(const Vector& z, double lambda, Vector& F, Matrix& dF_dz,
                 Vector& dF_dlambda) const {
    present.W = lambda * direction;
    dF_dlambda.setZero(system.size);
    statics::add_wrench_rate(system, z, direction, dF_dlambda);
    return statics::equilibrium_matrix(system, {}, z, present, work, F, dF_dz);
  }
  Vector metric() const {  // chain wrenches do not count in the arc length
    Vector weights = Vector::Ones(system.size);
    for (Index i = 0; i < system.size; ++i)
      if (system.is_wrench[static_cast<std::size_t>(i)]) weights[i] = 0;
    return weights;
  }
};

}  // namespace springfold::bench
