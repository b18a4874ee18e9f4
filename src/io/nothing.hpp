// What a quantity is that has no value, in numbers. Private to io.
#pragma once

#include <limits>

namespace springfold::io {

inline constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

}  // namespace springfold::io
