// Functions of a few vectors with exact gradients and Hessians, and the rules by which others are
// made of them. Templated on the scalar.
#pragma once

#include <cmath>
#include <complex>

#include "springfold/core/types.hpp"
#include "springfold/model/se3.hpp"

namespace springfold::model::detail {

/// A function of D vectors d_1, ..., d_D.
template <class S, int D>
struct Form {
  S value{};
  Eigen::Matrix<S, 3 * D, 1> g = Eigen::Matrix<S, 3 * D, 1>::Zero();          ///< gradient
  Eigen::Matrix<S, 3 * D, 3 * D> H = Eigen::Matrix<S, 3 * D, 3 * D>::Zero();  ///< Hessian
  void put(int i, const Vec3<S>& gradient) { g.template segment<3>(3 * i) += gradient; }
  /// The block d2/(dd_i dd_j), and its transpose.
  void put(int i, int j, const Mat3<S>& block) {
    H.template block<3, 3>(3 * i, 3 * j) += block;
    if (i != j) H.template block<3, 3>(3 * j, 3 * i) += block.transpose();
  }
};

template <class S, int D>
using Vectors = std::array<Vec3<S>, static_cast<std::size_t>(D)>;

template <class S>
Mat3<S> outer(const Vec3<S>& a, const Vec3<S>& b) {
  return a * b.transpose();
}

/// u(f) with u' and u'' at f.
template <class S, int D>
Form<S, D> composed(const Form<S, D>& f, const S& u, const S& slope, const S& curvature) {
  return {u, slope * f.g, slope * f.H + curvature * f.g * f.g.transpose()};
}

/// f^p for f > 0.
template <class S, int D>
Form<S, D> power(const Form<S, D>& f, double p) {
  const S u = std::pow(f.value, p);
  return composed(f, u, S(p * u / f.value), S(p * (p - 1) * u / (f.value * f.value)));
}

template <class S, int D>
Form<S, D> product(const Form<S, D>& a, const Form<S, D>& b) {
  return {a.value * b.value, a.value * b.g + b.value * a.g,
          a.value * b.H + b.value * a.H + a.g * b.g.transpose() + b.g * a.g.transpose()};
}

inline double arc_tangent(double y, double x) { return std::atan2(y, x); }
/// Continued to complex numbers near the real axis.
inline std::complex<double> arc_tangent(std::complex<double> y, std::complex<double> x) {
  const std::complex<double> size = x * x + y * y;
  const std::complex<double> turned = x * y.real() - y * x.real();  // small: of the imaginary parts
  return std::atan2(y.real(), x.real()) - std::complex<double>(0, turned.imag() / size.real());
}

/// The angle of (x, y):
///
///     d alpha = (x dy - y dx)/r^2,   r^2 = x^2 + y^2,
///     r^2 d2alpha = x d2y - y d2x + [(y^2 - x^2)(dx dy^T + dy dx^T) + 2 x y (dx dx^T - dy dy^T)]/r^2
template <class S, int D>
Form<S, D> direction(const Form<S, D>& y, const Form<S, D>& x) {
  const S r2 = x.value * x.value + y.value * y.value;
  const S a = (y.value * y.value - x.value * x.value) / (r2 * r2);
  const S b = S(2) * x.value * y.value / (r2 * r2);
  Form<S, D> f;
  f.value = arc_tangent(y.value, x.value);
  f.g = (x.value * y.g - y.value * x.g) / r2;
  f.H = (x.value * y.H - y.value * x.H) / r2 + a * (x.g * y.g.transpose() + y.g * x.g.transpose()) +
        b * (x.g * x.g.transpose() - y.g * y.g.transpose());
  return f;
}

/// d_i . d_j
template <class S, int D>
Form<S, D> inner(const Vectors<S, D>& d, int i, int j) {
  const auto &a = d[static_cast<std::size_t>(i)], &b = d[static_cast<std::size_t>(j)];
  Form<S, D> f;
  f.value = dot<S>(a, b);
  f.put(i, b);
  f.put(j, a);
  const Mat3<S> one = Mat3<S>::Identity();
  f.put(i, j, i == j ? Mat3<S>(S(2) * one) : one);
  return f;
}

/// (d_i x d_j) . e_z
template <class S, int D>
Form<S, D> cross_z(const Vectors<S, D>& d, int i, int j) {
  const auto &a = d[static_cast<std::size_t>(i)], &b = d[static_cast<std::size_t>(j)];
  Form<S, D> f;
  f.value = a[0] * b[1] - a[1] * b[0];
  f.put(i, {b[1], -b[0], S(0)});
  f.put(j, {-a[1], a[0], S(0)});
  Mat3<S> block = Mat3<S>::Zero();
  block(0, 1) = S(1);
  block(1, 0) = S(-1);
  f.put(i, j, block);
  return f;
}

/// |d_i x d_j|^2
template <class S, int D>
Form<S, D> cross_square(const Vectors<S, D>& d, int i, int j) {
  const auto &a = d[static_cast<std::size_t>(i)], &b = d[static_cast<std::size_t>(j)];
  const Vec3<S> c = cross<S>(a, b);
  const Mat3<S> one = Mat3<S>::Identity();
  const S ab = dot<S>(a, b);
  Form<S, D> f;
  f.value = dot<S>(c, c);
  f.put(i, S(2) * cross<S>(b, c));
  f.put(j, S(2) * cross<S>(c, a));
  f.put(i, i, S(2) * (dot<S>(b, b) * one - outer<S>(b, b)));
  f.put(j, j, S(2) * (dot<S>(a, a) * one - outer<S>(a, a)));
  f.put(i, j, S(4) * outer<S>(a, b) - S(2) * outer<S>(b, a) - S(2) * ab * one);
  return f;
}

/// d_1 . (d_2 x d_3)
template <class S>
Form<S, 3> triple(const Vectors<S, 3>& d) {
  Form<S, 3> f;
  f.value = dot<S>(d[0], cross<S>(d[1], d[2]));
  f.put(0, cross<S>(d[1], d[2]));
  f.put(1, cross<S>(d[2], d[0]));
  f.put(2, cross<S>(d[0], d[1]));
  f.put(0, 1, -skew<S>(d[2]));
  f.put(0, 2, skew<S>(d[1]));
  f.put(1, 2, -skew<S>(d[0]));
  return f;
}

/// (d_1 x d_2) . (d_2 x d_3)
template <class S>
Form<S, 3> cross_inner(const Vectors<S, 3>& d) {
  const Vec3<S> n = cross<S>(d[0], d[1]), m = cross<S>(d[1], d[2]);
  const Mat3<S> one = Mat3<S>::Identity();
  Form<S, 3> f;
  f.value = dot<S>(n, m);
  f.put(0, cross<S>(d[1], m));
  f.put(1, cross<S>(m, d[0]) + cross<S>(d[2], n));
  f.put(2, cross<S>(n, d[1]));
  f.put(0, 1, outer<S>(d[1], d[2]) + dot<S>(d[1], d[2]) * one - S(2) * outer<S>(d[2], d[1]));
  f.put(0, 2, outer<S>(d[1], d[1]) - dot<S>(d[1], d[1]) * one);
  f.put(1, 1, outer<S>(d[0], d[2]) + outer<S>(d[2], d[0]) - S(2) * dot<S>(d[0], d[2]) * one);
  f.put(1, 2, outer<S>(d[0], d[1]) + dot<S>(d[0], d[1]) * one - S(2) * outer<S>(d[1], d[0]));
  return f;
}

}  // namespace springfold::model::detail
