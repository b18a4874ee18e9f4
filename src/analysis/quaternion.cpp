#include "quaternion.hpp"

#include <cmath>
#include <numbers>

namespace springfold::analysis {

Quaternion quaternion_of(const RotationVector& phi) {
  const double a = phi.norm();
  Quaternion q;
  q[0] = std::cos(0.5 * a);
  q.tail<3>() = 0.5 * model::detail::sinc(0.25 * a * a).value * phi;
  return q;
}

Rotation rotation_of(const Quaternion& q) {
  const double w = q[0];
  const RotationVector v = q.tail<3>();
  const Rotation V = model::skew(v);
  return Rotation::Identity() + (2 / q.squaredNorm()) * (w * V + V * V);
}

RotationVector rotation_vector_of(const Quaternion& q) {
  const RotationVector v = q.tail<3>();
  const double n = v.norm();
  if (n < 1e-150 && q[0] > 0) return (2 / q[0]) * v;
  if (n == 0) return 2 * std::numbers::pi * RotationVector::UnitZ();  // any axis is right
  return (2 * std::atan2(n, q[0]) / n) * v;
}

RotationVector nearest_turn(const RotationVector& phi, const RotationVector& near) {
  const double a = phi.norm();
  // Without an axis of its own the rotation vector takes that of the one nearby.
  const RotationVector axis = a > 1e-9             ? RotationVector(phi / a)
                              : near.norm() > 1e-9 ? RotationVector(near.normalized())
                                                   : RotationVector(RotationVector::Zero());
  const double turns = std::round((axis.dot(near) - axis.dot(phi)) / (2 * std::numbers::pi));
  return phi + 2 * std::numbers::pi * turns * axis;
}

Eigen::Matrix<double, 3, 4> rate_of(const Quaternion& q) {
  Eigen::Matrix<double, 3, 4> G;
  const RotationVector v = q.tail<3>();
  G << -v, q[0] * Rotation::Identity() + model::skew(v);
  return (2 / q.squaredNorm()) * G;
}

Eigen::Matrix4d curvature_of(const Quaternion& q, const model::Vec3<double>& r) {
  // eps_2 = -2 a v with a = q.dq/|q|^2 and 2 v = G dq.
  const Quaternion a = q / q.squaredNorm(), v = rate_of(q).transpose() * r;
  return -(a * v.transpose() + v * a.transpose());
}

}  // namespace springfold::analysis
