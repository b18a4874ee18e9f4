// Point masses that move as a rigid body does. Private to analysis.
#pragma once

#include <vector>

#include "springfold/model/se3.hpp"

namespace springfold::analysis {

struct PointOfMass {
  double mass = 0;
  model::Vec3<double> at = model::Vec3<double>::Zero();
};

/// Masses with the same sum, the same centre (the origin) and the same moments
/// of inertia: in pairs along the principal axes, at the radius of gyration.
/// The second moments of the mass are E = tr(I)/2 - I.
/// @param mass     > 0; 0: the pairs are at the distance 1, and their masses'
/// sum stands at the origin with a minus
/// @param inertia  about the origin, symmetric [mass length^2]
std::vector<PointOfMass> equimomental_points(double mass, const model::Mat3<double>& inertia);

}  // namespace springfold::analysis
