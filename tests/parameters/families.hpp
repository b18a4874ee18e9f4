// Families of problems with closed forms, for curves in two parameters and laws of imperfections.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <optional>

#include "continuation/problems.hpp"
#include "springfold/parameters/two_parameter.hpp"

namespace springfold::continuation {

/// F = dV/dx of any number of unknowns, with closed forms.
struct Given {
  std::function<Vector(const Vector&, double)> F{};
  std::function<Matrix(const Vector&, double)> J{};
  std::function<Vector(const Vector&, double)> by_lambda{};
  Index n = 1;
  Index size() const { return n; }
  static bool symmetric() { return true; }
  bool residual(const Vector& x, double lambda, Vector& value) const {
    value = F(x, lambda);
    return value.allFinite();
  }
  bool derivatives(const Vector& x, double lambda, Matrix& dF_dx, Vector& dF_dlambda) const {
    dF_dx = J(x, lambda);
    dF_dlambda = by_lambda(x, lambda);
    return true;
  }
};

/// The same in unknowns y with x_1 = y_1, x_i = y_i - y_{i-1}: what exchanges x_i is not orthogonal in them. F_y = T^T
/// F_x.
inline Given in_sums(const Given& of) {
  Matrix T = Matrix::Identity(of.n, of.n);
  for (Index i = 1; i < of.n; ++i) T(i, i - 1) = -1;
  return {[=](const Vector& y, double l) { return Vector(T.transpose() * of.F(T * y, l)); },
          [=](const Vector& y, double l) { return Matrix(T.transpose() * of.J(T * y, l) * T); },
          [=](const Vector& y, double l) { return Vector(T.transpose() * of.by_lambda(T * y, l)); },
          of.n};
}

template <class P>
Family family_of(std::function<P(double)> make) {
  const auto held = std::make_shared<std::optional<P>>();
  return {.at = [=](double mu) -> std::optional<ProblemView> {
    held->emplace(make(mu));
    return ProblemView(**held);
  }};
}

/// V = (q1 - e)^2/2 + 8 q2^2 + S^2/4 + p q1 + m q2, S = q1^2 - e^2 + 4 q2^2.
inline Given arch(double e, double m) {
  return {[=](const Vector& q, double p) {
            const double S = q[0] * q[0] - e * e + 4 * q[1] * q[1];
            return Vector{{q[0] - e + S * q[0] + p, 16 * q[1] + 4 * S * q[1] + m}};
          },
          [=](const Vector& q, double) {
            const double S = q[0] * q[0] - e * e + 4 * q[1] * q[1];
            return Matrix{{1 + S + 2 * q[0] * q[0], 8 * q[0] * q[1]},
                          {8 * q[0] * q[1], 16 + 4 * S + 32 * q[1] * q[1]}};
          },
          [](const Vector&, double) {
            return Vector{{1, 0}};
          },
          2};
}

/// lambda = h(x; mu).
inline Family graphs(std::function<double(double, double)> h,
                     std::function<double(double, double)> slope) {
  return family_of<ScalarProblem>([=](double mu) {
    return graph([=](double x) { return h(x, mu); }, [=](double x) { return slope(x, mu); });
  });
}

inline CriticalStart start_at(CriticalKind kind, Vector x, double lambda, double mu) {
  return {.kind = kind, .x = std::move(x), .lambda = lambda, .mu = mu};
}
inline Vector single(double x) { return Vector::Constant(1, x); }

/// Augusti's column, V = |t - e|^2/2 + P sqrt(1 - sin^2 t1 - sin^2 t2), e = m (cos psi, sin psi).
inline Given augusti(double m, double psi) {
  const auto height = [](const Vector& t) {
    return std::sqrt(1 - std::pow(std::sin(t[0]), 2) - std::pow(std::sin(t[1]), 2));
  };
  const auto slope = [](const Vector& t) {
    return Vector{{std::sin(2 * t[0]) / 2, std::sin(2 * t[1]) / 2}};
  };
  return {
      [=](const Vector& t, double P) {
        return Vector(t - m * Vector{{std::cos(psi), std::sin(psi)}} - P / height(t) * slope(t));
      },
      [=](const Vector& t, double P) {
        const double h = height(t);
        const Vector s = slope(t);
        const Matrix bend = Vector{{std::cos(2 * t[0]), std::cos(2 * t[1])}}.asDiagonal();
        return Matrix(Matrix::Identity(2, 2) - P / h * bend - P / (h * h * h) * s * s.transpose());
      },
      [=](const Vector& t, double) { return Vector(-slope(t) / height(t)); }, 2};
}

/// Ends a curve where its parameter leaves the range.
inline CriticalEvent stop_at(double low, double high) {
  return {"end", [=](const CriticalPoint& p) { return (p.mu - low) * (high - p.mu); },
          EventAction::stop};
}

inline std::vector<CriticalHit> hits_of(const CriticalCurve& curve, Degeneracy kind) {
  std::vector<CriticalHit> list;
  for (const auto& hit : curve.hits)
    if (hit.kind == kind) list.push_back(hit);
  return list;
}

/// V = lambda y - y^2/2 + y^4/12 + x^2 (mu - y)/2: limit point at y = 1, branch point at y = mu.
inline Given hill(double mu) {
  return {
      [=](const Vector& u, double l) {
        return Vector{{u[0] * (mu - u[1]), l - u[1] + u[1] * u[1] * u[1] / 3 - u[0] * u[0] / 2}};
      },
      [=](const Vector& u, double) {
        return Matrix{{mu - u[1], -u[0]}, {-u[0], -1 + u[1] * u[1]}};
      },
      [](const Vector&, double) {
        return Vector{{0, 1}};
      },
      2};
}

}  // namespace springfold::continuation
