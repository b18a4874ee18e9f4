// The first loss of stability under a growing dead load. Private to analysis.
#pragma once

#include <string>

#include "commanded.hpp"
#include "springfold/continuation/options.hpp"

namespace springfold::analysis {

struct CriticalLoad {
  double load = 0;    ///< physical; +infinity: none up to the limit; NaN: see `why`
  std::string why{};  ///< what could not be done, in words; empty: nothing
};

/// Traces the equilibria of a stable state with fixed commands while a dead load grows along the
/// direction, up to the first point at which a mode becomes unstable.
CriticalLoad critical_load(const CommandSetup& setup, const CommandedState& state,
                           const CriticalSettings& settings,
                           const continuation::TraceOptions& options);

}  // namespace springfold::analysis
