// Scales are powers of two: dividing by them is exact.
#pragma once

namespace springfold {

/// The power of two next to |value| in the logarithmic sense; 1 for 0, infinities and NaN.
/// power_of_two_near(2^k * v) == 2^k * power_of_two_near(v), exactly.
double power_of_two_near(double value);

}  // namespace springfold
