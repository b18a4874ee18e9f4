// Stiffness and stability of mechanisms of many members, without dense factorisations.
#pragma once

#include "springfold/statics/stage_stiffness.hpp"

namespace springfold::statics {

/// What stiffness_in_stages() gives, but for the chains: of the eigenvalues of K_Sigma the lowest three only, and
/// not K_Sigma itself. K_Sigma^-1 is the pose block of A^-1; its eigenvalues are found in block Krylov spaces
/// (Golub, Underwood 1977), all negative ones and as many positive ones as are wanted beside them. Where they do
/// not settle, there are none.
/// @param A     of StageJacobians, with poses as root unknowns
/// @param body  whose stiffness is wanted
StagedStiffness sparse_stiffness(const System& system, const StructuredMatrix& A, Index body);

}  // namespace springfold::statics
