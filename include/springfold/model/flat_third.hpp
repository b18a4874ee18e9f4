// Third derivatives of the closure of a chain that moves in the xy plane.
#pragma once

#include "springfold/model/compiled_chain.hpp"

namespace springfold::model {

/// Variables v of a chain and the wrench F that closes it, or directions of both.
struct ClosureVector {
  Vector v{};  ///< variable_count() numbers
  Vector F{};  ///< d numbers
};

/// With L(v, F) = F . e(v): D^3 L [a, b, .], the derivative along b of the derivative along a of the gradient,
///
///     of v:  (D_v H(F) [b_v] + H(b_F)) a_v + H(a_F) b_v,      H(f) = d2(f . e)/dv2
///     of F:  (D_v J [b_v]) a_v
///
/// @param at  of evaluate_closure() at v: its J and spins
/// @pre chain.flat
void put_flat_third(const CompiledChain& chain, const Closure<double>& at, const Vector& F,
                    const ClosureVector& a, const ClosureVector& b, ClosureVector& result);

}  // namespace springfold::model
