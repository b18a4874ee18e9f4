// Springs of shapes and pressures: their part of the equilibrium. Private to statics.
#pragma once

#include "springfold/statics/shapes.hpp"

namespace springfold::statics {

/// Adds the gradient of all energies U(alpha(p_1, ..., p_m)) to the residual, and to A and dR_drho
/// (either may be nullptr) the derivatives, with g = d alpha/dp and H = d2 alpha/dp2:
///
///     dU/dv_j = U' sum_a g_a . dp_a,j
///     d2U     = U'' (sum_a g_a . dp_a,j)(sum_b g_b . dp_b,k)
///               + U' [sum_ab dp_a,j . H_ab dp_b,k + sum_a g_a . d2p_a,jk]
void add_shape_terms(const System& system, const Piece& piece, const Vector& z,
                     const Inputs& inputs, Workspace& work, Vector& residual, Matrix* A,
                     Matrix* dR_drho);

/// As shape_energy(), each law in its segment of the piece.
double shape_energy(const System& system, const Piece& piece, const Vector& z, const Vector& rho);

/// Angles in the plane are counted from this state: there they are those nearest to `near`.
void count_turns_from(const Vector& z, System& system);

/// Adds d residual/d(factors) times `rates` of all pressures.
void add_pressure_rate(const System& system, const Vector& z, const Vector& rho,
                       const Vector& rates, Workspace& work, Vector& rate);

}  // namespace springfold::statics
