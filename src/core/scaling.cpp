#include "springfold/core/scaling.hpp"

#include <cmath>

namespace springfold {

double power_of_two_near(double value) {
  if (value == 0 || !std::isfinite(value)) return 1;
  int exponent = 0;
  const double mantissa = std::frexp(std::abs(value), &exponent);  // in [1/2, 1)
  constexpr double sqrt_half = 0.70710678118654752440;
  return std::ldexp(1.0, mantissa < sqrt_half ? exponent - 1 : exponent);
}

}  // namespace springfold
