#include "springfold/statics/stage_stiffness.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "springfold/core/decompositions.hpp"
#include "springfold/core/inertia.hpp"
#include "springfold/statics/couplings.hpp"
#include "springfold/statics/sparse_stiffness.hpp"
#include "statics/symmetric_part.hpp"

namespace springfold::statics {
namespace {

/// Eigenvalues below this share of the largest entry are rounding.
constexpr double eigenvalue_rounding = 1e-13;

/// Schur complement for one body.
Matrix of_body(const System& system, const Matrix& K, Index body) {
  const BodySlice& b = system.body_slices[static_cast<std::size_t>(body - 1)];
  if (b.count == K.rows()) return K;
  std::vector<Index> own(static_cast<std::size_t>(b.count)), other;
  std::iota(own.begin(), own.end(), b.W);
  for (Index i = 0; i < K.rows(); ++i)
    if (i < b.W || i >= b.W + b.count) other.push_back(i);
  const auto X = solve_symmetric(K(other, other), K(other, own));
  if (!X) return {};
  return symmetric_part(K(own, own) - K(own, other) * *X);
}

/// Pose block of A^-1, where chains are rigid or buckle with the bodies held.
void by_compliance(const System& system, const StructuredMatrix& A, Index body,
                   StagedStiffness& result) {
  const Index t = system.first_pose, nt = system.load_size;
  const FrontalBorders none{Matrix(system.size, 0), Matrix(system.size, 0), Matrix(0, 0)};
  Matrix X = Matrix::Zero(system.size, nt);
  X.bottomRows(nt).setIdentity();
  if (!A.solve(none, X, false)) return;
  const Matrix C = symmetric_part(X.middleRows(t, nt));
  const Vector c = symmetric_eigenvalues(C);
  Vector& values = result.condensed.platform.eigenvalues;
  values.resize(nt);
  for (Index i = 0; i < nt; ++i)
    values[i] = std::abs(c[i]) > 1e-12 * c.cwiseAbs().maxCoeff()
                    ? 1 / c[i]
                    : std::numeric_limits<double>::infinity();
  std::sort(values.begin(), values.end());
  const BodySlice& b = system.body_slices[static_cast<std::size_t>(body - 1)];
  result.compliance = C.block(b.W, b.W, b.count, b.count);
}

}  // namespace

StagedStiffness stiffness_in_stages(const System& system, const StageJacobians& stages,
                                    const StructuredMatrix& A, Index body) {
  if (has_entries(system)) return sparse_stiffness(system, A, body);
  const Index n = system.size, nt = system.load_size;
  StagedStiffness result;
  FrontalBorders poses{Matrix::Zero(n, nt), {}, Matrix::Zero(nt, nt)};
  poses.B.bottomRows(nt).setIdentity();
  poses.C = poses.B;
  Matrix X = Matrix::Zero(n + nt, nt);
  X.bottomRows(nt).setIdentity();
  const bool held = A.solve(poses, X, false);
  const auto inertia = A.inertia();
  if (inertia) result.zero_modes = inertia->zero;
  const bool regular = inertia && inertia->zero == 0;
  if (regular)
    result.condensed.stability.force_controlled = inertia->negative - system.closure_count();
  const bool rigid = !held || !(X.bottomRows(nt).cwiseAbs().maxCoeff() < rigidity * A.largest);
  if (rigid) {
    if (regular) by_compliance(system, A, body, result);
    return result;
  }
  const Matrix K = symmetric_part(-X.bottomRows(nt));
  result.condensed.platform = {K, symmetric_eigenvalues(K)};
  result.body = of_body(system, K, body);
  for (std::size_t i = 0; i < system.chains.size(); ++i)
    result.chains.push_back(stages.chain_stiffness(i, X.topRows(n)));
  const Vector& values = result.condensed.platform.eigenvalues;
  const double least = eigenvalue_rounding * values.cwiseAbs().maxCoeff();
  if (regular && (values.array().abs() > least).all())
    result.condensed.stability.pose_controlled =
        inertia->negative - (values.array() < 0).count() - system.closure_count();
  return result;
}

}  // namespace springfold::statics
