// Energies with known jumps, as problems of the engine.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "analysis/landscape.hpp"

namespace springfold::analysis::test {

inline constexpr double degree = std::numbers::pi / 180;

/// F = grad V(x, lambda), without closures.
struct EnergyProblem {
  std::function<double(const Vector&, double)> V{};
  std::function<Vector(const Vector&, double)> gradient{};
  std::function<Matrix(const Vector&, double)> hessian{};
  Index n = 1;

  Index size() const { return n; }
  bool symmetric() const { return true; }
  bool residual(const Vector& x, double lambda, Vector& F) const {
    F = gradient(x, lambda);
    return F.allFinite();
  }
  bool derivatives(const Vector& x, double lambda, Matrix& A, Vector& b) const {
    A = hessian(x, lambda);
    constexpr double h = 0x1p-10;
    b = (gradient(x, lambda + h) - gradient(x, lambda - h)) / (2 * h);  // linear in lambda
    return A.allFinite();
  }
};

inline Landscape landscape_of(const EnergyProblem& problem, double lambda) {
  return Landscape(
      Terrain{.problem = problem,
              .lambda = lambda,
              .is_multiplier = std::vector<bool>(static_cast<std::size_t>(problem.n)),
              .energy = [&problem, lambda](const Vector& x) { return problem.V(x, lambda); }});
}

/// V = (q1 - e)^2/2 + 8 q2^2 + S^2/4 + p q1 + m q2, S = q1^2 - e^2 + 4 q2^2; lambda = p.
inline EnergyProblem shallow_arch(double e, double m = 0) {
  const auto S = [e](const Vector& q) { return q[0] * q[0] - e * e + 4 * q[1] * q[1]; };
  return {.V =
              [=](const Vector& q, double p) {
                return (q[0] - e) * (q[0] - e) / 2 + 8 * q[1] * q[1] + S(q) * S(q) / 4 + p * q[0] +
                       m * q[1];
              },
          .gradient =
              [=](const Vector& q, double p) {
                return Vector(
                    Eigen::Vector2d(q[0] - e + S(q) * q[0] + p, 16 * q[1] + 4 * S(q) * q[1] + m));
              },
          .hessian =
              [=](const Vector& q, double) {
                Matrix H(2, 2);
                H << 1 + S(q) + 2 * q[0] * q[0], 8 * q[0] * q[1], 8 * q[0] * q[1],
                    16 + 4 * S(q) + 32 * q[1] * q[1];
                return H;
              },
          .n = 2};
}

/// Von Mises truss of half span 1 and bars of stiffness 1 on its axis: energy over the travel w of its
/// apex, first and second derivative.
struct TrussEnergy {
  double U = 0, force = 0, stiffness = 0;
};
inline TrussEnergy truss_at(double angle, double w) {
  const double h = std::tan(angle), L0 = 1 / std::cos(angle), y = h - w;
  const double L = std::sqrt(1 + y * y);
  return {(L - L0) * (L - L0), -2 * (L - L0) * y / L,
          2 * (y * y / (L * L) + (L - L0) / (L * L * L))};
}

/// Trusses one on top of the other, unknowns are their own travels; lambda = load on the top.
inline EnergyProblem trusses_in_series(std::vector<double> angles) {
  const auto n = static_cast<Index>(angles.size());
  return {.V =
              [angles](const Vector& w, double P) {
                double V = 0;
                for (Index i = 0; i < w.size(); ++i)
                  V += truss_at(angles[static_cast<std::size_t>(i)], w[i]).U - P * w[i];
                return V;
              },
          .gradient =
              [angles](const Vector& w, double P) {
                Vector g(w.size());
                for (Index i = 0; i < w.size(); ++i)
                  g[i] = truss_at(angles[static_cast<std::size_t>(i)], w[i]).force - P;
                return g;
              },
          .hessian =
              [angles](const Vector& w, double) {
                Matrix H = Matrix::Zero(w.size(), w.size());
                for (Index i = 0; i < w.size(); ++i)
                  H(i, i) = truss_at(angles[static_cast<std::size_t>(i)], w[i]).stiffness;
                return H;
              },
          .n = n};
}

}  // namespace springfold::analysis::test
