// A branch point on a step: its place, its branch's direction, its label. Private to the engine.
#pragma once

#include <optional>
#include <vector>

#include "continuation/locating/watched_step.hpp"
#include "continuation/points/chebyshev.hpp"

namespace springfold::continuation {

/// A branch point on the arc, from the curve's points around it: (x, lambda) and Sigma are
/// interpolated on a window; neither is ever computed at the singular point itself.
struct Singularity {
  double at = 0;
  Vector u{};        ///< (x, lambda)
  Vector along{};    ///< its rate along the arc
  double doubt = 0;  ///< how far the place may be off
  double free = 0;   ///< distance to the next zero of the test function; 0: not known
};

/// The curve's points near t, interpolated.
std::optional<Interpolant> curve_near(const WatchedStep& arc, double t, double length);

/// A branch point of corank m from its interpolated place: placed to rounding where second derivatives tell
/// it, polished otherwise.
/// @param zeros    of the test function that showed it
/// @param touches  the test function does not change its sign: a degenerate point
/// @returns nothing if branches do not meet there
std::optional<Candidate> candidate_at(const WatchedStep& arc, const Singularity& place,
                                      const std::vector<ZeroOf>& zeros, Index m, bool touches);

}  // namespace springfold::continuation
