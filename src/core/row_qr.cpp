#include "springfold/core/row_qr.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace springfold {
namespace {

/// Squared lengths of what is left of the columns: measured once, then less what goes into R, and measured again where
/// that is nearly all of them.
class ColumnLengths {
 public:
  explicit ColumnLengths(const Matrix& columns)
      : columns_{columns}, left_{columns.colwise().squaredNorm()}, measured_{left_} {}

  Index longest(Index k) const {
    Index place = 0;
    left_.tail(left_.size() - k).maxCoeff(&place);
    return k + place;
  }
  void exchange(Index i, Index j) {
    std::swap(left_[i], left_[j]);
    std::swap(measured_[i], measured_[j]);
  }
  /// Entry k of column j is R's.
  void take_off(Index k, Index j) {
    constexpr double too_little = 1e-6;  // ten digits are left
    left_[j] -= columns_(k, j) * columns_(k, j);
    if (left_[j] > too_little * measured_[j]) return;
    left_[j] = measured_[j] = columns_.col(j).tail(columns_.rows() - k - 1).squaredNorm();
  }

 private:
  const Matrix& columns_;
  Vector left_, measured_;
};

}  // namespace

void RowQr::compute(const Matrix& A, Index dependent) {
  const Index m = A.rows(), n = A.cols(), rank = m - dependent;
  factors_ = A.transpose();
  tau_.setZero(rank);
  order_.resize(static_cast<std::size_t>(m));
  for (Index k = 0; k < m; ++k) order_[static_cast<std::size_t>(k)] = k;
  independent_ = rank <= n;
  ColumnLengths lengths(factors_);
  double largest = 0;
  for (Index k = 0; independent_ && k < rank; ++k) {
    const Index pivot = lengths.longest(k);
    const double length = factors_.col(pivot).tail(n - k).norm();
    largest = std::max(largest, length);
    // As the rank of a factorisation with column pivots is counted.
    independent_ =
        length > std::numeric_limits<double>::epsilon() * static_cast<double>(m) * largest;
    if (!independent_) return;
    if (pivot != k) {
      factors_.col(pivot).swap(factors_.col(k));
      std::swap(order_[static_cast<std::size_t>(pivot)], order_[static_cast<std::size_t>(k)]);
      lengths.exchange(pivot, k);
    }
    const double first = factors_(k, k), beta = first >= 0 ? -length : length;
    factors_.col(k).tail(n - k - 1) /= first - beta;
    tau_[k] = (beta - first) / beta;
    for (Index j = k + 1; j < m; ++j) {
      reflect(k, factors_.col(j).data());
      lengths.take_off(k, j);
    }
    factors_(k, k) = beta;
  }
}

/// x of the length of a column, mirrored: its entries from k on.
void RowQr::reflect(Index k, double* x) const {
  const Index n = factors_.rows();
  const double* const v = factors_.col(k).data();
  double sum = x[k];
  for (Index i = k + 1; i < n; ++i) sum += v[i] * x[i];
  if (sum == 0) return;  // rows that share no unknown
  sum *= tau_[k];
  x[k] -= sum;
  for (Index i = k + 1; i < n; ++i) x[i] -= sum * v[i];
}

Matrix RowQr::kernel() const {
  const Index n = factors_.rows(), m = tau_.size();
  Matrix Z = Matrix::Zero(n, n - m);
  for (Index j = 0; j < n - m; ++j) {
    Z(m + j, j) = 1;
    for (Index k = m; k-- > 0;) reflect(k, Z.col(j).data());
  }
  return Z;
}

Vector RowQr::least_norm(const Vector& b) const {
  const Index m = tau_.size();
  Vector x = Vector::Zero(factors_.rows());
  for (Index k = 0; k < m; ++k) {
    double sum = b[order_[static_cast<std::size_t>(k)]];
    for (Index i = 0; i < k; ++i) sum -= factors_(i, k) * x[i];
    x[k] = sum / factors_(k, k);
  }
  for (Index k = m; k-- > 0;) reflect(k, x.data());
  return x;
}

Vector RowQr::multipliers(const Vector& g) const {
  const Index m = tau_.size();
  Vector y = g;
  for (Index k = 0; k < m; ++k) reflect(k, y.data());
  Vector mu = Vector::Zero(factors_.cols());
  for (Index k = m; k-- > 0;) {
    y[k] /= factors_(k, k);
    for (Index i = 0; i < k; ++i) y[i] -= factors_(i, k) * y[k];
    mu[order_[static_cast<std::size_t>(k)]] = y[k];
  }
  return mu;
}

/// A row left out is a combination of the others, by R alone; what rounding leaves of orthogonality the second pass
/// takes.
Matrix RowQr::relations() const {
  const Index rank = tau_.size(), m = factors_.cols();
  Matrix N = Matrix::Zero(m, m - rank);
  Vector y(rank);
  for (Index j = 0; j < m - rank; ++j) {
    auto mu = N.col(j);
    y = factors_.col(rank + j).head(rank);
    for (Index k = rank; k-- > 0;) {
      y[k] /= factors_(k, k);
      for (Index i = 0; i < k; ++i) y[i] -= factors_(i, k) * y[k];
      mu[order_[static_cast<std::size_t>(k)]] = -y[k];
    }
    mu[order_[static_cast<std::size_t>(rank + j)]] = 1;
    for (int pass = 0; pass < 2; ++pass) {
      for (Index i = 0; i < j; ++i) mu -= N.col(i).dot(mu) * N.col(i);
      mu.normalize();
    }
  }
  return N;
}

}  // namespace springfold
