// The path that a loaded mechanism takes from its start. Private to analysis.
#pragma once

#include "base_path.hpp"

namespace springfold::analysis {

/// The curve from the start in the direction in which lambda grows, base_path(). At a branch point where it turns back,
/// while just one other branch leads on with growing load and is stable, the path goes on along that one: no stability
/// is lost where a load straightens what was bent. Everywhere else, and where that is not known, it is the curve.
/// Labels count along the path.
/// @param settings  whose loss counts: under the study's control or under dead load, where the force is the load
/// @param enough, within  as in PathOptions
BasePath load_path(const Member& member, const CriticalPointSettings& settings,
                   const Observer& observer, const continuation::HitObserver& enough = {},
                   const Study* within = nullptr);

/// The same from the curve. @param path  as base_path() has it, forwards only
BasePath load_path(BasePath path, const Member& member, const CriticalPointSettings& settings,
                   const Observer& observer, const continuation::HitObserver& enough = {},
                   const Study* within = nullptr);

}  // namespace springfold::analysis
