// Powers with whole exponents as products: exact signs, and derivatives by complex step at negative bases.
#pragma once

#include <cmath>
#include <type_traits>

namespace springfold::model {

/// base^exponent; small whole exponents by multiplication.
template <class S>
S power_of(const S& base, double exponent) {
  constexpr double most_factors = 64;  // beyond, the library's power is as good
  if (std::floor(exponent) != exponent || std::abs(exponent) > most_factors) {
    if constexpr (std::is_same_v<S, double>)
      return std::pow(base, exponent);
    else  // an error of rounding in the argument must not reach the imaginary part
      return base.real() > 0 ? std::pow(base, exponent)
                             : S(std::pow(base.real(), exponent),
                                 exponent * std::pow(base.real(), exponent - 1) * base.imag());
  }
  S result(1), square = base;
  for (auto rest = static_cast<int>(std::abs(exponent)); rest > 0; rest /= 2) {
    if (rest % 2 == 1) result *= square;
    if (rest > 1) square *= square;
  }
  return exponent < 0 ? S(1) / result : result;
}

}  // namespace springfold::model
