// Zeros of the reduced equation on a small sphere. Private to the engine.
#pragma once

#include <vector>

#include "continuation/locating/reduced_equation.hpp"

namespace springfold::continuation {

/// The branches at one radius, in a fixed order, none twice.
struct RaySet {
  std::vector<RayPoint> rays{};
  double rho = 0;
  std::string doubt{};  ///< set: the search was not possible everywhere, or found a double zero
};

/// Adds what Newton's method reaches from U, unless it is known.
/// @returns false where it does not converge
bool add_ray(const ReducedEquation& equation, const Vector& U, RaySet& set);

/// Searches the sphere |c| = rho; corank 0, 1 or 2.
/// @param samples  on the circle of corank 1
RaySet rays_on_sphere(const ReducedEquation& equation, double rho, int samples);

/// Directions of the kernel that the quadratic terms alone determine: a branch leaves along each.
/// Corank 1 and 2; empty for others.
std::vector<Vector> quadratic_rays(const ReducedEquation& equation);

}  // namespace springfold::continuation
