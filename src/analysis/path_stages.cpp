// The equations of a path with long chains: residual and matrix in stages, linear in their length.
#include "path_problem.hpp"
#include "quaternion.hpp"

namespace springfold::analysis {

/// Root unknowns are those behind the chains' part of y. Each belongs to one body.
void PathProblem::find_stages() {
  if (!statics::prefers_stages(system_)) return;
  const Index first = system_.first_pose;
  std::vector<std::vector<Index>> columns(system_.body_slices.size());
  Index y = first;
  for (std::size_t b = 0; b < columns.size(); ++b) {
    const statics::BodySlice& body = system_.body_slices[b];
    Index count = body.t == t_ ? rule_.N.cols() : body.count;
    for (const FreeRotation& r : rotations_)
      if (r.body == b) ++count;
    for (Index k = 0; k < count; ++k) columns[b].push_back(y - first + k);
    y += count;
  }
  stages_.emplace(system_, columns);
}

/// d(poses) = basis d(root unknowns): N for the study's body, rate_of(q) for free rotations, otherwise 1.
void PathProblem::put_basis(const Vector& y) const {
  const Index first = system_.first_pose;
  basis_.setZero(system_.size - first, size_ - first);
  Index column = 0;
  for (std::size_t b = 0; b < system_.body_slices.size(); ++b) {
    const statics::BodySlice& body = system_.body_slices[b];
    const Index row = body.t - first;
    const FreeRotation* turning = nullptr;
    for (const FreeRotation& r : rotations_)
      if (r.body == b) turning = &r;
    const Index free = body.t == t_ ? rule_.N.cols() : body.count;
    const Index plain = free - (turning != nullptr ? 3 : 0);
    auto own = basis_.block(row, column, body.count, plain);
    if (body.t == t_)
      own = rule_.N.leftCols(plain);
    else
      own.setIdentity();
    if (turning != nullptr)
      basis_.block<3, 4>(turning->z - first, column + plain) = rate_of(y.segment<4>(turning->y));
    column += plain + (turning != nullptr ? 4 : 0);
  }
}

bool PathProblem::structured_derivatives(const Vector& y, double lambda, const Piece& piece,
                                         StructuredMatrix& dF_dy, Vector& dF_dlambda) const {
  if (!has_rotations(y)) return false;
  put_local(y, lambda, z_);
  put_inputs(lambda, inputs_);
  const statics::System& present = turned(y, lambda);
  put_basis(y);
  if (!stages_->begin_matrix(present, piece, z_, inputs_, r_)) return false;
  if (!rotations_.empty()) {
    const Index first = system_.first_pose;
    added_.setZero(size_ - first, size_ - first);
    for (const FreeRotation& r : rotations_) {
      const Quaternion q = y.segment<4>(r.y);
      added_.block<4, 4>(r.y - first, r.y - first) =
          curvature_of(q, r_.segment<3>(r.z)) +
          (q.squaredNorm() - 1) * Eigen::Matrix4d::Identity() + 2 * q * q.transpose();
    }
  }
  if (!stages_->end_matrix(present, basis_, added_, dF_dy)) return false;
  if (!put_rate(y, lambda, piece, present, nullptr, rate_)) return false;
  reduce_rows(rate_, v_);
  put_quaternions(y, v_, dF_dlambda);
  return true;
}

}  // namespace springfold::analysis
