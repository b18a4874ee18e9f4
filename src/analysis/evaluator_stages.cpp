// Quantities of mechanisms with long chains: everything in stages, linear in their length.
#include <algorithm>
#include <cmath>
#include <limits>

#include "closure_rank.hpp"
#include "quantities.hpp"

namespace springfold::analysis {

const Evaluator::Assembled* Evaluator::assemble_in_stages(
    const continuation::CurvePoint& point) const {
  Assembled& at = scratch_;
  const statics::System& system = problem_.turned_to_pose(point.x, point.lambda, at.z);
  at.is_plain = &system == &problem_.system(point.lambda);
  problem_.put_inputs(point.lambda, at.inputs);
  StructuredMatrix A;
  if (!stages_->matrix(system, point.piece, at.z, at.inputs, {}, {}, at.r, A)) return nullptr;
  at.staged = stiffness_in_stages(system, *stages_, A, problem_.rule().body);
  at.platform = at.staged.condensed.platform;
  at.stability = at.staged.condensed.stability;
  if (!at.stability.pose_controlled) {
    // K is singular, or a chain rigid. With stiff springs on the bodies only unstable chains are counted.
    constexpr double stiff = 1e6;
    const Index n = system.load_size;
    const double stiffness = std::max(stiff * A.largest, 4 * at.platform.K.norm());
    const Matrix springs = stiffness * Matrix::Identity(n, n);
    if (!stages_->matrix(system, point.piece, at.z, at.inputs, {}, springs, at.r, A))
      return nullptr;
    const auto inertia = A.inertia();
    if (inertia && inertia->zero == 0)
      at.stability.pose_controlled = inertia->negative - system.closure_count();
  }
  at.body = at.staged.body;
  return &at;
}

/// Rows of the study's body times the branch's direction; `size` is that of these rows.
double Evaluator::force_rate_in_stages(const continuation::CurvePoint& point, double& size) const {
  const statics::System& system = problem_.turned(point.x, point.lambda);
  const Vector dz = problem_.local_rate(point.x, point.tangent.dx, point.tangent.dlambda);
  StructuredMatrix A;
  Vector r;
  size = 0;
  if (!stages_->matrix(system, point.piece, problem_.local(point.x, point.lambda),
                       problem_.inputs(point.lambda), {}, {}, r, A))
    return std::numeric_limits<double>::quiet_NaN();
  for (Index k = 0; k < d_; ++k)
    size = std::hypot(size, product(A, Vector::Unit(system.size, t_ + k)).norm());
  return conjugate_.dot(product(A, dz).segment(t_, d_));
}

std::vector<Index> Evaluator::closure_ranks_in_stages() const {
  const statics::System& layout = problem_.layout();
  std::vector<Index> ranks;
  for (const statics::ChainSlice& slice : layout.chain_slices) {
    Matrix J(slice.F_count, slice.x_count);
    for (Index k = 0; k < slice.F_count; ++k)
      J.row(k) = -stages_->product(Vector::Unit(layout.size, slice.F + k), {})
                      .segment(slice.x, slice.x_count);
    ranks.push_back(rank_of(J, same_rank));
  }
  return ranks;
}

}  // namespace springfold::analysis
