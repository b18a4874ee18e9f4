// The extended Jacobian with rows and columns of one size: what its rank is must not depend on units. Private to the
// engine.
#pragma once

#include <optional>

#include "continuation/points/step.hpp"

namespace springfold::continuation {

/// D_r [dF/dx dF/dlambda] D_c at a point, n x (n + 1); entries that vanish there only count as large as they are a little
/// away.
struct EquilibratedJacobian {
  Matrix J{};
  Vector columns{};  ///< D_c: J y = 0 for (dx, dlambda) = D_c y
};

/// @returns nothing where derivatives are not defined
std::optional<EquilibratedJacobian> equilibrated_jacobian(const Walker& walker,
                                                          const CurvePoint& at);

}  // namespace springfold::continuation
