// The largest region in which the transmission factors keep their bounds: what the study kind
// `workspace` is asked. Units of the case.
#pragma once

#include <limits>

#include "springfold/core/types.hpp"

namespace springfold::analysis {

/// Square and cube have edges along the axes; in space disc and square lie in the plane z = const.
enum class RegionShape { square, disc, cube, ball };

struct FactorBounds {
  double low = 0, high = std::numeric_limits<double>::infinity();
};

struct WorkspaceSettings {
  RegionShape shape = RegionShape::square;
  Vector centre{};          ///< pose of the body, d entries; empty: its own pose
  FactorBounds velocity{};  ///< of the velocity transmission factors of translations
  FactorBounds force{};     ///< of the force transmission factors
  double up_to = 0;         ///< largest half width or radius looked at
};

}  // namespace springfold::analysis
