// Special points followed from run to run of a sweep. Private to io.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sweep_points.hpp"

namespace springfold::io {

/// A special point as the parameter changes.
struct SweepTrack {
  std::string
      name{};  ///< its labels, "LP1"; "LP1/LP3" where they move on because others appear before it
  std::string code{};
  std::vector<std::optional<std::size_t>>
      points{};  ///< per run its number in SweepPoints::labels; nothing: the run does not have it
};

/// Labels count along each curve, and so move on where a pair of points appears. Points of one code keep their order
/// along the curve: where two runs have different numbers of them, as many as can be are matched in that order, so that
/// lambda, deflection and force differ least in sum; the others begin or end there. Points behind a run that has none
/// go on with those before it.
/// @param runs  in the order of the parameter
std::vector<SweepTrack> tracks_of(const SweepPoints& sweep,
                                  const std::vector<const SweepPoints::Run*>& runs);

}  // namespace springfold::io
