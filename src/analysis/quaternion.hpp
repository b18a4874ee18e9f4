// Rotations as quaternions of any length: no rotation is singular, and going round and round is smooth.
// Private to analysis.
#pragma once

#include "springfold/model/rotation_vector.hpp"

namespace springfold::analysis {

using Quaternion = Eigen::Vector4d;  ///< (w, x, y, z); all multiples are the same rotation
using Rotation = model::Mat3<double>;
using RotationVector = model::Vec3<double>;

/// Unit quaternion of Exp(phi): (cos a/2, sin a/2 phi/a), a = |phi|.
Quaternion quaternion_of(const RotationVector& phi);

Rotation rotation_of(const Quaternion& q);

/// phi with Exp(phi) = R(q), 0 <= |phi| <= 2 pi: q and -q have different ones. It jumps where
/// |phi| = 2 pi.
RotationVector rotation_vector_of(const Quaternion& q);

/// Of phi and all vectors of the same rotation, phi + 2 pi k phi/|phi|, the one nearest to `near`.
RotationVector nearest_turn(const RotationVector& phi, const RotationVector& near);

/// The change of a quaternion as a motion of the world: R(q + dq) = Exp(eps) R(q) with
///
///     eps = G dq + (1/2) [dq^T B_k dq]_k + third order,     dq q^-1 = (a, v):  eps = 2 v - 2 a v.
///
/// G q = 0: lengthening q turns nothing.
Eigen::Matrix<double, 3, 4> rate_of(const Quaternion& q);
/// sum_k r_k B_k, symmetric.
Eigen::Matrix4d curvature_of(const Quaternion& q, const model::Vec3<double>& r);

}  // namespace springfold::analysis
