// Closed forms of a structure that stands still while its load grows, some of its cables being just at rest.
#pragma once

#include <string>
#include <vector>

#include "springfold/core/types.hpp"

namespace springfold::guyed {

/// A cable, to first and second order in the sway w of the structure.
struct Cable {
  Vector rate{};    ///< d(length)/dw
  Matrix second{};  ///< second derivative of the length
  double stiffness = 0;
  double length = 0;   ///< in the upright state
  double stretch = 0;  ///< there beyond its free length; negative: slack by as much
};

/// Twice the energy is w' (springs - P load) w and what the cables add, each where it is taut.
struct Structure {
  Matrix springs{};
  Matrix load{};  ///< positive definite
  std::vector<Cable> cables{};
};

/// A direction in which equilibria leave the upright state, at the load P.
struct HalfBranch {
  double load = 0;
  Vector direction{};  ///< unit vector
};

/// What is true of the upright state.
struct Truth {
  /// By load. A branch point counts twice, once for each of its two directions.
  std::vector<HalfBranch> leaving{};
  std::vector<Matrix> pieces{};  ///< stiffness without load, of the pieces that have room
  Matrix load{};
  bool rests = false;  ///< some cable is just at rest
  /// Unstable modes under the load P: 0 if the energy is lowest here; otherwise the least number of all pieces that
  /// have room, and at least 1.
  int index(double P) const;
};

/// Each piece is a choice of the resting cables that act: K_piece - P load on the cone of those w that stretch them and
/// no other. Half-branches are generalised eigenvectors that lie in the cone of their piece. As the energy has
/// continuous slopes, its least quotient with the load's form is one of them: the state is stable below the first.
/// @param at_rest  cables stretched or slack by no more than this part of their length are taken as just at rest
Truth truth(const Structure& structure, double at_rest);

}  // namespace springfold::guyed
