#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>

#include "family.hpp"

namespace springfold::known_answers {

double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

double log_uniform(std::mt19937_64& random, double low, double high) {
  return std::exp(uniform(random, std::log(low), std::log(high)));
}

Embedded::Embedded(const Base& base, Index n, std::mt19937_64& random)
    : base_{base}, n_{std::max(n, base.size)}, k_{base.size} {
  Matrix random_matrix(n_, n_);
  for (double& value : random_matrix.reshaped()) value = uniform(random, -1, 1);
  const Matrix Q = Eigen::HouseholderQR<Matrix>(random_matrix).householderQ();
  Vector S(n_);
  for (double& value : S) value = log_uniform(random, 0.1, 10);
  to_q_ = Q * S.asDiagonal();
  to_zw_ = S.cwiseInverse().asDiagonal() * Q.transpose();
  const Index extra = n_ - k_;
  stiffness_.resize(extra);
  amplitude_.resize(extra);
  frequency_.resize(extra);
  for (Index i = 0; i < extra; ++i) {
    stiffness_[i] = log_uniform(random, 0.3, 3) * (uniform(random, 0, 1) < 0.2 ? -1 : 1);
    if (stiffness_[i] < 0) ++negative_extra_;
    amplitude_[i] = uniform(random, -0.5, 0.5);
    frequency_[i] = uniform(random, 0.3, 1.5);
    follows_.push_back(static_cast<Index>(random() % static_cast<std::uint64_t>(k_)));
  }
}

Vector Embedded::embed(const Vector& z) const {
  Vector zw(n_);
  zw.head(k_) = z;
  for (Index i = 0; i < n_ - k_; ++i)
    zw[k_ + i] = amplitude_[i] * std::sin(frequency_[i] * z[follows_[static_cast<std::size_t>(i)]]);
  return to_q_ * zw;
}

Vector Embedded::base_point(const Vector& q) const { return (to_zw_ * q).head(k_); }

/// Gradient and Hessian in (z, w).
bool Embedded::evaluate(const Vector& q, double lambda) const {
  const Vector zw = to_zw_ * q;
  Vector F, F_lambda;
  Matrix H;
  if (!base_.at(zw.head(k_), lambda, F, H, F_lambda)) return false;
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

bool Embedded::residual(const Vector& q, double lambda, Vector& F) const {
  if (!evaluate(q, lambda)) return false;
  F = to_zw_.transpose() * F_;
  return true;
}

bool Embedded::derivatives(const Vector& q, double lambda, Matrix& dF_dq,
                           Vector& dF_dlambda) const {
  if (!evaluate(q, lambda)) return false;
  dF_dq = to_zw_.transpose() * H_ * to_zw_;
  dF_dq = (0.5 * (dF_dq + dF_dq.transpose())).eval();
  dF_dlambda = to_zw_.transpose() * F_lambda_;
  return true;
}

}  // namespace springfold::known_answers
