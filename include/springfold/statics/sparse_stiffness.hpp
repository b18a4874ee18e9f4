// Stiffness and stability of mechanisms of many members, without dense factorisations.
#pragma once

#include "springfold/core/sparse_matrices.hpp"
#include "springfold/statics/stage_stiffness.hpp"

namespace springfold::statics {

/// What stiffness_in_stages() gives, but for the chains: of the eigenvalues of K_Sigma only the lowest three, and
/// not K_Sigma itself. They are those of the pose block of (A + s I)^-1 with I for the poses alone, which is
/// (K_Sigma + s)^-1, found in block Krylov spaces (Golub, Underwood 1977); s is so large that K_Sigma + s
/// has no negative eigenvalue.
/// @param matrices  of a layout with couplings(system)
/// @param A         of equilibrium_matrix(); its diagonal is changed meanwhile
/// @param body      whose stiffness is wanted
StagedStiffness sparse_stiffness(const System& system, SparseMatrices& matrices, Matrix& A,
                                 Index body);

}  // namespace springfold::statics
