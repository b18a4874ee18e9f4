// The states of a stretch by its rows, to find the one of a given lambda. Private to analysis; it knows no mechanisms.
#pragma once

#include <optional>
#include <vector>

#include "springfold/core/types.hpp"

namespace springfold::analysis {

/// Rows along a curve; at a kink two of them with one arc length.
struct StretchTrack {
  std::vector<double> s{}, lambda{};
  std::vector<Vector> x{};
  std::vector<bool> is_stable{};  ///< beyond the ends it is not
};

/// The state at a lambda that lies between those of a row and the next one: by a cubic in the arc length through these
/// and their neighbours up to the next kink. By lambda itself it would not do: where branches meet, states change with
/// the root of its distance from there.
Vector state_between(const StretchTrack& track, std::size_t row, double lambda);

/// The same where lambda grows along the track and one of the rows is stable; nothing: there is no such place.
std::optional<Vector> state_near(const StretchTrack& track, double lambda);

}  // namespace springfold::analysis
