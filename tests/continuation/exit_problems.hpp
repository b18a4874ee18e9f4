// Problems with closed-form branches at their singular points, hidden among many unknowns.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "continuation/locating/exits.hpp"
#include "problems.hpp"

namespace springfold::continuation {

/// F, dF/dz and dF/dlambda of a problem in few unknowns.
struct Small {
  Index n = 1;
  std::function<void(const Vector& z, double l, Vector& F, Matrix& H, Vector& F_l)> at{};
  bool potential = true;

  Index size() const { return n; }
  bool symmetric() const { return potential; }
  bool residual(const Vector& z, double l, Vector& F) const {
    Matrix H(n, n);
    Vector F_l(n);
    F.resize(n);
    at(z, l, F, H, F_l);
    return true;
  }
  bool derivatives(const Vector& z, double l, Matrix& H, Vector& F_l) const {
    Vector F(n);
    H.resize(n, n);
    F_l.resize(n);
    at(z, l, F, H, F_l);
    return true;
  }
};

inline double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

inline Matrix random_square(std::mt19937_64& random, Index n) {
  Matrix M(n, n);
  for (double& value : M.reshaped()) value = uniform(random, -1, 1);
  return M;
}

/// The same branches among more unknowns: gradient of V(z) + 1/2 sum k_i (w_i - sin z_(i mod n))^2 in
/// q = T (z, w), left-multiplied by the regular matrix `mix`.
struct Hidden {
  Small small{};
  Matrix T{}, inverse{}, mix{};
  Vector k{};
  bool mixed = false;

  Hidden(Small inner, Index n, std::mt19937_64& random, double stretch, bool mixes = false)
      : small{std::move(inner)}, mixed{mixes} {
    T = Eigen::HouseholderQR<Matrix>(random_square(random, n)).householderQ();
    for (Index i = 0; i < n; ++i) T.col(i) *= std::pow(stretch, uniform(random, -1, 1));
    inverse = T.inverse();
    mix = mixed ? Matrix(random_square(random, n) + 3 * Matrix::Identity(n, n))
                : Matrix::Identity(n, n);
    k.resize(n - small.n);
    for (double& value : k) value = uniform(random, 0.3, 3) * (random() % 5 == 0 ? -1 : 1);
  }
  Index size() const { return T.rows(); }
  bool symmetric() const { return !mixed && small.potential; }
  void evaluate(const Vector& q, double l, Vector& F, Matrix& H, Vector& F_l) const {
    const Vector zw = inverse * q;
    const Index m = small.n;
    Vector f(m), f_l(m);
    Matrix h(m, m);
    small.at(zw.head(m), l, f, h, f_l);
    F = F_l = Vector::Zero(size());
    H = Matrix::Zero(size(), size());
    F.head(m) = f, F_l.head(m) = f_l, H.topLeftCorner(m, m) = h;
    for (Index i = 0; i < k.size(); ++i) {
      const Index w = m + i, z = i % m;
      const double s = std::sin(zw[z]), c = std::cos(zw[z]), off = zw[w] - s;
      F[w] += k[i] * off, F[z] -= k[i] * off * c;
      H(w, w) += k[i], H(w, z) -= k[i] * c, H(z, w) -= k[i] * c;
      H(z, z) += k[i] * (c * c + off * s);
    }
    F = mix * (inverse.transpose() * F);
    H = mix * (inverse.transpose() * H * inverse);
    F_l = mix * (inverse.transpose() * F_l);
  }
  bool residual(const Vector& q, double l, Vector& F) const {
    Vector F_l;
    Matrix H;
    evaluate(q, l, F, H, F_l);
    return true;
  }
  bool derivatives(const Vector& q, double l, Matrix& H, Vector& F_l) const {
    Vector F;
    evaluate(q, l, F, H, F_l);
    return true;
  }
  CurvePoint place(const Vector& z, double l) const {
    Vector zw(size());
    zw.head(small.n) = z;
    for (Index i = 0; i < k.size(); ++i) zw[small.n + i] = std::sin(z[i % small.n]);
    return {.x = T * zw, .lambda = l};
  }
  /// Direction of a branch of the small problem through z among all unknowns.
  Direction lift(const Vector& z, const Vector& dz, double dl) const {
    Vector zw(size());
    zw.head(small.n) = dz;
    for (Index i = 0; i < k.size(); ++i)
      zw[small.n + i] = std::cos(z[i % small.n]) * dz[i % small.n];
    Direction d{T * zw, dl};
    const double length = std::sqrt(d.dx.squaredNorm() + dl * dl);
    return {d.dx / length, dl / length};
  }
};

template <class P>
inline Walker walker_of(const P& problem) {
  return {problem, ProblemView(problem).metric(), TraceOptions{}};
}

inline Direction unit(Vector dx, double dl) {
  const double length = std::sqrt(dx.squaredNorm() + dl * dl);
  return {dx / length, dl / length};
}

inline double distance(const Direction& a, const Direction& b) {
  return std::hypot((a.dx - b.dx).norm(), a.dlambda - b.dlambda);
}

/// Every expected tangent occurs exactly once, nothing else does, and the starts are points of
/// branches with residual and tangent as promised.
inline void expect_exits(const Walker& walker, const CurvePoint& at, const Exits& found,
                         const std::vector<Direction>& expected, double tolerance) {
  EXPECT_TRUE(found.complete) << found.why;
  ASSERT_EQ(found.exits.size(), expected.size());
  for (const Direction& d : expected) {
    double nearest = 9;
    for (const Exit& exit : found.exits) nearest = std::min(nearest, distance(exit.tangent, d));
    EXPECT_LT(nearest, tolerance) << d.dx.transpose() << " , " << d.dlambda;
  }
  for (const Exit& exit : found.exits) {
    Vector F;
    ASSERT_TRUE(walker.problem.residual(exit.start.x, exit.start.lambda, exit.start.piece, F));
    EXPECT_LT(F.lpNorm<Eigen::Infinity>(), 1e-11);
    const Direction chord = unit(exit.start.x - at.x, exit.start.lambda - at.lambda);
    EXPECT_LT(distance(chord, exit.start.tangent), 0.55);
    EXPECT_LT(distance(chord, exit.tangent), 0.55);
    EXPECT_GT(exit.start.s, 1e-6);
  }
}

inline void both_ways(std::vector<Direction>& list, const Direction& d) {
  list.push_back(d);
  list.push_back({-d.dx, -d.dlambda});
}

inline CurvePoint origin(Index n) { return {.x = Vector::Zero(n), .lambda = 0}; }

}  // namespace springfold::continuation
