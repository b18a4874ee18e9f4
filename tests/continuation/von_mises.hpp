// The von Mises truss that may sway, with its closed forms.
#pragma once

#include <cmath>

#include "springfold/continuation/problem.hpp"

namespace springfold::continuation {

/// Two springs (stiffness k, free length L0) from (-a, 0) and (a, 0) to the point (x, y), pushed
/// down by lambda: gradient of k/2 sum (L_i - L0)^2 + lambda y. Upright (x = 0),
///
///     lambda = 2 k y (L0/L - 1),  L^2 = a^2 + y^2;
///
/// limit points at L^3 = L0 a^2, branch points of sway at L^3 - L0 L^2 + L0 a^2 = 0.
struct VonMises {
  double a = 1, k = 1, L0 = 1.25;

  static Index size() { return 2; }
  static bool symmetric() { return true; }
  bool residual(const Vector& u, double lambda, Vector& F) const {
    F = Vector{{0, lambda}};
    for (const double side : {-1.0, 1.0}) {
      const Vector arm{{u[0] - side * a, u[1]}};
      const double L = arm.norm();
      if (!(L > 1e-6)) return false;
      F += k * (1 - L0 / L) * arm;
    }
    return true;
  }
  bool derivatives(const Vector& u, double, Matrix& dF_dx, Vector& dF_dlambda) const {
    dF_dx = Matrix::Zero(2, 2);
    dF_dlambda = Vector{{0, 1}};
    for (const double side : {-1.0, 1.0}) {
      const Vector arm{{u[0] - side * a, u[1]}};
      const double L = arm.norm();
      if (!(L > 1e-6)) return false;
      dF_dx +=
          k * (1 - L0 / L) * Matrix::Identity(2, 2) + k * L0 / (L * L * L) * arm * arm.transpose();
    }
    return true;
  }
  double upright_load(double y) const { return 2 * k * y * (L0 / std::hypot(a, y) - 1); }
  double height_at_limit_point() const {
    return std::sqrt(std::cbrt(L0 * L0 * a * a * a * a) - a * a);
  }
};

}  // namespace springfold::continuation
