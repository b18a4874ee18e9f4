// How a long computation is given up from within.
#pragma once

#include <exception>

namespace springfold::continuation {

/// Thrown by what reads or computes for a caller that does not want to wait for the rest. A problem may throw it from
/// its equations, in the middle of a step or of a search: trace() then ends its curve at the last accepted point, as if
/// its observer had stopped it there, trace_diagram() keeps the branches that it has, points_between() the points.
/// Other functions of the engine do not catch it.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

}  // namespace springfold::continuation
