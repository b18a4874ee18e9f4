#include "embedded.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace springfold::known_answers {

Matrix random_orthogonal(Index n, double determinant, Random& random) {
  Matrix A(n, n);
  for (double& value : A.reshaped()) value = uniform(random, -1, 1);
  Matrix Q = Eigen::HouseholderQR<Matrix>(A).householderQ();
  if (Q.determinant() * determinant < 0) Q.col(0) *= -1;
  return Q;
}

Embedded::Embedded(const Base& base, Index n, bool wide, Random& random)
    : base_{base}, n_{std::max(n, base.size)}, k_{base.size} {
  const Matrix Q = random_orthogonal(n_, sign(random), random);
  Vector S(n_);
  for (double& value : S) value = log_uniform(random, 0.1, 10);
  to_q_ = Q * S.asDiagonal();
  to_zw_ = S.cwiseInverse().asDiagonal() * Q.transpose();
  const Index extra = n_ - k_;
  stiffness_.resize(extra);
  amplitude_.resize(extra);
  frequency_.resize(extra);
  for (Index i = 0; i < extra; ++i) {
    stiffness_[i] = log_uniform(random, wide ? 1e-2 : 0.3, wide ? 1e2 : 3) *
                    (uniform(random, 0, 1) < 0.2 ? -1 : 1);
    if (stiffness_[i] < 0) ++negative_extra_;
    amplitude_[i] = uniform(random, -0.5, 0.5);
    frequency_[i] = uniform(random, 0.3, 1.5);
    follows_.push_back(choice(random, static_cast<int>(k_)));
  }
}

Vector Embedded::embed(const Vector& z) const {
  Vector zw(n_);
  zw.head(k_) = z;
  for (Index i = 0; i < n_ - k_; ++i)
    zw[k_ + i] = amplitude_[i] * std::sin(frequency_[i] * z[follows_[static_cast<std::size_t>(i)]]);
  return to_q_ * zw;
}

Vector Embedded::base_point(const Vector& q) const { return to_zw_.topRows(k_) * q; }

Piece Embedded::piece_at(const Vector& z) const {
  Piece piece;
  for (const double d : base_.thresholds) piece.push_back(z[0] > d ? 1 : -1);
  return piece;
}

Embedded Embedded::turned(const Matrix& R) const {
  Embedded other = *this;
  other.to_q_ = R * to_q_;
  other.to_zw_ = to_zw_ * R.transpose();
  return other;
}

Embedded Embedded::in_units(double unit) const {
  Embedded other = *this;
  other.unit_ = unit * unit_;
  other.force_ = unit * force_;
  other.to_q_ = unit * to_q_;
  other.to_zw_ = to_zw_ / unit;
  return other;
}

Embedded Embedded::with_forces(double factor) const {
  Embedded other = *this;
  other.force_ *= factor;
  return other;
}

/// Gradient and Hessian in (z, w).
bool Embedded::evaluate(const Vector& q, double lambda, const Piece& piece) const {
  const Vector zw = to_zw_ * q;
  Vector F, F_lambda;
  Matrix H;
  if (!base_.at(zw.head(k_), lambda, piece, F, H, F_lambda)) return false;
  F_ = Vector::Zero(n_);
  H_ = Matrix::Zero(n_, n_);
  F_lambda_ = Vector::Zero(n_);
  F_.head(k_) = F;
  H_.topLeftCorner(k_, k_) = H;
  F_lambda_.head(k_) = F_lambda;
  for (Index i = 0; i < n_ - k_; ++i) {
    const Index z = follows_[static_cast<std::size_t>(i)], w = k_ + i;
    const double a = amplitude_[i], f = frequency_[i], k = stiffness_[i];
    const double g = a * std::sin(f * zw[z]), dg = a * f * std::cos(f * zw[z]), ddg = -f * f * g;
    const double off = zw[w] - g;
    F_[w] += k * off;
    F_[z] -= k * off * dg;
    H_(w, w) += k;
    H_(w, z) -= k * dg;
    H_(z, w) -= k * dg;
    H_(z, z) += k * (dg * dg - off * ddg);
  }
  return true;
}

bool Embedded::residual(const Vector& q, double lambda, const Piece& piece, Vector& F) const {
  if (!evaluate(q, lambda, piece)) return false;
  F = force_ * (to_zw_.transpose() * F_);
  return true;
}

bool Embedded::derivatives(const Vector& q, double lambda, const Piece& piece, Matrix& dF_dq,
                           Vector& dF_dlambda) const {
  if (!evaluate(q, lambda, piece)) return false;
  const Matrix K = to_zw_.transpose() * H_ * to_zw_;
  dF_dq = (0.5 * force_) * (K + K.transpose());
  dF_dlambda = force_ * (to_zw_.transpose() * F_lambda_);
  return true;
}

bool Embedded::switches(const Vector& q, double, Vector& g) const {
  g.resize(switch_count());
  const double z = to_zw_.row(0).dot(q);
  for (Index j = 0; j < g.size(); ++j) g[j] = z - base_.thresholds[static_cast<std::size_t>(j)];
  return true;
}

bool Embedded::switch_gradients(const Vector&, double, Matrix& dg_dq, Vector& dg_dlambda) const {
  dg_dq = to_zw_.row(0).replicate(switch_count(), 1);
  dg_dlambda = Vector::Zero(switch_count());
  return true;
}

}  // namespace springfold::known_answers
