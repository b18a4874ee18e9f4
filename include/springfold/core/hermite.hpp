// The cubic by values and slopes at both ends of an interval.
#pragma once

namespace springfold {

/// Values: numbers or vectors. h: the length of the interval; t: the part of it, 0 to 1.
template <class Value>
struct HermiteCubic {
  Value a{}, slope_a{}, b{}, slope_b{};
  double h = 1;

  Value at(double t) const {
    const double u = 1 - t;
    return u * u * ((1 + 2 * t) * a + t * h * slope_a) +
           t * t * ((1 + 2 * u) * b - u * h * slope_b);
  }
  Value slope_at(double t) const {
    const double u = 1 - t;
    return 6 * t * u / h * (b - a) + u * (u - 2 * t) * slope_a + t * (t - 2 * u) * slope_b;
  }
};

}  // namespace springfold
