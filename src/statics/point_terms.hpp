// Loads, weights and line springs at points: their part of the equilibrium. Private to statics.
#pragma once

#include "springfold/statics/system.hpp"

namespace springfold::statics {

/// Adds to the residual minus the generalised forces of all loads and weights and the gradient of
/// the line springs' energy, and to A and dR_drho (either may be nullptr) the derivatives:
///
///     force f:   Q_j = f . dp_j,        dQ_j/dv_k = f . d2p_jk    + follower: (spin_k x f) . dp_j
///     moment m:  Q_j = m . spin_j,      dQ_j/dv_k = m . dspin_jk  + follower: (spin_k x m) . spin_j
void add_point_terms(const System& system, const Vector& z, const Inputs& inputs, Workspace& work,
                     Vector& residual, Matrix* A, Matrix* dR_drho);

/// Variables and motion of a point in the state z.
void evaluate_point(const System& system, std::size_t point, const Vector& z, const Vector& rho,
                    Workspace::Point& out);

/// Adds a derivative of the generalised force of variable j of one point by variable k of another
/// where they stand.
void add_derivative(const PointSlice& row, Index j, const PointSlice& column, Index k, double value,
                    Matrix& A, Matrix* dR_drho);

}  // namespace springfold::statics
