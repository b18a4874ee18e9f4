// The equations of a path and their derivatives. They are evaluated more often than anything else:
// all storage is the problem's own, and nothing is multiplied that is known to be one or zero.
#include "path_problem.hpp"
#include "quaternion.hpp"
#include "springfold/core/differences.hpp"

namespace springfold::analysis {
namespace {

/// Sums of so many products are the same numbers in whatever order: Eigen's general products, which may choose one, are
/// long beside them.
constexpr Index short_sum = 2;

/// Constant plus lambda times rate, where there is a rate.
void put_line(const Vector& start, double lambda, const Vector& rate, Vector& value) {
  value = start;
  if (rate.size() > 0) value += lambda * rate;
}

}  // namespace

const std::vector<model::Mat3<double>>& PathProblem::frames(const Vector& y) const {
  frames_.assign(system_.body_slices.size(), model::Mat3<double>::Identity());
  for (const FreeRotation& r : rotations_) frames_[r.body] = rotation_of(y.segment<4>(r.y));
  return frames_;
}

statics::Inputs PathProblem::inputs(double lambda) const {
  statics::Inputs in;
  put_inputs(lambda, in);
  return in;
}

void PathProblem::put_inputs(double lambda, statics::Inputs& in) const {
  put_line(rule_.load_start, lambda, rule_.load_rate, in.loads);
  if (rule_.family) {
    in.rho = system(lambda).commands;
    in.W = family_->second;
    return;
  }
  put_line(rule_.rho_start, lambda, rule_.rho_rate, in.rho);
  put_line(rule_.W_start, lambda, rule_.W_rate, in.W);
}

/// The entries of v that are entries of y too; zero for quaternions.
void PathProblem::spread(const Vector& v, Vector& y) const {
  y.setZero(size_);
  for (Index i = 0; i < plain_size_; ++i)
    if (const Index p = place_[static_cast<std::size_t>(i)]; p >= 0) y[p] = v[i];
}

/// v of a direction or a point y; rotation vectors are zero.
void PathProblem::gather(const Vector& y, Vector& v) const {
  v.resize(plain_size_);
  for (Index i = 0; i < plain_size_; ++i) {
    const Index p = place_[static_cast<std::size_t>(i)];
    v[i] = p >= 0 ? y[p] : 0.0;
  }
}

/// The pose coordinates of a rate or a point, N v_t, added to z.
void PathProblem::add_motion(const Vector& v, Vector& z) const {
  const Index free = rule_.N.cols(), tail = system_.size - t_ - d_;
  z.head(t_) = v.head(t_);
  if (is_whole_)
    z.segment(t_, d_) += v.segment(t_, d_);
  else if (free > 0 && free <= short_sum)
    z.segment(t_, d_) += rule_.N.lazyProduct(v.segment(t_, free));
  else if (free > 0)
    z.segment(t_, d_).noalias() += rule_.N * v.segment(t_, free);
  z.tail(tail) = v.tail(tail);
}

void PathProblem::put_local(const Vector& y, double lambda, Vector& z) const {
  gather(y, v_);
  z.resize(system_.size);
  z.segment(t_, d_) = rule_.t_start + lambda * rule_.t_rate;
  add_motion(v_, z);
  for (const FreeRotation& r : rotations_) z.segment<3>(r.z).setZero();
}

Vector PathProblem::local(const Vector& y, double lambda) const {
  Vector z;
  put_local(y, lambda, z);
  return z;
}

Vector PathProblem::local_rate(const Vector& y, const Vector& dy, double dlambda) const {
  gather(dy, v_);
  for (const FreeRotation& r : rotations_)
    v_.segment<3>(r.v) = rate_of(y.segment<4>(r.y)) * dy.segment<4>(r.y);
  Vector dz(system_.size);
  dz.segment(t_, d_) = dlambda * rule_.t_rate;
  add_motion(v_, dz);
  return dz;
}

Vector PathProblem::reduce(const Vector& z) const {
  Vector from_start = z;
  from_start.segment(t_, d_) -= rule_.t_start;
  Vector v, y;
  reduce_rows(from_start, v);
  spread(v, y);
  for (const FreeRotation& r : rotations_) y.segment<4>(r.y) = quaternion_of(z.segment<3>(r.z));
  return y;
}

/// Rows of the residual that belong to v.
void PathProblem::reduce_rows(const Vector& r, Vector& reduced) const {
  const Index free = rule_.N.cols(), tail = system_.size - t_ - d_;
  reduced.resize(plain_size_);
  reduced.head(t_) = r.head(t_);
  if (is_whole_)
    reduced.segment(t_, d_) = r.segment(t_, d_);
  else if (free > 0 && d_ <= short_sum)
    reduced.segment(t_, free) = rule_.N.transpose().lazyProduct(r.segment(t_, d_));
  else if (free > 0)
    reduced.segment(t_, free).noalias() = rule_.N.transpose() * r.segment(t_, d_);
  reduced.tail(tail) = r.tail(tail);
}

///     | A_hh     A_ht N      A_hw     |
///     | N^T A_th N^T A_tt N  N^T A_tw |      h: before the study's body, t: its pose, w: behind it
///     | A_wh     A_wt N      A_ww     |
void PathProblem::reduce_matrix(const Matrix& A, Matrix& reduced) const {
  if (is_whole_) {
    reduced = A;
    return;
  }
  const Index free = rule_.N.cols(), tail = system_.size - t_ - d_;
  columns_.resize(system_.size, plain_size_);
  columns_.leftCols(t_) = A.leftCols(t_);
  if (free > 0 && d_ <= short_sum)
    columns_.middleCols(t_, free) = A.middleCols(t_, d_).lazyProduct(rule_.N);
  else if (free > 0)
    columns_.middleCols(t_, free).noalias() = A.middleCols(t_, d_) * rule_.N;
  columns_.rightCols(tail) = A.rightCols(tail);
  reduced.resize(plain_size_, plain_size_);
  reduced.topRows(t_) = columns_.topRows(t_);
  if (free > 0 && d_ <= short_sum)
    reduced.middleRows(t_, free) = rule_.N.transpose().lazyProduct(columns_.middleRows(t_, d_));
  else if (free > 0)
    reduced.middleRows(t_, free).noalias() = rule_.N.transpose() * columns_.middleRows(t_, d_);
  reduced.bottomRows(tail) = columns_.bottomRows(tail);
}

/// T^T plain T with dv = T dy: rows and columns of rotation vectors become those of quaternions.
void PathProblem::put_quaternions(const Vector& y, const Matrix& plain, Matrix& result) const {
  columns_.resize(plain_size_, size_);
  result.resize(size_, size_);
  for (Index i = 0; i < plain_size_; ++i)
    if (const Index p = place_[static_cast<std::size_t>(i)]; p >= 0) columns_.col(p) = plain.col(i);
  for (const FreeRotation& r : rotations_)
    columns_.middleCols<4>(r.y).noalias() =
        plain.middleCols<3>(r.v).lazyProduct(rate_of(y.segment<4>(r.y)));
  for (Index i = 0; i < plain_size_; ++i)
    if (const Index p = place_[static_cast<std::size_t>(i)]; p >= 0)
      result.row(p) = columns_.row(i);
  for (const FreeRotation& r : rotations_)
    result.middleRows<4>(r.y).noalias() =
        rate_of(y.segment<4>(r.y)).transpose().lazyProduct(columns_.middleRows<3>(r.v));
}

/// Rows of rotation vectors become those of quaternions.
void PathProblem::put_quaternions(const Vector& y, const Vector& plain, Vector& result) const {
  spread(plain, result);
  for (const FreeRotation& r : rotations_)
    result.segment<4>(r.y) = rate_of(y.segment<4>(r.y)).transpose() * plain.segment<3>(r.v);
}

bool PathProblem::has_rotations(const Vector& y) const {
  for (const FreeRotation& r : rotations_)
    if (!(y.segment<4>(r.y).norm() > 0.1)) return false;
  return true;
}

bool PathProblem::residual(const Vector& y, double lambda, const Piece& piece, Vector& F) const {
  if (!has_rotations(y)) return false;
  put_local(y, lambda, z_);
  put_inputs(lambda, inputs_);
  const statics::System& present = turned(y, lambda);
  const auto evaluate = [&](Vector& r) {
    return stages_ ? stages_->residual(present, piece, z_, inputs_, r)
                   : equilibrium_residual(present, piece, z_, inputs_, work_, r);
  };
  if (rotations_.empty() && is_whole_) return evaluate(F);
  const bool finite = evaluate(r_);
  reduce_residual(y, F);
  return finite;
}

/// F from the residual of the statics in r_.
void PathProblem::reduce_residual(const Vector& y, Vector& F) const {
  if (rotations_.empty()) return reduce_rows(r_, F);
  reduce_rows(r_, v_);
  put_quaternions(y, v_, F);
  for (const FreeRotation& r : rotations_) {
    const Quaternion q = y.segment<4>(r.y);
    F.segment<4>(r.y) += (q.squaredNorm() - 1) * q;
  }
}

/// d residual/d lambda. @param A  of this point, like dR_drho_; null: that of the stages
bool PathProblem::put_rate(const Vector& y, double lambda, const Piece& piece,
                           const statics::System& present, const Matrix* A, Vector& rate) const {
  if (rule_.family) {
    const auto at = [&](double l) -> std::optional<Vector> {
      auto [system, W] = rule_.family(l);
      if (!rotations_.empty()) turn_frames(statics::System{system}, frames(y), system);
      Vector r;
      if (!equilibrium_residual(system, piece, z_, {system.commands, W, rule_.load_start}, work_,
                                r))
        return std::nullopt;
      return r;
    };
    const auto by_parameter = six_point_derivative(at, lambda, rule_.family_step);
    if (by_parameter) rate = *by_parameter;
    return by_parameter.has_value();
  }
  rate.setZero(system_.size);
  if (A == nullptr && (moves_pose_ || moves_commands_)) {
    dz_.setZero(system_.size);
    dz_.segment(t_, d_) = rule_.t_rate;
    stages_->product(dz_, moves_commands_ ? rule_.rho_rate : none_, rate);
  }
  if (A != nullptr && moves_pose_) rate.noalias() += A->middleCols(t_, d_) * rule_.t_rate;
  if (A != nullptr && moves_commands_) rate.noalias() += dR_drho_ * rule_.rho_rate;
  if (moves_wrench_) add_wrench_rate(present, z_, rule_.W_rate, rate);
  if (moves_loads_) {
    statics::put_load_rate(present, z_, inputs_.rho, rule_.load_rate, load_work_, dz_);
    rate += dz_;
  }
  return true;
}

bool PathProblem::derivatives(const Vector& y, double lambda, const Piece& piece, Matrix& dF_dy,
                              Vector& dF_dlambda) const {
  return equations(y, lambda, piece, F_, dF_dy, dF_dlambda);
}

bool PathProblem::equations(const Vector& y, double lambda, const Piece& piece, Vector& F,
                            Matrix& dF_dy, Vector& dF_dlambda) const {
  if (!has_rotations(y)) return false;
  put_local(y, lambda, z_);
  put_inputs(lambda, inputs_);
  const statics::System& present = turned(y, lambda);
  Matrix* const by_commands = moves_commands_ ? &dR_drho_ : nullptr;
  if (rotations_.empty() && is_whole_)
    return equilibrium_matrix(present, piece, z_, inputs_, work_, F, dF_dy, by_commands) &&
           put_rate(y, lambda, piece, present, &dF_dy, dF_dlambda);
  newest_ = (newest_ + 1) % known_.size();
  KnownMatrix& own = known_[newest_];
  own.lambda = std::numeric_limits<double>::quiet_NaN();
  Matrix& A = own.A;
  if (!equilibrium_matrix(present, piece, z_, inputs_, work_, r_, A, by_commands) ||
      !put_rate(y, lambda, piece, present, &A, rate_))
    return false;
  own.y = y;
  own.lambda = lambda;
  own.piece = piece;
  reduce_residual(y, F);
  if (rotations_.empty()) {
    reduce_matrix(A, dF_dy);
    reduce_rows(rate_, dF_dlambda);
    return true;
  }
  // dF/dy = T^T (dr/dv) T + second derivatives of T + the equation for the length of q.
  reduce_matrix(A, plain_);
  put_quaternions(y, plain_, dF_dy);
  reduce_rows(rate_, v_);
  put_quaternions(y, v_, dF_dlambda);
  reduce_rows(r_, v_);
  for (const FreeRotation& r : rotations_) {
    const Quaternion q = y.segment<4>(r.y);
    dF_dy.block<4, 4>(r.y, r.y) += curvature_of(q, v_.segment<3>(r.v)) +
                                   (q.squaredNorm() - 1) * Eigen::Matrix4d::Identity() +
                                   2 * q * q.transpose();
  }
  return true;
}

const Matrix* PathProblem::known_matrix(const Vector& y, double lambda, const Piece& piece) const {
  for (const KnownMatrix& known : known_)
    if (known.lambda == lambda && known.y == y && known.piece == piece) return &known.A;
  return nullptr;
}

bool PathProblem::second_along(const Vector& y, double lambda, const Piece& piece, const Vector& w,
                               const Vector& V, Vector& value) const {
  if (!knows_second_) return false;
  put_local(y, lambda, z_);
  put_inputs(lambda, inputs_);
  // y is v here: no rotation is free.
  dz_.setZero(system_.size);
  add_motion(w, dz_);
  along_.z.setZero(system_.size);
  along_.z.segment(t_, d_) = V[size_] * rule_.t_rate;
  add_motion(V.head(size_), along_.z);
  along_.rho.setZero(inputs_.rho.size());
  if (moves_commands_) along_.rho = V[size_] * rule_.rho_rate;
  put_second_derivatives(system_, piece, z_, inputs_.rho, dz_, along_, work_, second_);
  reduce_rows(second_.z, v_);
  value.resize(size_ + 1);
  value.head(size_) = v_;
  value[size_] = second_.z.segment(t_, d_).dot(rule_.t_rate);
  if (moves_commands_) value[size_] += second_.rho.dot(rule_.rho_rate);
  return true;
}

}  // namespace springfold::analysis
