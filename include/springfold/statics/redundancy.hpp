// Redundant closures: constraints that say again what others say already.
#pragma once

#include <cstdint>
#include <vector>

#include "springfold/statics/system.hpp"

namespace springfold::statics {

/// Closure equations that depend on the others in every neighbouring state of the assembled
/// mechanism, such as the third bar of a parallelogram or a planar loop closed in space. They leave
/// directions of the chain wrenches undetermined: self-stress N with J^T N = 0.
struct Redundancy {
  bool assembled = false;             ///< the chains could be closed; otherwise nothing is known
  Index count = 0;                    ///< dependent equations
  std::vector<std::size_t> chains{};  ///< those whose equations take part
  double smallest_kept = 0;           ///< singular values of the closures, relative to the largest:
  double largest_dropped = 0;         ///< the gap between independent and dependent ones
};

/// Closes the chains near z (all bodies free, commands held), and counts the singular values of the
/// closures' derivatives below 1e-9 of the largest there and at a few seeded neighbours: redundant
/// is what vanishes at all of them. A closure that loses rank in one state only, such as a stretched
/// chain, is not redundant.
///
/// With `count` in System::redundant the equilibrium has one solution again, the wrenches of
/// smallest norm. Motions, stiffness and numbers of unstable modes do not depend on that choice.
Redundancy redundant_closures(const System& system, const Vector& z, const Vector& rho,
                              std::uint64_t seed = 1);

}  // namespace springfold::statics
