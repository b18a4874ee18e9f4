#include "springfold/core/small_lu.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "springfold/core/rounding.hpp"

namespace springfold {
namespace {

template <Index N>
using Column = Eigen::Matrix<double, N, 1>;
template <Index N>
using InPlace = Eigen::Map<Column<N>, Eigen::Aligned16>;
template <Index N>
using Given = Eigen::Map<const Column<N>, Eigen::Aligned16>;

/// Long columns are worked on in parts of four numbers, without those that are zero.
constexpr Index part_size = 4, long_column = 20;

/// y -= factor x from row `first` on, up to `end`.
inline void subtract(double factor, const double* x, double* y, Index first, Index end) {
  for (Index i = first / part_size * part_size; i < end; i += part_size)
    InPlace<part_size>(y + i) -= factor * Given<part_size>(x + i);
}

/// Subtracts multiples of a column of L from the columns of U behind it.
template <Index N>
void eliminate_column(const double* L, double* U, Index k, Index n) {
  if constexpr (N < long_column) {
    const Column<N> l = Given<N>(L + k * N);
    for (Index j = k + 1; j < n; ++j) InPlace<N>(U + j * N) -= U[j * N + k] * l;
  } else {
    for (Index j = k + 1; j < n; ++j) subtract(U[j * N + k], L + k * N, U + j * N, k + 1, N);
  }
}

template <Index N>
void substitute_columns(const double* L, const double* U, Index n, double* x) {
  Column<N> y = Column<N>::Zero();
  std::copy_n(x, n, y.data());
  for (Index k = 0; k < n; ++k) {
    if constexpr (N < long_column)
      y -= y[k] * Given<N>(L + k * N);
    else
      subtract(y[k], L + k * N, y.data(), k + 1, N);
  }
  for (Index k = n; k-- > 0;) {
    const double solution = y[k] / U[k * N + k];
    if constexpr (N < long_column)
      y -= solution * Given<N>(U + k * N);
    else
      subtract(solution, U + k * N, y.data(), 0, k);
    x[k] = solution;
  }
}

}  // namespace

struct SmallLu::Ways {
  Index length;
  void (*eliminate)(const double*, double*, Index, Index);
  void (*substitute)(const double*, const double*, Index, double*);

  template <Index N>
  static constexpr Ways of() {
    return {N, &eliminate_column<N>, &substitute_columns<N>};
  }
};

void SmallLu::prepare(Index n) {
  static constexpr Ways ways[] = {Ways::of<4>(),  Ways::of<8>(),  Ways::of<12>(), Ways::of<16>(),
                                  Ways::of<20>(), Ways::of<24>(), Ways::of<28>(), Ways::of<32>(),
                                  Ways::of<36>(), Ways::of<40>()};
  n_ = n;
  ways_ =
      std::find_if(std::begin(ways), std::end(ways), [n](const Ways& w) { return w.length >= n; });
  length_ = ways_->length;
  std::fill_n(L(), n * length_, 0.0);
  for (Index j = 0; j < n; ++j) std::fill_n(column(j) + n, length_ - n, 0.0);
}

SmallLu::SmallLu(const Eigen::Ref<const Matrix>& A) {
  assert(A.rows() == A.cols() && fits(A.rows()));
  prepare(A.rows());
  for (Index j = 0; j < n_; ++j) std::copy_n(A.col(j).data(), n_, column(j));
  factorise();
}

SmallLu::SmallLu(const Matrix& A, const Vector& b, const Eigen::Ref<const Vector>& c, double d) {
  assert(A.rows() == A.cols() && fits(A.rows() + 1));
  const Index n = A.rows();
  prepare(n + 1);
  for (Index j = 0; j < n; ++j) {
    std::copy_n(A.col(j).data(), n, column(j));
    column(j)[n] = c[j];
  }
  std::copy_n(b.data(), n, column(n));
  column(n)[n] = d;
  factorise();
}

void SmallLu::factorise() {
  smallest_ = infinity;
  greatest_ = 0;
  for (Index k = 0; k < n_; ++k) {
    double* const u = column(k);
    double* const l = L() + k * length_;
    Index row = k;
    for (Index i = k + 1; i < n_; ++i)
      if (std::abs(u[i]) > std::abs(u[row])) row = i;
    exchanged_[static_cast<std::size_t>(k)] = row;
    if (row != k) {
      for (Index j = 0; j < k; ++j) std::swap(L()[j * length_ + k], L()[j * length_ + row]);
      for (Index j = k; j < n_; ++j) std::swap(column(j)[k], column(j)[row]);
    }
    const double size = std::abs(u[k]);
    smallest_ = size < smallest_ ? size : smallest_;
    if (!(size > 0)) {  // NaN as well
      smallest_ = size;
      return;
    }
    greatest_ = std::max(greatest_, size);
    const double inverse = 1 / u[k];
    for (Index i = k + 1; i < n_; ++i) {
      l[i] = u[i] * inverse;
      u[i] = 0;
    }
    ways_->eliminate(L(), numbers_.data(), k, n_);
  }
}

int SmallLu::sign() const {
  if (!(smallest_ > 0)) return 0;
  bool negative = false;
  for (Index k = 0; k < n_; ++k)
    negative ^= (exchanged_[static_cast<std::size_t>(k)] != k) ^ (U()[k * length_ + k] < 0);
  return negative ? -1 : 1;
}

/// Some columns side by side, so that none waits for its own last result.
void SmallLu::solve(Matrix& X) const {
  constexpr Index width = 8;
  using Row = Eigen::Array<double, 1, width>;
  std::array<Row, static_cast<std::size_t>(largest)> rows;
  const auto row = [&](Index i) -> Row& { return rows[static_cast<std::size_t>(i)]; };
  for (Index first = 0; first < X.cols(); first += width) {
    const Index count = std::min(width, X.cols() - first);
    for (Index i = 0; i < n_; ++i) {
      row(i).setZero();
      for (Index j = 0; j < count; ++j) row(i)[j] = X(i, first + j);
    }
    for (Index k = 0; k < n_; ++k) {
      if (const Index other = exchanged_[static_cast<std::size_t>(k)]; other != k)
        std::swap(row(k), row(other));
    }
    for (Index k = 0; k < n_; ++k) {
      const double* const l = L() + k * length_;
      for (Index i = k + 1; i < n_; ++i) row(i) -= l[i] * row(k);
    }
    for (Index k = n_; k-- > 0;) {
      const double* const u = U() + k * length_;
      row(k) *= 1 / u[k];
      for (Index i = 0; i < k; ++i) row(i) -= u[i] * row(k);
    }
    for (Index i = 0; i < n_; ++i)
      for (Index j = 0; j < count; ++j) X(i, first + j) = row(i)[j];
  }
}

void SmallLu::solve(double* x) const {
  for (Index k = 0; k < n_; ++k) std::swap(x[k], x[exchanged_[static_cast<std::size_t>(k)]]);
  ways_->substitute(L(), U(), n_, x);
}

}  // namespace springfold
