// How a long computation is given up from within.
#pragma once

#include <exception>

namespace springfold::continuation {

/// Thrown by an evaluation of a problem whose caller does not want to wait for the rest; it is all that
/// evaluations may throw. Curves, diagrams, searches and points between others end there and return
/// what was finished until then.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

}  // namespace springfold::continuation
