// Stiffness and stability of mechanisms with long chains, without matrices of entries.
#pragma once

#include <vector>

#include "springfold/statics/stage_jacobians.hpp"
#include "springfold/statics/stiffness.hpp"

namespace springfold::statics {

/// What condense(), body_stiffness(), body_compliance() and chain_stiffness() give.
struct StagedStiffness {
  Condensed condensed{};
  Matrix body{};        ///< stiffness of one body, all others free; empty where not defined
  Matrix compliance{};  ///< of that body where it has no stiffness; empty where singular
  std::vector<Matrix>
      chains{};  ///< K_ci of all chains; empty where one of them is rigid or buckles, and with many members
  Index zero_modes = 0;  ///< zero eigenvalues of A: motions without stiffness
};

/// With all poses held at t, E = | 0 | in the rows of the poses,
///                               | I |
///     | A    E | | z |   | 0 |
///     |        | |   | = |   |:      w = -(K_Sigma - dW/dt) t.   K_ci t is what chain i adds to the
///     | E^T  0 | | w |   | t |       rows of the poses in A z.
///
/// One factorisation of A serves all of it, and the count of negative eigenvalues.
/// @param stages  after matrix() with poses as root unknowns
/// @param A       what that gave, symmetric
StagedStiffness stiffness_in_stages(const System& system, const StageJacobians& stages,
                                    const StructuredMatrix& A, Index body);

}  // namespace springfold::statics
