// The Lagrangian L = sum U - work - sum F . e of a mechanism, written a second time and in complex
// numbers: homogeneous matrices, energies by walking along the spring, no derivatives. The tests
// differentiate it by the complex step, which needs no subtraction.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <complex>

#include "springfold/model/mechanism.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::statics {

using Complex = std::complex<double>;
using ComplexVector = Eigen::VectorXcd;
using Frame = Eigen::Matrix4cd;
using Rotation = Eigen::Matrix3cd;
using Point = Eigen::Vector3cd;

inline Rotation cross_matrix(const Point& a) {
  Rotation m;
  m << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return m;
}

/// Rotation by |phi|; phi must not be zero.
inline Rotation rotation_by(const Point& phi) {
  const Complex angle = std::sqrt(phi[0] * phi[0] + phi[1] * phi[1] + phi[2] * phi[2]);
  const Point axis = phi / angle;
  return std::cos(angle) * Rotation::Identity() + std::sin(angle) * cross_matrix(axis) +
         (1.0 - std::cos(angle)) * (axis * axis.transpose());
}

/// Angle of (c, s), with its first-order imaginary part.
inline Complex angle_of(Complex c, Complex s) {
  const double rate =
      (c.real() * s.imag() - s.real() * c.imag()) / std::norm(Complex(c.real(), s.real()));
  return {std::atan2(s.real(), c.real()), rate};
}

/// Rotation vector of R by its skew part; the angle must be neither 0 nor pi.
inline Point vector_of(const Rotation& R) {
  const Point twice = {R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1)};
  const Complex sine =
      0.5 * std::sqrt(twice[0] * twice[0] + twice[1] * twice[1] + twice[2] * twice[2]);
  const Complex cosine = 0.5 * (R(0, 0) + R(1, 1) + R(2, 2) - 1.0);
  return (0.5 * angle_of(cosine, sine) / sine) * twice;
}

inline Frame frame_of(const Rotation& R, const Point& p) {
  Frame T = Frame::Identity();
  T.topLeftCorner<3, 3>() = R;
  T.topRightCorner<3, 1>() = p;
  return T;
}

inline Frame frame_of(const model::Pose<double>& T) {
  return frame_of(T.R.cast<Complex>(), T.p.cast<Complex>());
}

inline Frame frame_of_body(model::TaskSpace space, const ComplexVector& t) {
  const bool in_space = space == model::TaskSpace::xyz || space == model::TaskSpace::spatial;
  const Point p(t[0], t[1], in_space ? t[2] : 0.0);
  if (space == model::TaskSpace::planar) return frame_of(rotation_by({0, 0, t[2]}), p);
  if (space == model::TaskSpace::spatial) return frame_of(rotation_by(t.tail(3)), p);
  return frame_of(Rotation::Identity(), p);
}

inline Frame frame_of_joint(const model::Joint& joint, Complex c) {
  const Point axis = joint.axis.cast<Complex>();
  if (joint.kind == model::JointKind::prismatic) return frame_of(Rotation::Identity(), c * axis);
  return c == 0.0 ? Frame(Frame::Identity()) : frame_of(rotation_by(c * axis), Point::Zero());
}

/// Energy of a spring: its torque added up from the free coordinate, segment by segment. That of curves is
/// checked in tests/model.
inline Complex energy_of(const model::SpringLaw& law, Complex c) {
  if (const auto* s = std::get_if<model::LinearSpring>(&law))
    return 0.5 * s->stiffness * (c - s->free) * (c - s->free);
  if (const auto* s = std::get_if<model::OneSidedSpring>(&law)) {
    const bool above = s->side == model::OneSidedSpring::Side::above;
    const bool active = above ? c.real() >= s->from : c.real() < s->from;
    return active ? 0.5 * s->stiffness * (c - s->from) * (c - s->from) : 0.0;
  }
  if (!std::holds_alternative<model::PiecewiseLinearSpring>(law)) {
    const model::CompiledSpring spring = model::compile(law);
    return spring.energy(spring.segment_at(c.real()), c);
  }
  const auto& s = std::get<model::PiecewiseLinearSpring>(law);
  const bool up = c.real() >= s.free;
  double at = s.free, torque = s.preload;
  Complex energy = 0;
  for (;;) {
    const auto next = up ? std::upper_bound(s.breakpoints.begin(), s.breakpoints.end(), at)
                         : std::lower_bound(s.breakpoints.begin(), s.breakpoints.end(), at);
    const double k = s.stiffnesses[static_cast<std::size_t>(next - s.breakpoints.begin())];
    const bool last = up ? next == s.breakpoints.end() || *next > c.real()
                         : next == s.breakpoints.begin() || *(next - 1) < c.real();
    const Complex d = last ? c - at : Complex((up ? *next : *(next - 1)) - at);
    energy += torque * d + 0.5 * k * d * d;
    if (last) return energy;
    torque += k * d.real();
    at += d.real();
  }
}

/// L(z, rho, W). Moments on spatial bodies have no potential: those of W must be zero.
inline Complex lagrangian(const model::Mechanism& m, const ComplexVector& z, const Vector& rho,
                          const Vector& W) {
  Index poses = z.size(), row = 0, command = 0, load = 0;
  for (const model::Body& body : m.bodies) poses -= dimension(body.task_space);
  std::vector<Frame> frames{Frame::Identity()};
  Complex L = 0;
  for (const model::Body& body : m.bodies) {
    const Index d = dimension(body.task_space);
    const ComplexVector t = z.segment(poses, d);
    frames.push_back(frame_of_body(body.task_space, t));
    for (Index i = 0; i < d; ++i) L -= W[load + i] * t[i];
    poses += d;
    load += d;
  }
  for (const model::Chain& chain : m.chains) {
    std::vector<Index> rows;  // per element: its coordinate in z
    Frame end = frames[static_cast<std::size_t>(chain.from)] * frame_of(chain.from_attachment);
    for (const model::Element& element : chain.elements) {
      rows.push_back(row);
      if (const auto* link = std::get_if<model::RigidLink>(&element)) {
        end = (end * frame_of(link->transform)).eval();
        continue;
      }
      const auto& joint = std::get<model::Joint>(element);
      Complex c = joint.role == model::JointRole::actuated ? rho[command++] : 0.0;
      if (has_coordinate(joint)) {
        if (joint.spring) L += energy_of(*joint.spring, z[row]);
        c += z[row++];
      }
      end = (end * frame_of_joint(joint, c)).eval();
    }
    for (const model::CoupledSpring& spring : chain.coupled_springs)
      for (std::size_t i = 0; i < spring.elements.size(); ++i)
        for (std::size_t j = 0; j < spring.elements.size(); ++j) {
          const auto a = static_cast<Index>(i), b = static_cast<Index>(j);
          L += 0.5 * spring.stiffness(a, b) * (z[rows[spring.elements[i]]] - spring.free[a]) *
               (z[rows[spring.elements[j]]] - spring.free[b]);
        }
    const Frame body = frames[static_cast<std::size_t>(chain.to)] * frame_of(chain.to_attachment);
    const Rotation E = end.topLeftCorner<3, 3>() * body.topLeftCorner<3, 3>().transpose();
    const Point gap = end.topRightCorner<3, 1>() - body.topRightCorner<3, 1>();
    const model::TaskSpace space = task_space_of(m, chain);
    for (Index i = 0; i < translations(space); ++i) L -= z[row++] * gap[i];
    if (space == model::TaskSpace::planar) L -= z[row++] * angle_of(E(0, 0), E(1, 0));
    if (space != model::TaskSpace::spatial) continue;
    const Point phi = vector_of(E);
    for (Index i = 0; i < 3; ++i) L -= z[row++] * phi[i];
  }
  return L;
}

inline Vector gradient_of_lagrangian(const model::Mechanism& m, const Vector& z, const Vector& rho,
                                     const Vector& W) {
  Vector gradient(z.size());
  for (Index i = 0; i < z.size(); ++i) {
    ComplexVector moved = z.cast<Complex>();
    moved[i] += Complex(0, 1e-30);
    gradient[i] = lagrangian(m, moved, rho, W).imag() / 1e-30;
  }
  return gradient;
}

}  // namespace springfold::statics
