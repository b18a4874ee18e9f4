// Closure of a chain that moves in the xy plane: angles and vectors of two numbers are enough.
// Included by closure.hpp.
#pragma once

#include <cmath>

#include "springfold/model/compiled_chain.hpp"

namespace springfold::model::detail {

/// Angle in (-pi, pi] from its cosine and sine.
template <class S>
S angle_of(const S& cosine, const S& sine) {
  if constexpr (std::is_floating_point_v<S>) {
    return std::atan2(sine, cosine);
  } else {
    // atan2 for complex step: turn by the real angle first, then the rest is small.
    const double a = std::atan2(std::real(sine), std::real(cosine));
    const double c = std::cos(a), s = std::sin(a);
    return S(a) + atan((sine * c - cosine * s) / (cosine * c + sine * s));
  }
}

/// A frame in the plane: cosine and sine of its angle, its origin.
template <class S>
struct FlatFrame {
  S c = S(1), s = S(0), x = S(0), y = S(0);

  void turn(const S& cosine, const S& sine) {
    const S old = c;
    c = c * cosine - s * sine;
    s = s * cosine + old * sine;
  }
  void move(double dx, double dy) {
    x += c * dx - s * dy;
    y += s * dx + c * dy;
  }
  /// By a rigid transform about z.
  void append(const Pose<double>& T) {
    move(T.p[0], T.p[1]);
    turn(S(T.R(0, 0)), S(T.R(1, 0)));
  }
};

/// Frame of a moving body, xy or planar; t points to its pose.
template <class S>
FlatFrame<S> flat_body(TaskSpace space, const S* t) {
  using std::cos;
  using std::sin;
  if (space == TaskSpace::planar) return {cos(t[2]), sin(t[2]), t[0], t[1]};
  return {S(1), S(0), t[0], t[1]};
}

/// Frames from the base outwards. Column i of J receives a point on the axis of variable i or, where
/// it shifts, its direction; spins tell which: +-1 or 0.
template <class S>
FlatFrame<S> flat_forward(const CompiledChain& chain, const S* v, MatrixOf<S>& J,
                          VectorOf<S>& spins) {
  using std::cos;
  using std::sin;
  FlatFrame<S> frame;
  const auto note = [&](Index i, const S& x, const S& y, double spin) {
    J(0, i) = x;
    J(1, i) = y;
    spins[i] = S(spin);
  };
  if (chain.from_moves) {
    frame = flat_body(chain.from_space, v);
    note(0, S(1), S(0), 0);
    note(1, S(0), S(1), 0);
    if (chain.from_space == TaskSpace::planar) note(2, frame.x, frame.y, 1);
  }
  Index i = chain.first_joint();
  for (const auto& step : chain.joints) {
    frame.append(step.before);
    if (step.revolute) {
      note(i, frame.x, frame.y, step.axis[2]);
      frame.turn(cos(v[i]), step.axis[2] * sin(v[i]));
    } else {
      const S x = frame.c * step.axis[0] - frame.s * step.axis[1];
      const S y = frame.s * step.axis[0] + frame.c * step.axis[1];
      note(i, x, y, 0);
      frame.x += v[i] * x;
      frame.y += v[i] * y;
    }
    ++i;
  }
  frame.append(chain.last);
  return frame;
}

/// Second derivatives contracted with the force f: for variables j before k of the chain
/// spin_j f . (z x dp_k), and the same for the turn of the end body alone.
template <class S>
void flat_hessian(const CompiledChain& chain, const VectorOf<S>& F, Closure<S>& out) {
  const Index n = chain.variable_count(), inner = chain.first_to();
  out.H.resize(n, n);
  if (inner < n) {
    out.H.rightCols(n - inner).setZero();
    out.H.bottomRows(n - inner).setZero();
  }
  const auto lever = [&](Index k) { return F[1] * out.J(0, k) - F[0] * out.J(1, k); };
  for (Index k = 0; k < inner; ++k) {
    const S moment = lever(k);
    for (Index j = 0; j <= k; ++j) {
      const S value = out.spins[j] * moment;
      out.H(j, k) = value;
      out.H(k, j) = value;
    }
  }
  if (chain.to_moves && chain.to_space == TaskSpace::planar) out.H(n - 1, n - 1) = lever(n - 1);
}

/// The same numbers as the general way of evaluate_closure(), within rounding.
/// @pre chain.flat
template <class S>
void evaluate_flat_closure(const CompiledChain& chain, const VectorOf<S>& v, const VectorOf<S>* F,
                           Closure<S>& out) {
  const Index d = chain.dimension(), n = chain.variable_count(), inner = chain.first_to();
  const bool closes_angle = chain.space == TaskSpace::planar;
  out.e.resize(d);
  out.J.resize(d, n);
  out.spins.resize(n);
  const FlatFrame<S> end = flat_forward(chain, v.data(), out.J, out.spins);
  FlatFrame<S> body;
  if (chain.to_moves) body = flat_body(chain.to_space, v.data() + inner);
  FlatFrame<S> attachment = body;
  attachment.append(chain.to_attachment);

  out.e[0] = end.x - attachment.x;
  out.e[1] = end.y - attachment.y;
  if (closes_angle)
    out.e[2] = angle_of<S>(end.c * attachment.c + end.s * attachment.s,
                           end.s * attachment.c - end.c * attachment.s);
  for (Index i = 0; i < inner; ++i) {
    if (closes_angle) out.J(2, i) = out.spins[i];
    if (out.spins[i] == S(0)) continue;
    const S x = out.J(0, i), y = out.J(1, i);
    out.J(0, i) = -out.spins[i] * (end.y - y);
    out.J(1, i) = out.spins[i] * (end.x - x);
  }
  if (chain.to_moves) {
    out.J.rightCols(n - inner).setZero();
    out.J(0, inner) = S(-1);
    out.J(1, inner + 1) = S(-1);
    if (chain.to_space == TaskSpace::planar) {
      out.J(0, inner + 2) = attachment.y - body.y;
      out.J(1, inner + 2) = body.x - attachment.x;
      if (closes_angle) out.J(2, inner + 2) = S(-1);
    }
  }
  if (F != nullptr) flat_hessian(chain, *F, out);
}

}  // namespace springfold::model::detail
