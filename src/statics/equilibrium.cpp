#include <cassert>

#include "gauge.hpp"
#include "point_terms.hpp"
#include "shape_terms.hpp"
#include "springfold/core/finite.hpp"
#include "springfold/statics/system.hpp"
#include "turn_moment.hpp"

namespace springfold::statics {
namespace {

using model::TaskSpace;

void gather(const System& system, std::size_t i, const Vector& z, const Vector& rho,
            Workspace& work) {
  const ChainSlice& slice = system.chain_slices[i];
  Vector& v = work.variables[i];
  v.resize(static_cast<Index>(slice.z_of.size()));
  for (std::size_t k = 0; k < slice.z_of.size(); ++k) {
    const Index at = slice.z_of[k], command = slice.rho_of[k];
    v.data()[k] = (at >= 0 ? z[at] : 0.0) + (command >= 0 ? rho[command] : 0.0);
  }
  work.wrenches[i] = z.segment(slice.F, slice.F_count);
}

void reserve(const System& system, Workspace& work) {
  work.closures.resize(system.chains.size());
  work.variables.resize(system.chains.size());
  work.wrenches.resize(system.chains.size());
}

/// A moment in world axes as the body takes it: with its potential where the body can turn about one direction only.
TurnMoment moment_on(const BodySlice& body, const model::Vec3<double>& phi,
                     const model::Vec3<double>& moment) {
  if (body.turn) return turn_moment(*body.turn, turned_at(*body.turn, phi), moment, false);
  return {moment, model::Mat3<double>::Zero()};
}

/// Generalised force of the body's external wrench: its rotational part does work on
/// omega = J_l dphi, so J_l^T m stands there for spatial bodies.
void add_loads(const System& system, const Vector& z, const Vector& W, Vector& residual,
               Matrix* A) {
  for (std::size_t b = 0; b < system.body_slices.size(); ++b) {
    const BodySlice& body = system.body_slices[b];
    const auto load = W.segment(body.W, body.count);
    if (system.mechanism.bodies[b].task_space != TaskSpace::spatial) {
      for (Index k = 0; k < body.count; ++k) residual[body.t + k] -= load[k];
      continue;
    }
    const model::Vec3<double> phi = z.segment(body.t + 3, 3), moment = load.tail(3);
    residual.segment(body.t, 3) -= load.head(3);
    if (moment.isZero(0)) continue;
    const TurnMoment m = moment_on(body, phi, moment);
    const model::Mat3<double> J = model::left_jacobian(phi);
    residual.segment(body.t + 3, 3) -= J.transpose() * m.vector;
    if (A == nullptr) continue;
    const auto dJ = model::left_jacobian_derivatives(phi);
    for (Index k = 0; k < 3; ++k)
      A->block(body.t + 3, body.t + 3 + k, 3, 1) -=
          dJ[static_cast<std::size_t>(k)].transpose() * m.vector +
          J.transpose() * m.rate * J.col(k);
  }
}

void add_springs(const System& system, const Piece& piece, const Vector& z, Vector& residual,
                 Matrix* A) {
  for (const CoordinateSpring& spring : system.springs) {
    const std::size_t segment = segment_of(spring, piece);
    residual[spring.coordinate] += spring.law.torque(segment, z[spring.coordinate]);
    if (A != nullptr)
      (*A)(spring.coordinate, spring.coordinate) +=
          spring.law.stiffness(segment, z[spring.coordinate]);
  }
  for (const CoordinateGroup& group : system.coupled) {
    const auto& at = group.coordinates;
    for (std::size_t j = 0; j < at.size(); ++j) {
      const auto column = static_cast<Index>(j);
      const double stretch = z[at[j]] - group.free[column];
      for (std::size_t i = 0; i < at.size(); ++i) {
        const double stiffness = group.stiffness(static_cast<Index>(i), column);
        residual[at[i]] += stiffness * stretch;
        if (A != nullptr) (*A)(at[i], at[j]) += stiffness;
      }
    }
  }
}

void scatter_residual(const System& system, std::size_t i, Workspace& work, Vector& residual) {
  const ChainSlice& slice = system.chain_slices[i];
  const auto& at = work.closures[i];
  const Index d = slice.F_count;
  const double *J = at.J.data(), *F = work.wrenches[i].data(), *e = at.e.data();
  double* const row_F = residual.data() + slice.F;
  for (Index r = 0; r < d; ++r) row_F[r] -= e[r];
  for (const Index row : slice.z_of) {
    double force = 0;
    for (Index r = 0; r < d; ++r) force += J[r] * F[r];
    if (row >= 0) residual[row] -= force;
    J += d;
  }
}

void scatter_matrix(const System& system, std::size_t i, Workspace& work, Matrix& A,
                    Matrix* dR_drho) {
  const ChainSlice& slice = system.chain_slices[i];
  const auto& at = work.closures[i];
  const Index d = slice.F_count;
  const std::size_t n = slice.z_of.size();
  const double *J = at.J.data(), *H = at.H.data();
  for (std::size_t k = 0; k < n; ++k, J += d, H += n) {
    const Index z = slice.z_of[k], command = slice.rho_of[k];
    if (z >= 0) {
      double* const column = A.col(z).data();
      for (std::size_t j = 0; j < n; ++j)
        if (slice.z_of[j] >= 0) column[slice.z_of[j]] -= H[j];
      for (Index r = 0; r < d; ++r) {
        column[slice.F + r] -= J[r];
        A(z, slice.F + r) -= J[r];
      }
    }
    if (dR_drho == nullptr || command < 0) continue;
    for (std::size_t j = 0; j < n; ++j)
      if (slice.z_of[j] >= 0) (*dR_drho)(slice.z_of[j], command) -= H[j];
    for (Index r = 0; r < d; ++r) (*dR_drho)(slice.F + r, command) -= J[r];
  }
}

}  // namespace

bool equilibrium_residual(const System& system, const Piece& piece, const Vector& z,
                          const Inputs& inputs, Workspace& work, Vector& residual) {
  assert(z.size() == system.size && inputs.W.size() == system.load_size);
  assert(piece.size() == system.switches.size());
  reserve(system, work);
  residual.setZero(system.size);
  add_springs(system, piece, z, residual, nullptr);
  for (std::size_t i = 0; i < system.chains.size(); ++i) {
    gather(system, i, z, inputs.rho, work);
    model::evaluate_closure<double>(system.chains[i], work.variables[i], nullptr, work.closures[i]);
    scatter_residual(system, i, work, residual);
  }
  add_loads(system, z, inputs.W, residual, nullptr);
  add_point_terms(system, z, inputs, work, residual, nullptr, nullptr);
  add_shape_terms(system, piece, z, inputs, work, residual, nullptr, nullptr);
  add_gauge(system, z, work, residual, nullptr, nullptr);
  return all_finite(residual);
}

bool equilibrium_matrix(const System& system, const Piece& piece, const Vector& z,
                        const Inputs& inputs, Workspace& work, Vector& residual, Matrix& A,
                        Matrix* dR_drho) {
  assert(z.size() == system.size && inputs.W.size() == system.load_size);
  assert(piece.size() == system.switches.size());
  reserve(system, work);
  residual.setZero(system.size);
  A.setZero(system.size, system.size);
  if (dR_drho != nullptr) dR_drho->setZero(system.size, inputs.rho.size());
  add_springs(system, piece, z, residual, &A);
  for (std::size_t i = 0; i < system.chains.size(); ++i) {
    gather(system, i, z, inputs.rho, work);
    model::evaluate_closure<double>(system.chains[i], work.variables[i], &work.wrenches[i],
                                    work.closures[i]);
    scatter_residual(system, i, work, residual);
    scatter_matrix(system, i, work, A, dR_drho);
  }
  add_loads(system, z, inputs.W, residual, &A);
  add_point_terms(system, z, inputs, work, residual, &A, dR_drho);
  add_shape_terms(system, piece, z, inputs, work, residual, &A, dR_drho);
  add_gauge(system, z, work, residual, &A, dR_drho);
  return all_finite(residual) && all_finite(A);
}

void add_wrench_rate(const System& system, const Vector& z, const Vector& W_rate, Vector& rate) {
  add_loads(system, z, W_rate, rate, nullptr);
}

Matrix load_columns(const System& system, const Vector& z) {
  Matrix columns = Matrix::Zero(system.size, system.load_size);
  for (std::size_t b = 0; b < system.body_slices.size(); ++b) {
    const BodySlice& body = system.body_slices[b];
    columns.block(body.t, body.W, body.count, body.count) -=
        Matrix::Identity(body.count, body.count);
    if (system.mechanism.bodies[b].task_space != TaskSpace::spatial) continue;
    const model::Vec3<double> phi = z.segment(body.t + 3, 3);
    for (Index k = 0; k < 3; ++k)
      columns.block(body.t + 3, body.W + 3 + k, 3, 1) =
          -model::left_jacobian(phi).transpose() *
          moment_on(body, phi, model::Vec3<double>::Unit(k)).vector;
  }
  return columns;
}

}  // namespace springfold::statics
