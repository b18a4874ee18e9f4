// Rotations and rigid motions, templated on the scalar: the same lines serve double, complex step,
// Taylor series and intervals. Eigen's own cross() and dot() conjugate complex numbers; these do not.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace springfold::model {

template <class S>
using Vec3 = Eigen::Matrix<S, 3, 1>;
template <class S>
using Mat3 = Eigen::Matrix<S, 3, 3>;

/// Bilinear product a . b, without conjugation.
template <class S>
S dot(const Vec3<S>& a, const Vec3<S>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Bilinear product a x b, without conjugation.
template <class S>
Vec3<S> cross(const Vec3<S>& a, const Vec3<S>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Matrix of a x (.).
template <class S>
Mat3<S> skew(const Vec3<S>& a) {
  Mat3<S> m;
  m << S(0), -a[2], a[1], a[2], S(0), -a[0], -a[1], a[0], S(0);
  return m;
}

/// Pose of frame B seen from frame A: p_A = R_AB p_B + p_AB.
template <class S>
struct Pose {
  Mat3<S> R = Mat3<S>::Identity();  ///< R_AB, orthogonal [-]
  Vec3<S> p = Vec3<S>::Zero();      ///< p_AB, origin of B in the axes of A [length]

  template <class U>
  Pose<U> cast() const {
    return {R.template cast<U>(), p.template cast<U>()};
  }
};

/// T_AC = T_AB T_BC.
template <class S>
Pose<S> operator*(const Pose<S>& T_AB, const Pose<S>& T_BC) {
  return {T_AB.R * T_BC.R, T_AB.R * T_BC.p + T_AB.p};
}

/// Rotation by `angle` [rad] about the constant unit vector `axis` (Rodrigues).
template <class S>
Mat3<S> rotation_about(const Vec3<double>& axis, const S& angle) {
  using std::cos;
  using std::sin;
  const Mat3<S> A = skew<double>(axis).template cast<S>();
  const S half_sine = sin(angle * 0.5);
  return Mat3<S>::Identity() + sin(angle) * A + (S(2) * half_sine * half_sine) * (A * A);
}

}  // namespace springfold::model
