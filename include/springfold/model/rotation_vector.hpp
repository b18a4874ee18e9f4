// Rotation vectors: exponential, logarithm and their derivatives. phi is the rotation by |phi| rad
// about phi / |phi|; all perturbations are world-aligned: R -> Exp(eps) R.
#pragma once

#include <array>
#include <cmath>

#include "springfold/model/se3.hpp"

namespace springfold::model {

namespace detail {

/// Value of an analytic function of u = |phi|^2 and its derivative by u.
template <class S>
struct Series {
  S value{}, slope{};
};

template <class S, std::size_t N>
Series<S> power_series(const std::array<double, N>& c, const S& u) {
  Series<S> r{S(c[N - 1]), S(0)};
  for (std::size_t k = N - 1; k-- > 0;) {
    r.slope = r.slope * u + r.value;
    r.value = r.value * u + c[k];
  }
  return r;
}

template <class S>
bool is_small(const S& u) {
  using std::abs;
  return abs(u) < 1.0;
}

/// sin(a)/a, a^2 = u.
template <class S>
Series<S> sinc(const S& u) {
  if (is_small(u))
    return power_series<S, 10>(
        {1, -1. / 6, 1. / 120, -1. / 5040, 1. / 362880, -1. / 39916800, 1. / 6227020800,
         -1. / 1307674368000, 1. / 355687428096000, -1. / 121645100408832000},
        u);
  using std::cos;
  using std::sin;
  using std::sqrt;
  const S a = sqrt(u), value = sin(a) / a;
  return {value, (cos(a) - value) / (2.0 * u)};
}

/// (1 - cos a)/a^2, a^2 = u.
template <class S>
Series<S> versine(const S& u) {
  if (is_small(u))
    return power_series<S, 10>(
        {1. / 2, -1. / 24, 1. / 720, -1. / 40320, 1. / 3628800, -1. / 479001600, 1. / 87178291200,
         -1. / 20922789888000, 1. / 6402373705728000, -1. / 2432902008176640000},
        u);
  using std::cos;
  const S value = (1.0 - cos(S(sqrt(u)))) / u;
  return {value, (0.5 * sinc(u).value - value) / u};
}

/// (a - sin a)/a^3, a^2 = u.
template <class S>
Series<S> third(const S& u) {
  if (is_small(u))
    return power_series<S, 10>({1. / 6, -1. / 120, 1. / 5040, -1. / 362880, 1. / 39916800,
                                -1. / 6227020800, 1. / 1307674368000, -1. / 355687428096000,
                                1. / 121645100408832000, -1. / 51090942171709440000.},
                               u);
  const Series<S> s = sinc(u);
  const S value = (1.0 - s.value) / u;
  return {value, (-s.slope - value) / u};
}

/// (1 - (a/2) cot(a/2))/a^2, a^2 = u: of the inverse left Jacobian; singular at a = 2 pi.
template <class S>
Series<S> cotangent(const S& u) {
  if (is_small(u))  // |B_2k| / (2k)!; the last ones to the digits that matter
    return power_series<S, 11>(
        {1. / 12, 1. / 720, 1. / 30240, 1. / 1209600, 1. / 47900160, 691. / 1307674368000.,
         1. / 74724249600., 3617. / 10670622842880000., 8.5860620562778446e-15,
         2.1748686985580618e-16, 5.5090028283602295e-18},
        u);
  using std::cos;
  using std::sin;
  using std::sqrt;
  const S x = 0.5 * S(sqrt(u)), cot = cos(x) / sin(x), g = x * cot;
  const S value = (1.0 - g) / u;
  const S dg_du = (cot - x * (1.0 + cot * cot)) / (8.0 * x);
  return {value, (-dg_du - value) / u};
}

}  // namespace detail

/// R = Exp(phi).
template <class S>
Mat3<S> exp_rotation(const Vec3<S>& phi) {
  const S u = dot(phi, phi);
  const Mat3<S> P = skew(phi);
  return Mat3<S>::Identity() + detail::sinc(u).value * P + detail::versine(u).value * (P * P);
}

/// J_l: Exp(phi + d) = Exp(J_l d) Exp(phi) to first order.
template <class S>
Mat3<S> left_jacobian(const Vec3<S>& phi) {
  const S u = dot(phi, phi);
  const Mat3<S> P = skew(phi);
  return Mat3<S>::Identity() + detail::versine(u).value * P + detail::third(u).value * (P * P);
}

/// dJ_l/dphi_j as matrices, j = 0, 1, 2.
template <class S>
std::array<Mat3<S>, 3> left_jacobian_derivatives(const Vec3<S>& phi) {
  const S u = dot(phi, phi);
  const detail::Series<S> b = detail::versine(u), c = detail::third(u);
  const Mat3<S> P = skew(phi), PP = P * P;
  std::array<Mat3<S>, 3> derivatives;
  for (int j = 0; j < 3; ++j) {
    const Mat3<S> E = skew<S>(Vec3<S>::Unit(j));
    const S du = 2.0 * phi[j];
    derivatives[static_cast<std::size_t>(j)] =
        b.value * E + (b.slope * du) * P + c.value * (E * P + P * E) + (c.slope * du) * PP;
  }
  return derivatives;
}

/// J_l^-1: Log(Exp(e) R) = phi + J_l^-1 e to first order, phi = Log(R), |phi| < 2 pi.
template <class S>
Mat3<S> inverse_left_jacobian(const Vec3<S>& phi) {
  const S u = dot(phi, phi);
  const Mat3<S> P = skew(phi);
  return Mat3<S>::Identity() - S(0.5) * P + detail::cotangent(u).value * (P * P);
}

/// Symmetric S with m . Log(Exp(e) R) = m . phi + (J_l^-T m) . e + e^T S e / 2 to second order.
template <class S>
Mat3<S> log_hessian(const Vec3<S>& phi, const Vec3<S>& m) {
  const S u = dot(phi, phi);
  const detail::Series<S> c = detail::cotangent(u);
  const Mat3<S> P = skew(phi), PP = P * P, inverse = inverse_left_jacobian(phi);
  Mat3<S> rows;  // row j: m^T dJ_l^-1[column j of J_l^-1]
  for (int j = 0; j < 3; ++j) {
    const Vec3<S> eta = inverse.col(j);
    const Mat3<S> E = skew(eta);
    const Mat3<S> D =
        S(-0.5) * E + (c.slope * (2.0 * dot(phi, eta))) * PP + c.value * (P * E + E * P);
    rows.row(j) = m.transpose() * D;
  }
  return S(0.5) * (rows + rows.transpose());
}

/// phi = Log(R), |phi| <= pi; at |phi| = pi one of the two equal vectors.
template <class S>
Vec3<S> log_rotation(const Mat3<S>& R) {
  // Unit quaternion (w, v) by its largest component: no cancellation at any angle.
  using std::atan2;
  using std::sqrt;
  const S trace = R(0, 0) + R(1, 1) + R(2, 2);
  Eigen::Matrix<S, 4, 1> q;  // 4 w^2, 4 x^2, 4 y^2, 4 z^2 first
  q << S(1) + trace, S(1) + 2.0 * R(0, 0) - trace, S(1) + 2.0 * R(1, 1) - trace,
      S(1) + 2.0 * R(2, 2) - trace;
  int k = 0;
  for (int i = 1; i < 4; ++i)
    if (std::real(q[i]) > std::real(q[k])) k = i;
  const S root = sqrt(q[k]), f = 0.5 / root;
  const S wx = R(2, 1) - R(1, 2), wy = R(0, 2) - R(2, 0), wz = R(1, 0) - R(0, 1);
  const S xy = R(0, 1) + R(1, 0), xz = R(0, 2) + R(2, 0), yz = R(1, 2) + R(2, 1);
  S w;
  Vec3<S> v;
  switch (k) {
    case 0:
      w = 0.5 * root, v = Vec3<S>(wx, wy, wz) * f;
      break;
    case 1:
      w = wx * f, v = Vec3<S>(0.5 * root, xy * f, xz * f);
      break;
    case 2:
      w = wy * f, v = Vec3<S>(xy * f, 0.5 * root, yz * f);
      break;
    default:
      w = wz * f, v = Vec3<S>(xz * f, yz * f, 0.5 * root);
      break;
  }
  if (std::real(w) < 0) w = -w, v = -v;
  const S vv = dot(v, v);
  if (std::abs(vv) < 1e-40) return S(2) * v;
  const S n = sqrt(vv);
  if constexpr (std::is_floating_point_v<S>)
    return (2 * atan2(n, w) / n) * v;
  else
    return (S(2) * atan(n / w) / n) * v;  // complex step: w > 0 away from pi
}

}  // namespace springfold::model
