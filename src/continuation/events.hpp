// Events on one step, for the tracer. Private to the engine.
#pragma once

#include <string>
#include <vector>

#include "springfold/continuation/step.hpp"

namespace springfold::continuation {

/// All smooth special points on the step from -> to (same piece), in order.
struct StepEvents {
  std::vector<Hit> hits{};
  std::vector<bool> stops{};  ///< per hit: ends the trace
  bool explained = true;      ///< false: the change of negative eigenvalues is not accounted for
  std::string failure{};      ///< set: an event is there but could not be located
};

/// @param known_from  negative eigenvalues on this side of `from`, if known
StepEvents events_on_step(const Walker& walker, const CurvePoint& from, const CurvePoint& to,
                          const std::optional<Index>& known_from, const std::vector<Event>& events);

}  // namespace springfold::continuation
