// Problems in one unknown.
#pragma once

#include "draw.hpp"

namespace springfold::known_answers {

inline Vector scalar(double value) { return Vector::Constant(1, value); }

/// F, F_x, F_lambda from one function f(x, lambda, F, F_x, F_lambda).
template <class Function>
Base one_unknown(Function f) {
  return {
      1, [f](const Vector& z, double lambda, const Piece&, Vector& F, Matrix& H, Vector& F_lambda) {
        double value = 0, slope = 0, rate = 0;
        f(z[0], lambda, value, slope, rate);
        F = scalar(value);
        H = Matrix::Constant(1, 1, slope);
        F_lambda = scalar(rate);
        return true;
      }};
}

}  // namespace springfold::known_answers
