// Linear springs that couple several joints of one chain: links (6x6), preloaded joints (eq. (3)).
#pragma once

#include <string>
#include <vector>

#include "springfold/core/types.hpp"

namespace springfold::model {

/// torques = stiffness (c - free), c the coordinates of virtual or of preloaded joints of a chain.
struct CoupledSpring {
  std::string name{};                   ///< "foot"; for messages
  std::vector<std::size_t> elements{};  ///< its joints' places in Chain::elements
  /// symmetric, no negative eigenvalue; rows and columns as `elements`. Entries between two lengths
  /// are [force/length], between two angles [moment/rad], between both [force/rad] = [moment/length]
  Matrix stiffness{};
  Vector free{};  ///< coordinates without torque
};

/// What a stiffness or compliance matrix must be.
enum class Definiteness { semidefinite, definite };

/// The first rule that the matrix breaks, with the entry or eigenvalue that breaks it; empty when
/// usable. Definiteness is judged with all diagonal entries scaled to 1, so that units do not matter:
/// eigenvalues above -1e-10 are not negative, those above 1e-14 are positive.
std::string problem_in(const Matrix& matrix, Definiteness need);

/// Inverse of a positive definite matrix, exactly symmetric.
/// @pre problem_in(matrix, Definiteness::definite).empty()
Matrix inverse_of(const Matrix& matrix);

}  // namespace springfold::model
