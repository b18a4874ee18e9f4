#include "gauge.hpp"

#include "places.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/row_qr.hpp"

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

/// The left null space of the closures' derivatives, and the shortest motion that gives what of F it leaves.
struct Relations {
  Matrix N{};
  Vector undetermined{}, w{};
};

/// @pre r rows depend on the others. Where more of them do, which happens at single states, the r weakest relations are
///      taken.
Relations relations_of(const Matrix& J, Index r, const Vector& F) {
  Relations result;
  const RowQr rows(J, r);
  if (rows.independent()) {
    result.N = rows.relations();
    result.undetermined = result.N.transpose() * F;
    result.w = rows.least_norm(F - result.N * result.undetermined);
    return result;
  }
  const SymmetricEigen eigen = symmetric_eigen(J * J.transpose());
  const Matrix kept = eigen.vectors.rightCols(F.size() - r);
  const Vector inverse = eigen.values.tail(F.size() - r).cwiseInverse();
  result.N = eigen.vectors.leftCols(r);
  result.undetermined = result.N.transpose() * F;
  result.w = J.transpose() * (kept * inverse.cwiseProduct(kept.transpose() * F));
  return result;
}

/// Adds -w^T H of one chain to column k of g and g_rho.
/// @param at  the chain's closure with its part of N_k as wrench
void add_turning(const ChainSlice& slice, const model::Closure<double>& at, const Vector& w,
                 Index k, Matrix& g, Matrix& g_rho) {
  for (Index v = 0; v < at.H.rows(); ++v) {
    const Place place = place_of(slice, v);
    if (place.z < 0 && place.rho < 0) continue;
    double turning = 0;
    for (Index u = 0; u < at.H.cols(); ++u)
      if (const Index z = place_of(slice, u).z; z >= 0) turning += at.H(v, u) * w[z];
    if (place.z >= 0) g(place.z, k) -= turning;
    if (place.rho >= 0) g_rho(place.rho, k) -= turning;
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
  Vector F(J.rows());
  std::vector<Index> rows;
  for (Index i = 0; i < system.size; ++i)
    if (system.is_wrench[static_cast<std::size_t>(i)]) {
      F[static_cast<Index>(rows.size())] = z[i];
      rows.push_back(i);
    }
  Relations relations = relations_of(J, r, F);

  model::Closure<double> at;
  Vector wrench;
  // Columns here: g^T.
  Matrix g = Matrix::Zero(system.size, r), g_rho = Matrix::Zero(system.commands.size(), r);
  for (Index k = 0; k < r; ++k) {
    const auto N = relations.N.col(k);
    for (std::size_t j = 0; j < rows.size(); ++j) g(rows[j], k) = N[static_cast<Index>(j)];
    Index row = 0;
    for (std::size_t i = 0; i < system.chains.size(); ++i) {
      const Index d = system.chain_slices[i].F_count;
      wrench = N.segment(row, d);
      model::evaluate_closure<double>(system.chains[i], work.variables[i], &wrench, at);
      add_turning(system.chain_slices[i], at, relations.w, k, g, g_rho);
      row += d;
    }
    residual -= relations.undetermined[k] * g.col(k);
    if (A != nullptr) A->noalias() -= g.col(k) * g.col(k).transpose();
    if (dR_drho != nullptr) dR_drho->noalias() -= g.col(k) * g_rho.col(k).transpose();
  }
  work.undetermined = std::move(relations.undetermined);
  work.gauge = g.transpose();
}

}  // namespace springfold::statics
