// Closure of one chain: how far its end is from the body that it belongs to, with exact first and
// wrench-contracted second derivatives (paper eq. (5), (9)). Templated on the scalar.
#pragma once

#include <cassert>

#include "springfold/model/compiled_chain.hpp"
#include "springfold/model/flat_closure.hpp"

namespace springfold::model {

namespace detail {

/// Second-order rotation of one rotation vector: sym(dJ_l[:, k]/dphi_j).
template <class S>
Vec3<S> second_rotation(const std::array<Mat3<S>, 3>& dJ, int j, int k) {
  return S(0.5) * (dJ[static_cast<std::size_t>(j)].col(k) + dJ[static_cast<std::size_t>(k)].col(j));
}

/// Pose of a body and the motions of its pose coordinates, at the body's origin.
template <class S>
struct BodyFrame {
  Pose<S> pose{};
  Mat3<S> J_l = Mat3<S>::Identity();  ///< spatial bodies
  std::array<Mat3<S>, 3> dJ_l{};
};

template <class S, class V>
BodyFrame<S> body_frame(TaskSpace space, const V& t, bool with_second) {
  BodyFrame<S> body;
  body.pose.p =
      Vec3<S>(t[0], t[1], space == TaskSpace::xyz || space == TaskSpace::spatial ? S(t[2]) : S(0));
  if (space == TaskSpace::planar) body.pose.R = rotation_about<S>(Vec3<double>::UnitZ(), S(t[2]));
  if (space == TaskSpace::spatial) {
    const Vec3<S> phi(t[3], t[4], t[5]);
    body.pose.R = exp_rotation(phi);
    body.J_l = left_jacobian(phi);
    if (with_second) body.dJ_l = left_jacobian_derivatives(phi);
  }
  return body;
}

/// Rotation axis of pose coordinate i in the world; zero for a translation.
template <class S>
Vec3<S> pose_spin(TaskSpace space, const BodyFrame<S>& body, Index i) {
  if (space == TaskSpace::planar && i == 2) return Vec3<S>::UnitZ();
  if (space == TaskSpace::spatial && i >= 3) return body.J_l.col(i - 3);
  return Vec3<S>::Zero();
}

}  // namespace detail

/// Evaluates closure, Jacobian and, if `F` is given, the Hessian contracted with F.
///
/// With motions ordered from the base outwards (front body, joints), for variables j before k
///
///     d2 p_end / dj dk = spin_j x dp_k
///     Exp(eps), eps_jk = (spin_j x spin_k) / 2     second-order rotation (Baker-Campbell-Hausdorff)
///
/// and the end body's rotations enter the relative rotation E = R_end R_att^T as -E omega_b, behind.
///
/// @param v  variable_count() numbers, see CompiledChain
/// @param F  d numbers (world axes) or nullptr; out.H is left alone then
template <class S>
void evaluate_closure(const CompiledChain& chain, const VectorOf<S>& v, const VectorOf<S>* F,
                      Closure<S>& out) {
  const TaskSpace space = chain.space;
  const Index d = chain.dimension(), n = chain.variable_count(), nj = chain.joint_count();
  const Index from_count = chain.first_joint(), to_count = chain.to_count();
  assert(v.size() == n && (F == nullptr || F->size() == d));
  if (chain.flat) return detail::evaluate_flat_closure(chain, v, F, out);
  const Index lengths = translations(space);
  const Index from_lengths = translations(chain.from_space);
  const Index to_lengths = translations(chain.to_space);
  auto& motions = out.motions;
  motions.assign(static_cast<std::size_t>(n), {});

  // Forward: frames of all joints.
  Pose<S> frame;
  detail::BodyFrame<S> front, end;
  if (chain.from_moves) {
    front = detail::body_frame<S>(chain.from_space, v, F != nullptr);
    frame = front.pose;
    for (Index i = 0; i < from_count; ++i) {
      auto& m = motions[static_cast<std::size_t>(i)];
      if (i < from_lengths)
        m.dp = Vec3<S>::Unit(i);
      else
        m.spin = detail::pose_spin(chain.from_space, front, i);
      m.origin = front.pose.p;
      m.group = -1;
    }
  }
  for (Index j = 0; j < nj; ++j) {
    const auto& step = chain.joints[static_cast<std::size_t>(j)];
    const Index i = chain.first_joint() + j;
    frame = frame * step.before.cast<S>();
    const Vec3<S> axis = frame.R * step.axis.cast<S>();
    auto& m = motions[static_cast<std::size_t>(i)];
    m.group = static_cast<int>(j) + 1;
    if (step.revolute) {
      m.spin = axis;
      m.origin = frame.p;
      frame.R = frame.R * rotation_about<S>(step.axis, S(v[i]));
    } else {
      m.dp = axis;
      frame.p += v[i] * axis;
    }
  }
  frame = frame * chain.last.cast<S>();
  Pose<S> attachment = chain.to_attachment.cast<S>();
  if (chain.to_moves) {
    end = detail::body_frame<S>(chain.to_space, v.tail(to_count), F != nullptr);
    attachment = end.pose * attachment;
  }

  // Closure.
  out.e.resize(d);
  const Vec3<S> gap = frame.p - attachment.p;
  const Mat3<S> E = frame.R * attachment.R.transpose();
  Vec3<S> phi = Vec3<S>::Zero();
  for (Index i = 0; i < lengths; ++i) out.e[i] = gap[i];
  if (space == TaskSpace::planar) out.e[2] = detail::angle_of<S>(E(0, 0), E(1, 0));
  Mat3<S> log_J = Mat3<S>::Identity();
  if (space == TaskSpace::spatial) {
    phi = log_rotation<S>(E);
    out.e.tail(3) = phi;
    log_J = inverse_left_jacobian(phi);
  }

  // First derivatives.
  for (Index i = 0; i < chain.first_to(); ++i) {
    auto& m = motions[static_cast<std::size_t>(i)];
    m.omega = m.spin;
    const bool turns =
        i < chain.first_joint()
            ? i >= from_lengths
            : chain.joints[static_cast<std::size_t>(i - chain.first_joint())].revolute;
    if (turns) m.dp = cross<S>(m.spin, Vec3<S>(frame.p - m.origin));
  }
  const Vec3<S> arm = chain.to_moves ? Vec3<S>(attachment.p - end.pose.p) : Vec3<S>::Zero();
  for (Index i = 0; i < to_count; ++i) {
    auto& m = motions[static_cast<std::size_t>(chain.first_to() + i)];
    m.of_end_body = true;
    m.group = -2;
    m.spin = detail::pose_spin(chain.to_space, end, i);
    m.dp = i < to_lengths ? Vec3<S>(-Vec3<S>::Unit(i)) : Vec3<S>(-cross<S>(m.spin, arm));
    m.omega = -(E * m.spin);
  }
  out.J.resize(d, n);
  for (Index i = 0; i < n; ++i) {
    const auto& m = motions[static_cast<std::size_t>(i)];
    for (Index r = 0; r < lengths; ++r) out.J(r, i) = m.dp[r];
    if (space == TaskSpace::planar) out.J(2, i) = m.omega[2];
    if (space == TaskSpace::spatial) out.J.col(i).tail(3) = log_J * m.omega;
  }
  if (F == nullptr) return;

  // Second derivatives, contracted with F = (f, m).
  Vec3<S> f = Vec3<S>::Zero(), h = Vec3<S>::Zero();
  for (Index i = 0; i < lengths; ++i) f[i] = (*F)[i];
  Mat3<S> log_S = Mat3<S>::Zero();
  if (space == TaskSpace::spatial) {
    const Vec3<S> moment = F->tail(3);
    h = log_J.transpose() * moment;
    log_S = log_hessian<S>(phi, moment);
  }
  out.H.resize(n, n);
  for (Index j = 0; j < n; ++j) {
    const auto& a = motions[static_cast<std::size_t>(j)];
    for (Index k = j; k < n; ++k) {
      const auto& b = motions[static_cast<std::size_t>(k)];
      const bool one_body = a.group == b.group && a.group < 0;
      S value(0);
      const TaskSpace body_space = a.of_end_body ? chain.to_space : chain.from_space;
      if (one_body && body_space == TaskSpace::spatial) {
        if (j - (a.of_end_body ? chain.first_to() : 0) >= 3) {  // both of one rotation vector
          const auto& body = a.of_end_body ? end : front;
          const Index first = (a.of_end_body ? chain.first_to() : 0) + 3;
          const Vec3<S> second = detail::second_rotation(body.dJ_l, static_cast<int>(j - first),
                                                         static_cast<int>(k - first));
          const Vec3<S> r = a.of_end_body ? arm : Vec3<S>(frame.p - front.pose.p);
          const Vec3<S> ddp =
              cross<S>(second, r) + S(0.5) * (cross<S>(a.spin, cross<S>(b.spin, r)) +
                                              cross<S>(b.spin, cross<S>(a.spin, r)));
          value = a.of_end_body ? -dot<S>(f, ddp) - dot<S>(h, E * second)
                                : dot<S>(f, ddp) + dot<S>(h, second);
        }
      } else if (!a.of_end_body && !b.of_end_body) {
        value = dot<S>(f, cross<S>(a.spin, b.dp)) + S(0.5) * dot<S>(h, cross<S>(a.spin, b.spin));
      } else if (one_body) {  // planar end body: its rotation twice
        value = dot<S>(f, cross<S>(a.spin, b.dp));
      } else {  // a of the chain, b of the end body
        value = S(0.5) * dot<S>(h, cross<S>(a.omega, b.omega));
      }
      if (space == TaskSpace::spatial) value += dot<S>(a.omega, log_S * b.omega);
      out.H(j, k) = value;
      out.H(k, j) = value;
    }
  }
}

}  // namespace springfold::model
