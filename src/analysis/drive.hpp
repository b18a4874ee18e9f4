// Along one direction with everything else at rest: how a mode is pushed, and how a coordinate is driven over a saddle.
// Private to analysis.
#pragma once

#include <limits>

#include "descent.hpp"

namespace springfold::analysis {

/// A state with a given amplitude along a direction, all other motions at rest.
struct Pushed {
  Vector x{};
  double force = 0;  ///< of the energy, along the direction: what drives outward is positive
};

struct PushOptions {
  double amplitude = 0;     ///< from `from`, along the direction
  double arrived = 1e-11;   ///< steps below this end it
  bool is_resting = false;  ///< nothing is returned where they do not become so short
};

/// @param from   the state that amplitudes count from
/// @param along  unit direction of the moving unknowns
/// @param start  where the other motions come to rest from; its own amplitude is corrected
std::optional<Pushed> pushed(const Landscape& landscape, const Vector& from, const Vector& along,
                             Vector start, const PushOptions& options);

/// Where a drive is given up.
struct DriveLimits {
  double farthest = 0;  ///< amplitude
  double highest =
      std::numeric_limits<double>::infinity();  ///< energy: saddles behind are higher still
};

struct Driven {
  std::optional<RestState> saddle{};  ///< where the force along the direction turns
  std::optional<Vector> beyond{};     ///< a state behind that; none: the force never turned
};

/// Drives a minimum outward, everything else following at rest, until the energy drives on by itself. Where what
/// follows snaps on the way, the drive goes on from there.
Driven drive(const Landscape& landscape, const RestState& from, const Vector& along,
             const DriveLimits& limits);

}  // namespace springfold::analysis
