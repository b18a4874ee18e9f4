#include "small_symmetric.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "equal_sizes.hpp"

namespace springfold {
namespace {

/// Columns are worked on in parts of four rows, also where one or the other row is above the diagonal.
constexpr Index part = 4;
using Part = Eigen::Map<Eigen::Array<double, part, 1>, Eigen::Aligned16>;
using GivenPart = Eigen::Map<const Eigen::Array<double, part, 1>, Eigen::Aligned16>;

/// The inverse of the power of two next to sqrt(value).
double inverse_root(double value) { return std::ldexp(1.0, -((std::ilogb(value) + 1) >> 1)); }

}  // namespace

/// Largest entry of every row of the matrix, into `sizes`.
void SmallSymmetric::measure(Column& sizes) const {
  sizes.fill(0);
  for (Index j = 0; j < n_; ++j)
    for (Index i = j; i < n_; ++i) {
      const double size = std::abs(at(i, j));
      sizes[to(i)] = std::max(sizes[to(i)], size);
      sizes[to(j)] = std::max(sizes[to(j)], size);
    }
}

/// What equilibrate() does, for a symmetric matrix; in place, the factors in scale_.
void SmallSymmetric::equilibrate() {
  Column sizes, sorted;
  measure(sizes);
  const auto end = static_cast<std::ptrdiff_t>(n_);
  const auto [least, most] = std::minmax_element(sizes.begin(), sizes.begin() + end);
  scaled_ = !(*least * equal_sizes::alike >= *most && *least > 0);
  if (!scaled_) return;
  scale_.fill(1);
  sorted = sizes;
  std::nth_element(sorted.begin(), sorted.begin() + end / 2, sorted.begin() + end);
  const double floor = equal_sizes::rounding * sorted[to(n_ / 2)];
  std::array<bool, capacity> counts{};
  for (Index i = 0; i < n_; ++i) counts[to(i)] = sizes[to(i)] > floor;
  for (int pass = 0; pass < equal_sizes::passes; ++pass) {
    Column factors;
    bool done = true;
    for (Index i = 0; i < n_; ++i) {
      factors[to(i)] = counts[to(i)] && sizes[to(i)] > 0 ? inverse_root(sizes[to(i)]) : 1;
      scale_[to(i)] *= factors[to(i)];
      done = done && factors[to(i)] == 1;
    }
    if (done) return;
    for (Index j = 0; j < n_; ++j)
      for (Index i = j; i < n_; ++i) at(i, j) *= factors[to(i)] * factors[to(j)];
    measure(sizes);
  }
}

/// Which row is exchanged with the next one, or with the one behind it for a pivot of two rows.
SmallSymmetric::Pivot SmallSymmetric::pivot_at(Index k) const {
  const double alpha = (1 + std::sqrt(17.0)) / 8;  // bounds the growth (Bunch, Kaufman 1977)
  const double here = std::abs(at(k, k));
  double column = 0;
  Index p = k;
  for (Index i = k + 1; i < n_; ++i)
    if (std::abs(at(i, k)) > column) {
      column = std::abs(at(i, k));
      p = i;
    }
  if (here >= alpha * column) return {k, false};
  double row = 0;
  for (Index j = k; j < p; ++j) row = std::max(row, std::abs(at(p, j)));
  for (Index i = p + 1; i < n_; ++i) row = std::max(row, std::abs(at(i, p)));
  if (here >= alpha * column * (column / row)) return {k, false};
  return {p, std::abs(at(p, p)) < alpha * row};
}

/// Rows and columns `next` and p of what is left; `k` is the first one of a pivot of two rows.
void SmallSymmetric::exchange(Index k, Index next, Index p) {
  if (next == p) return;
  for (Index i = p + 1; i < n_; ++i) std::swap(at(i, next), at(i, p));
  for (Index i = next + 1; i < p; ++i) std::swap(at(i, next), at(p, i));
  std::swap(at(next, next), at(p, p));
  if (next > k) std::swap(at(next, k), at(p, k));
}

void SmallSymmetric::eliminate_one(Index k) {
  values_[to(k)] = at(k, k);
  if (at(k, k) == 0) return;
  const double inverse = 1 / at(k, k);
  for (Index j = k + 1; j < n_; ++j) {
    const double factor = inverse * at(j, k);
    if (factor == 0) continue;
    const double* const l = columns_[to(k)].data();
    double* const column = columns_[to(j)].data();
    for (Index i = j / part * part; i < n_; i += part)
      Part(column + i) -= factor * GivenPart(l + i);
  }
  for (Index i = k + 1; i < n_; ++i) at(i, k) *= inverse;
}

void SmallSymmetric::eliminate_two(Index k) {
  const double a = at(k, k), b = at(k + 1, k), c = at(k + 1, k + 1);
  const double mean = a / 2 + c / 2, radius = std::hypot(a / 2 - c / 2, b);
  const double large = mean >= 0 ? mean + radius : mean - radius;
  values_[to(k)] = large;  // the smaller one from the determinant, without cancellation
  values_[to(k + 1)] = large == 0 ? 0 : (a / large) * c - (b / large) * b;
  const double d11 = c / b, d22 = a / b, factor = 1 / (d11 * d22 - 1) / b;
  for (Index j = k + 2; j < n_; ++j) {
    const double first = factor * (d11 * at(j, k) - at(j, k + 1));
    const double second = factor * (d22 * at(j, k + 1) - at(j, k));
    const double *const l = columns_[to(k)].data(), *const m = columns_[to(k + 1)].data();
    double* const column = columns_[to(j)].data();
    for (Index i = j / part * part; i < n_; i += part)
      Part(column + i) -= GivenPart(l + i) * first + GivenPart(m + i) * second;
    at(j, k) = first;
    at(j, k + 1) = second;
  }
}

bool SmallSymmetric::factorise(const Eigen::Ref<const Matrix>& A) {
  assert(A.rows() == A.cols() && A.rows() <= largest);
  n_ = A.rows();
  double zero = 0;  // NaN where an entry is not finite
  for (Index j = 0; j < n_; ++j) {
    std::fill_n(columns_[to(j)].data(), capacity, 0.0);
    for (Index i = j; i < n_; ++i) {
      at(i, j) = A(i, j);
      zero += 0 * A(i, j);
    }
  }
  if (zero != 0) return false;
  if (n_ > 0) equilibrate();
  for (Index k = 0; k < n_;) {
    const auto [p, two] = pivot_at(k);
    exchange(k, two ? k + 1 : k, p);
    row_[to(k)] = two ? k : p;
    is_two_[to(k)] = two;
    if (two) {
      row_[to(k + 1)] = p;
      is_two_[to(k + 1)] = false;
    }
    two ? eliminate_two(k) : eliminate_one(k);
    k += two ? 2 : 1;
  }
  return true;
}

/// For some columns of X side by side.
template <class Row>
void SmallSymmetric::solve_rows(Row* x) const {
  for (Index k = 0; k < n_;) {
    const bool two = is_two_[to(k)];
    const Index last = two ? k + 1 : k;
    if (const Index other = row_[to(last)]; other != last) std::swap(x[last], x[other]);
    for (Index i = last + 1; i < n_; ++i) {
      x[i] -= at(i, k) * x[k];
      if (two) x[i] -= at(i, k + 1) * x[k + 1];
    }
    if (two) {
      const double b = at(k + 1, k), a = at(k, k) / b, c = at(k + 1, k + 1) / b;
      const Row first = x[k] / b, second = x[k + 1] / b;
      const double determinant = a * c - 1;
      x[k] = (c * first - second) / determinant;
      x[k + 1] = (a * second - first) / determinant;
    } else {
      x[k] /= at(k, k);
    }
    k = last + 1;
  }
  for (Index k = n_; k-- > 0;) {
    const bool two = k > 0 && is_two_[to(k - 1)];
    const Index first = two ? k - 1 : k, last = k;
    for (Index i = last + 1; i < n_; ++i) {
      x[last] -= at(i, last) * x[i];
      if (two) x[first] -= at(i, first) * x[i];
    }
    if (const Index other = row_[to(last)]; other != last) std::swap(x[last], x[other]);
    k = first;
  }
}

void SmallSymmetric::solve(Matrix& X) const {
  assert(X.rows() == n_);
  constexpr Index width = 4;
  using Row = Eigen::Array<double, 1, width>;
  std::array<Row, capacity> rows;
  for (Index first = 0; first < X.cols(); first += width) {
    const Index count = std::min(width, X.cols() - first);
    for (Index i = 0; i < n_; ++i) {
      rows[to(i)].setZero();
      const double factor = scaled_ ? scale_[to(i)] : 1;
      for (Index j = 0; j < count; ++j) rows[to(i)][j] = factor * X(i, first + j);
    }
    solve_rows(rows.data());
    for (Index i = 0; i < n_; ++i) {
      const double factor = scaled_ ? scale_[to(i)] : 1;
      for (Index j = 0; j < count; ++j) X(i, first + j) = factor * rows[to(i)][j];
    }
  }
}

}  // namespace springfold
