// Switching springs in words. Private to analysis.
#pragma once

#include <string>

#include "springfold/continuation/curve.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::analysis {

/// The spring of a switch, of a joint or of a shape: its law, name, and the number of its first switch.
const model::CompiledSpring& law_of(const statics::System& system, const statics::Switch& s);
const std::string& name_of(const statics::System& system, const statics::Switch& s);
std::size_t first_switch_of(const statics::System& system, const statics::Switch& s);

/// Are the laws of all springs that switch there one straight line on both sides? Then nothing changes.
bool is_between_equal_segments(const statics::System& system, const continuation::Hit& hit,
                               const Piece& before, const Piece& after);

/// "spring leg.knee becomes active (segment 0 to 1)", one for each spring that switches.
std::string switching_detail(const statics::System& system, const continuation::Hit& hit,
                             const Piece& before, const Piece& after);

}  // namespace springfold::analysis
