// Two branches of one unknown that cross under a small angle.
#pragma once

#include "springfold/continuation/problem.hpp"

namespace springfold::continuation {

/// F = p (p - angle l) with p = x - bend l^2 / 2, l = lambda - place: the branches p = 0 and p = angle l cross at l =
/// 0.
struct Crossing {
  double angle = 0.01, bend = 1, place = 0;
  static Index size() { return 1; }
  static bool symmetric() { return true; }
  bool residual(const Vector& x, double lambda, Vector& F) const {
    const double l = lambda - place, p = x[0] - bend * l * l / 2;
    F = Vector::Constant(1, p * (p - angle * l));
    return true;
  }
  bool derivatives(const Vector& x, double lambda, Matrix& dF_dx, Vector& dF_dlambda) const {
    const double l = lambda - place, p = x[0] - bend * l * l / 2, q = p - angle * l;
    dF_dx = Matrix::Constant(1, 1, p + q);
    dF_dlambda = Vector::Constant(1, -bend * l * q - p * (bend * l + angle));
    return true;
  }
};

}  // namespace springfold::continuation
