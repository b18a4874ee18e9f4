// What is not defined, in numbers.
#pragma once

#include <limits>

namespace springfold::analysis {

inline constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

}  // namespace springfold::analysis
