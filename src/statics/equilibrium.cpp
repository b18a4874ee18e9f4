#include <cassert>

#include "gauge.hpp"
#include "places.hpp"
#include "point_terms.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::statics {
namespace {

using model::TaskSpace;

void gather(const System& system, std::size_t i, const Vector& z, const Vector& rho,
            Workspace& work) {
  const ChainSlice& slice = system.chain_slices[i];
  const model::CompiledChain& chain = system.chains[i];
  Vector& v = work.variables[i];
  v.resize(chain.variable_count());
  Index k = 0;
  for (; k < chain.first_joint(); ++k) v[k] = z[slice.from + k];
  for (std::size_t j = 0; j < chain.joints.size(); ++j, ++k) {
    const Index x = slice.joint_coordinate[j], command = slice.joint_command[j];
    v[k] = (x >= 0 ? z[x] : 0.0) + (command >= 0 ? rho[command] : 0.0);
  }
  for (Index t = slice.to; k < v.size(); ++k, ++t) v[k] = z[t];
  work.wrenches[i] = z.segment(slice.F, slice.F_count);
}

void reserve(const System& system, Workspace& work) {
  work.closures.resize(system.chains.size());
  work.variables.resize(system.chains.size());
  work.wrenches.resize(system.chains.size());
}

/// Generalised force of the body's external wrench: its rotational part does work on
/// omega = J_l dphi, so J_l^T m stands there for spatial bodies.
void add_loads(const System& system, const Vector& z, const Vector& W, Vector& residual,
               Matrix* A) {
  for (std::size_t b = 0; b < system.body_slices.size(); ++b) {
    const BodySlice& body = system.body_slices[b];
    const auto load = W.segment(body.W, body.count);
    if (system.mechanism.bodies[b].task_space != TaskSpace::spatial) {
      residual.segment(body.t, body.count) -= load;
      continue;
    }
    const model::Vec3<double> phi = z.segment(body.t + 3, 3), moment = load.tail(3);
    residual.segment(body.t, 3) -= load.head(3);
    residual.segment(body.t + 3, 3) -= model::left_jacobian(phi).transpose() * moment;
    if (A == nullptr || moment.isZero(0)) continue;
    const auto dJ = model::left_jacobian_derivatives(phi);
    for (Index k = 0; k < 3; ++k)
      A->block(body.t + 3, body.t + 3 + k, 3, 1) -=
          dJ[static_cast<std::size_t>(k)].transpose() * moment;
  }
}

void add_springs(const System& system, const Piece& piece, const Vector& z, Vector& residual,
                 Matrix* A) {
  for (const CoordinateSpring& spring : system.springs) {
    const std::size_t segment = segment_of(spring, piece);
    residual[spring.coordinate] += spring.law.torque(segment, z[spring.coordinate]);
    if (A != nullptr)
      (*A)(spring.coordinate, spring.coordinate) += spring.law.segments[segment].stiffness;
  }
  for (const CoordinateGroup& group : system.coupled) {
    const auto& at = group.coordinates;
    residual(at) += group.stiffness * (z(at) - group.free);
    if (A != nullptr) (*A)(at, at) += group.stiffness;
  }
}

void scatter_residual(const System& system, std::size_t i, Workspace& work, Vector& residual) {
  const ChainSlice& slice = system.chain_slices[i];
  const auto& at = work.closures[i];
  const Vector& F = work.wrenches[i];
  for (Index r = 0; r < slice.F_count; ++r) residual[slice.F + r] -= at.e[r];
  for (Index k = 0; k < at.J.cols(); ++k) {
    const Index row = place_of(slice, system.chains[i], k).z;
    if (row < 0) continue;
    double force = 0;
    for (Index r = 0; r < slice.F_count; ++r) force += at.J(r, k) * F[r];
    residual[row] -= force;
  }
}

void scatter_matrix(const System& system, std::size_t i, Workspace& work, Matrix& A,
                    Matrix* dR_drho) {
  const ChainSlice& slice = system.chain_slices[i];
  const auto& at = work.closures[i];
  for (Index k = 0; k < at.J.cols(); ++k) {
    const Place column = place_of(slice, system.chains[i], k);
    for (Index j = 0; j < at.J.cols(); ++j) {
      const Index row = place_of(slice, system.chains[i], j).z;
      if (row < 0) continue;
      if (column.z >= 0) A(row, column.z) -= at.H(j, k);
      if (dR_drho != nullptr && column.rho >= 0) (*dR_drho)(row, column.rho) -= at.H(j, k);
    }
    for (Index r = 0; column.z >= 0 && r < slice.F_count; ++r) {
      A(slice.F + r, column.z) -= at.J(r, k);
      A(column.z, slice.F + r) -= at.J(r, k);
    }
    if (dR_drho != nullptr && column.rho >= 0)
      dR_drho->block(slice.F, column.rho, slice.F_count, 1) -= at.J.col(k);
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
  add_gauge(system, z, work, residual, nullptr, nullptr);
  return residual.allFinite();
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
  add_gauge(system, z, work, residual, &A, dR_drho);
  return residual.allFinite() && A.allFinite();
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
    columns.block(body.t + 3, body.W + 3, 3, 3) = -model::left_jacobian(phi).transpose();
  }
  return columns;
}

}  // namespace springfold::statics
