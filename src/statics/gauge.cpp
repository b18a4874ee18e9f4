#include "gauge.hpp"

#include "places.hpp"
#include "springfold/core/decompositions.hpp"

namespace springfold::statics {
namespace {

/// Closure derivatives of all chains by the unknowns z: a row per wrench component, in order.
Matrix closure_matrix(const System& system, const Workspace& work) {
  Matrix J = Matrix::Zero(system.closure_count(), system.size);
  Index row = 0;
  for (std::size_t i = 0; i < system.chains.size(); ++i) {
    const auto& at = work.closures[i];
    for (Index k = 0; k < at.J.cols(); ++k) {
      const Index column = place_of(system.chain_slices[i], k).z;
      if (column >= 0) J.block(row, column, at.J.rows(), 1) += at.J.col(k);
    }
    row += at.J.rows();
  }
  return J;
}

/// Adds -w^T H(N_k) of one chain to row k of g and g_rho.
void add_turning(const System& system, std::size_t i, const Vector& variables, const Vector& N,
                 const Vector& w, Index k, Matrix& g, Matrix& g_rho) {
  const ChainSlice& slice = system.chain_slices[i];
  const model::CompiledChain& chain = system.chains[i];
  model::Closure<double> at;
  model::evaluate_closure<double>(chain, variables, &N, at);
  Vector motion = Vector::Zero(at.H.cols());
  for (Index v = 0; v < motion.size(); ++v)
    if (const Index z = place_of(slice, v).z; z >= 0) motion[v] = w[z];
  const Vector turning = at.H * motion;
  for (Index v = 0; v < turning.size(); ++v) {
    const Place place = place_of(slice, v);
    if (place.z >= 0) g(k, place.z) -= turning[v];
    if (place.rho >= 0) g_rho(k, place.rho) -= turning[v];
  }
}

}  // namespace

void add_gauge(const System& system, const Vector& z, Workspace& work, Vector& residual, Matrix* A,
               Matrix* dR_drho) {
  const Index r = system.redundant;
  work.gauge.resize(0, 0);
  work.undetermined.resize(0);
  if (r == 0) return;
  const Matrix J = closure_matrix(system, work);
  if (!J.allFinite()) return;
  std::vector<Index> rows;
  for (Index i = 0; i < system.size; ++i)
    if (system.is_wrench[static_cast<std::size_t>(i)]) rows.push_back(i);
  const Vector F = z(rows);
  const SymmetricEigen eigen = symmetric_eigen(J * J.transpose());
  const Matrix N = eigen.vectors.leftCols(r);
  const Matrix kept = eigen.vectors.rightCols(F.size() - r);
  const Vector inverse = eigen.values.tail(F.size() - r).cwiseInverse();
  const Vector w = J.transpose() * (kept * inverse.cwiseProduct(kept.transpose() * F));

  Matrix g = Matrix::Zero(r, system.size), g_rho = Matrix::Zero(r, system.commands.size());
  for (Index k = 0; k < r; ++k) {
    g(k, rows) = N.col(k).transpose();
    Index row = 0;
    for (std::size_t i = 0; i < system.chains.size(); ++i) {
      const Index d = system.chain_slices[i].F_count;
      add_turning(system, i, work.variables[i], N.col(k).segment(row, d), w, k, g, g_rho);
      row += d;
    }
  }
  work.undetermined = N.transpose() * F;
  residual -= g.transpose() * work.undetermined;
  if (A != nullptr) *A -= g.transpose() * g;
  if (dR_drho != nullptr) *dR_drho -= g.transpose() * g_rho;
  work.gauge = std::move(g);
}

}  // namespace springfold::statics
