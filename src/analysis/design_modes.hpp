// Modes that are lost one after the other on the path of a design. Private to analysis.
#pragma once

#include <optional>
#include <vector>

#include "design_path.hpp"
#include "springfold/analysis/design.hpp"

namespace springfold::analysis {

/// The first unwanted point of a path, and the branch points behind it.
struct FirstModes {
  BasePath path{};                      ///< that of the load, load_path()
  std::optional<SpecialPoint> first{};  ///< of the path; nothing: there is none
  /// The quantity that is required at them, one per mode, not falling; empty: it is not defined at the first one. The
  /// least load of several modes has an edge where two of them come together, and the best design often lies on it: one
  /// inequality for each is smooth there.
  std::vector<Measure> modes{};
};

/// So many modes are told apart.
inline constexpr std::size_t modes_together = 3;

/// What counts as unwanted for a requirement.
CriticalPointSettings settings_of(const CriticalRequirement& wanted);

/// Where modes of one point are parted by a parameter each has a rate of its own, which the point itself does not tell:
/// they are those of a design beside this one, where the modes are apart.
/// @param values  of the design's parameters, whose path it is
FirstModes first_modes(const DesignCase& of, const Vector& values, const DesignPath& path,
                       const CriticalRequirement& wanted, const Observer& observer);

}  // namespace springfold::analysis
