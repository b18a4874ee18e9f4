// Motion of a point of the mechanism, with exact first and second derivatives: what loads, weights
// and line springs need. Templated on the scalar.
#pragma once

#include <algorithm>

#include "springfold/model/closure.hpp"

namespace springfold::model {

/// A point as the kinematics wants it: a body or the base, the joints between it and the point.
struct CompiledPoint {
  TaskSpace space = TaskSpace::spatial;  ///< of the body where the way to the point begins
  bool body_moves = false;               ///< that body is not the base
  std::vector<CompiledChain::JointStep> joints{};
  Pose<double> last{};  ///< rigid transform behind the last joint

  /// Variables in this order: (pose of the body if it moves, joint displacements).
  Index first_joint() const { return body_moves ? dimension(space) : 0; }
  Index variable_count() const { return first_joint() + static_cast<Index>(joints.size()); }
};

/// @pre problems_in(mechanism).empty()
CompiledPoint compile(const Mechanism& mechanism, const Anchor& anchor);

/// Pose of the point's frame and its motions by n variables v.
template <class S>
struct PointMotion {
  Pose<S> pose{};
  Eigen::Matrix<S, 3, Eigen::Dynamic> dp{};    ///< 3 x n, dp/dv [world axes]
  Eigen::Matrix<S, 3, Eigen::Dynamic> spin{};  ///< 3 x n, angular velocity = spin dv/dt
  detail::BodyFrame<S> body{};
  Index rotation = 0;   ///< first variable of the body's rotation vector
  bool vector = false;  ///< the body has a rotation vector: variables rotation .. rotation + 2
  Eigen::Matrix<S, 3, Eigen::Dynamic> origins{};  ///< scratch: a point on each axis of rotation
};

template <class S>
void evaluate_point(const CompiledPoint& point, const VectorOf<S>& v, PointMotion<S>& out) {
  const Index n = point.variable_count(), d = point.first_joint();
  const Index lengths = translations(point.space);
  assert(v.size() == n);
  out.dp.setZero(3, n);
  out.spin.setZero(3, n);
  out.rotation = lengths;
  out.vector = point.body_moves && point.space == TaskSpace::spatial;
  auto& origins = out.origins;
  origins.resize(3, n);
  Pose<S> frame;
  if (point.body_moves) {
    out.body = detail::body_frame<S>(point.space, v, true);
    frame = out.body.pose;
    for (Index i = 0; i < d; ++i) {
      if (i < lengths) out.dp(i, i) = S(1);
      out.spin.col(i) = detail::pose_spin(point.space, out.body, i);
      origins.col(i) = frame.p;
    }
  }
  for (std::size_t j = 0; j < point.joints.size(); ++j) {
    const auto& step = point.joints[j];
    const Index i = d + static_cast<Index>(j);
    frame = frame * step.before.template cast<S>();
    const Vec3<S> axis = frame.R * step.axis.template cast<S>();
    origins.col(i) = frame.p;
    if (step.revolute) {
      out.spin.col(i) = axis;
      frame.R = frame.R * rotation_about<S>(step.axis, S(v[i]));
    } else {
      out.dp.col(i) = axis;
      frame.p += v[i] * axis;
    }
  }
  out.pose = frame * point.last.template cast<S>();
  for (Index i = 0; i < n; ++i)
    out.dp.col(i) +=
        cross<S>(Vec3<S>(out.spin.col(i)), Vec3<S>(out.pose.p - Vec3<S>(origins.col(i))));
}

/// d2p/dv_j dv_k: the earlier variable moves what the later one does,
///
///     d2p/dv_j dv_k = spin_j x dp_k,   j <= k,
///
/// and within a rotation vector the axes change too: (d spin_j/dv_k) x r + spin_j x (spin_k x r).
template <class S>
Vec3<S> second_displacement(const PointMotion<S>& at, Index j, Index k) {
  const Index first = std::min(j, k), second = std::max(j, k);
  const Vec3<S> turned = cross<S>(Vec3<S>(at.spin.col(first)), Vec3<S>(at.dp.col(second)));
  const Index r = at.rotation;
  if (!at.vector || first < r || second >= r + 3) return turned;
  const Vec3<S> change = at.body.dJ_l[static_cast<std::size_t>(second - r)].col(first - r);
  return turned + cross<S>(change, Vec3<S>(at.pose.p - at.body.pose.p));
}

/// d(spin_j)/dv_k: earlier variables turn the axes of later ones.
template <class S>
Vec3<S> spin_rate(const PointMotion<S>& at, Index j, Index k) {
  const Index r = at.rotation;
  if (at.vector && std::min(j, k) >= r && std::max(j, k) < r + 3)
    return at.body.dJ_l[static_cast<std::size_t>(k - r)].col(j - r);
  if (k >= j) return Vec3<S>::Zero();
  return cross<S>(Vec3<S>(at.spin.col(k)), Vec3<S>(at.spin.col(j)));
}

}  // namespace springfold::model
