// One solution where redundant closures leave wrenches undetermined. Private to statics.
#pragma once

#include "springfold/statics/system.hpp"

namespace springfold::statics {

/// With the closures' derivatives J and the r vectors N of their left null space, J^T N = 0, adds
/// the gradient of -|a|^2 / 2, a = N^T F, to the residual and its derivative to the matrices:
///
///     residual -= g^T a,   A -= g^T g,   g = da/dz = | -w^T H(N_k)   N_k^T |,   w = J^+ F,
///
/// where H(N_k) are the second derivatives of N_k . e. States with e = 0 and a = 0, the wrenches of
/// smallest norm, are its solutions; A is regular there if the mechanism is, and keeps its inertia
/// but for r more negative eigenvalues: one for every closure, dependent or not.
/// work.gauge and work.undetermined are g and a; both are empty without redundant closures.
/// @param work  closures as evaluated at z
void add_gauge(const System& system, const Vector& z, Workspace& work, Vector& residual, Matrix* A,
               Matrix* dR_drho);

}  // namespace springfold::statics
