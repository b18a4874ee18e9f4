// Why no commands hold a body at a target. Private to analysis.
#pragma once

#include <string>

#include "commanded.hpp"

namespace springfold::analysis {

/// Words for a target that is not held: coordinates on which neither a command nor a spring acts, or how much
/// of the load can be held there, or what is left where the iteration ended.
/// @param target, W  prescribed coordinates and stacked load, dimensionless
/// @param result     of the solve that failed with ControlStatus::not_held
std::string why_not_held(const CommandSetup& setup, const Vector& target, const Vector& W,
                         const statics::ControlResult& result);

}  // namespace springfold::analysis
