// Springs that stand at a threshold at the start, but for what the engine cannot tell from zero. Private to analysis.
#pragma once

#include "setup.hpp"
#include "springfold/analysis/result.hpp"
#include "springfold/statics/first_equilibrium.hpp"

namespace springfold::analysis {

/// A mechanism at its start.
struct Begin {
  model::Mechanism mechanism{};
  Setup setup{};
  statics::FirstEquilibrium first{};
};

/// Sets a study up and finds its start as find_start() does. Where springs stand nearer to a threshold than switches
/// are told apart (TraceOptions::simultaneous, dimensionless) but not upon it, they are moved onto it: their threshold
/// is shifted by that little (model::with_breakpoint), and the equilibrium solved again. Otherwise values of switches
/// would say that they rest while forces and stiffness say that they are stretched, or slack; pieces would not meet in
/// the state. Left out under control by a parameter, which may move the thresholds themselves, and where there are no
/// curves.
/// @param family  needed for control mode `parameter` only, otherwise nullptr
Begin begin_study(const model::Mechanism& mechanism, const Study& study,
                  const ParameterFamily* family, StartReport& report);

}  // namespace springfold::analysis
