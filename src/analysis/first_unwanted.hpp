// The first unwanted point on the path from the start. Private to analysis.
#pragma once

#include "base_path.hpp"

namespace springfold::analysis {

struct FirstUnwanted {
  std::optional<SpecialPoint> point{};  ///< nothing: the path has none, unless `why` says otherwise
  std::string why{};                    ///< why it is not known; empty: it is known
};

/// Follows the curve from the start in the direction in which lambda grows. @param member  nullptr: no start
FirstUnwanted first_unwanted(const Member* member, const CriticalPointSettings& settings,
                             const Observer& observer);

/// Is this special point of the path one of those that are not wanted?
bool is_unwanted(const Member& member, const CriticalPointSettings& settings, const BasePath& path,
                 const SpecialPoint& point);

/// Does the critical curve turn back in the parameter there, or is the point another one behind?
bool ends_piece(continuation::Degeneracy kind);

}  // namespace springfold::analysis
