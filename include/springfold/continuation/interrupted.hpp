// How a long computation is given up from within.
#pragma once

#include <exception>

namespace springfold::continuation {

/// Thrown by what reads or computes for a caller that does not want to wait for the rest. The engine does not catch it:
/// a curve that is to be kept as far as it is ends by its observer instead.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

}  // namespace springfold::continuation
