// What floating point leaves: numbers that belong to no problem.
#pragma once

#include <limits>

namespace springfold {

inline constexpr double rounding_unit = std::numeric_limits<double>::epsilon();
inline constexpr double infinity = std::numeric_limits<double>::infinity(),
                        not_a_number = std::numeric_limits<double>::quiet_NaN();
/// Guards divisions by lengths that may be zero.
inline constexpr double smallest_number = std::numeric_limits<double>::min();
/// A few units of rounding: numbers nearer to each other than this share are one, smaller pivots are zero.
inline constexpr double few_roundings = 4 * rounding_unit;

}  // namespace springfold
