// Switching springs in words. Private to analysis.
#pragma once

#include <string>

#include "springfold/continuation/curve.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::analysis {

/// "spring leg.knee becomes active (segment 0 to 1)", one for each spring that switches.
std::string switching_detail(const statics::System& system, const continuation::Hit& hit,
                             const Piece& before, const Piece& after);

}  // namespace springfold::analysis
