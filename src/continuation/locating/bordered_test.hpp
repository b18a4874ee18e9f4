// Test functions for branch points: smooth along the curve, zero exactly where the curve's own
// extended Jacobian loses rank. Private to the engine.
#pragma once

#include <optional>
#include <vector>

#include "continuation/points/arc.hpp"
#include "continuation/points/step.hpp"
#include "springfold/core/extended_matrix.hpp"

namespace springfold::continuation {

/// False if the extended matrix with the last row tau, moving from the middle sample E0 to one of the others, E1, may
/// become singular on the way, or is not defined. With X = E0^-1 (E1 - E0), I + t X is regular for all t in [0, 1] if
/// the spectral radius of |X| is below 1; it is bounded by max (|X| d)_i / d_i for any positive d (Collatz and
/// Wielandt). A factor of two is left for motion that is not straight. Of a structured E the radius itself is
/// estimated, with a factor of three.
bool surely_regular(const Walker& walker, const Direction& tau, Samples samples);

/// Can all of E be singular between these matrices?
struct Reach {
  Index order = 1;  ///< so many singular values of E[middle] at most, at least 1
  double size =
      0;  ///< of the largest change from E[middle]; structured: in the directions of those
};
Reach reach_of(const std::vector<ExtendedMatrix>& E, std::size_t middle);

/// Is the smallest singular value of E no larger than this share of the size of E?
bool is_singular(const ExtendedMatrix& E, double share);

/// @returns nothing when the bordered matrix is singular
std::optional<Matrix> sigma_of(const ExtendedMatrix& E, const Borders& borders);

/// What rounding of E's entries, a few units in their last places, makes of Sigma: the norm of
/// |Psi|^T (epsilon |E|) |Phi| with the solutions of the bordered system and of its transpose.
double sigma_noise(const ExtendedMatrix& E, const Borders& borders);

/// The same of the lambda-component of the unit tangent, which is E^-1 times the last unit vector.
/// Infinity where E is singular.
double rate_noise(const ExtendedMatrix& E);

/// The same of errors that the equations' own rates along the tangent may have, each no larger than `error`: terms that
/// cancel in an entry leave more rounding than the entry tells.
double rate_error(const ExtendedMatrix& E, double error);

}  // namespace springfold::continuation
