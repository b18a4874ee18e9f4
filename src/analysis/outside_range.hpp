// A number that is not where it is needed, in words. Private to analysis.
#pragma once

#include <string>

#include "springfold/core/number_text.hpp"

namespace springfold::analysis {

/// " is 2.5, outside the range (0 to 1)".
inline std::string outside_range(double value, const std::string& what, double low, double high) {
  constexpr int shown = 6;
  return " is " + rounded(value, shown) + ", outside " + what + " (" + rounded(low, shown) +
         " to " + rounded(high, shown) + ")";
}

}  // namespace springfold::analysis
