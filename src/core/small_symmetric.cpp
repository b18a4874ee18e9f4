#include "springfold/core/small_symmetric.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "equal_sizes.hpp"

namespace springfold {
namespace {

/// Columns are worked on in parts of four rows, also where one or the other row is above the diagonal.
constexpr Index part = 4;
using Four = Eigen::Array<double, part, 1>;
using Part = Eigen::Map<Four, Eigen::Aligned16>;
using GivenPart = Eigen::Map<const Four, Eigen::Aligned16>;

/// Zeros from one place up to another, which is less than a part away.
inline void clear(double* c, Index from, Index end) {
  if (from < end) c[from] = 0;
  if (from + 1 < end) c[from + 1] = 0;
  if (from + 2 < end) c[from + 2] = 0;
}

/// Four numbers of a column: their sizes for their rows, and for the column's own.
inline void note_sizes(const Four& four, double* rows, Four& most) {
  const Four size = four.abs();
  Part largest(rows);
  largest = largest.max(size);
  most = most.max(size);
}

/// The inverse of the power of two next to sqrt(value).
double inverse_root(double value) { return std::ldexp(1.0, -((std::ilogb(value) + 1) >> 1)); }

}  // namespace

/// Largest entry of every row of the matrix.
void SmallSymmetric::measure() {
  std::fill_n(sizes_.begin(), length_, 0.0);
  for (Index j = 0; j < n_; ++j) {
    Four most = Four::Zero();
    for (Index i = j / part * part; i < n_; i += part)
      note_sizes(GivenPart(column(j) + i), sizes_.data() + i, most);
    sizes_[to(j)] = std::max(sizes_[to(j)], most.maxCoeff());
  }
}

/// What equilibrate() in equilibration.hpp does, for a symmetric matrix; in place, the factors in scale_.
void SmallSymmetric::equilibrate() {
  Column sorted;
  const Column& sizes = sizes_;
  const auto end = static_cast<std::ptrdiff_t>(n_);
  double least = sizes[0], most = 0;
  for (Index i = 0; i < n_; ++i) {
    least = std::min(least, sizes[to(i)]);
    most = std::max(most, sizes[to(i)]);
  }
  scaled_ = !(least * equal_sizes::alike >= most && least > 0);
  if (!scaled_) return;
  std::fill_n(scale_.begin(), n_, 1.0);
  sorted = sizes;
  std::nth_element(sorted.begin(), sorted.begin() + end / 2, sorted.begin() + end);
  const double floor = equal_sizes::rounding * sorted[to(n_ / 2)];
  std::array<bool, capacity> counts;
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
    measure();
  }
}

/// Which row is exchanged with the next one, or with the one behind it for a pivot of two rows.
SmallSymmetric::Pivot SmallSymmetric::pivot_at(Index k) const {
  const double alpha = (1 + std::sqrt(17.0)) / 8;  // bounds the growth (Bunch, Kaufman 1977)
  const double here = std::abs(at(k, k));
  double largest_below = 0;
  Index p = k;
  for (Index i = k + 1; i < n_; ++i)
    if (std::abs(at(i, k)) > largest_below) {
      largest_below = std::abs(at(i, k));
      p = i;
    }
  if (here >= alpha * largest_below) return {k, false};
  double row = 0;
  for (Index j = k; j < p; ++j) row = std::max(row, std::abs(at(p, j)));
  for (Index i = p + 1; i < n_; ++i) row = std::max(row, std::abs(at(i, p)));
  if (here >= alpha * largest_below * (largest_below / row)) return {k, false};
  return {p, std::abs(at(p, p)) < alpha * row};
}

/// Are the eigenvalues of a pivot large enough for its rows?
bool SmallSymmetric::is_large(Index k, const Pivot& pivot) const {
  const Index p = pivot.row;
  const double least = least_[to(order_[to(p)])];
  if (!pivot.two) return std::abs(at(p, p)) >= least;
  const double a = at(k, k), b = at(p, k), c = at(p, p);
  // |determinant| over the larger eigenvalue is the smaller one, over a bound of it no more than that.
  const double large = std::max(std::abs(a), std::abs(c)) + std::abs(b);
  return std::abs(a * c - b * b) >= std::min(least, least_[to(order_[to(k)])]) * large;
}

/// Rows and columns `next` and p, of what is left and of L; `k` is the first one of a pivot of two rows.
void SmallSymmetric::exchange(Index k, Index next, Index p) {
  if (next == p) return;
  for (Index i = p + 1; i < n_; ++i) std::swap(at(i, next), at(i, p));
  for (Index i = next + 1; i < p; ++i) std::swap(at(i, next), at(p, i));
  std::swap(at(next, next), at(p, p));
  if (next > k) std::swap(at(next, k), at(p, k));
  for (Index j = 0; j < k; ++j) std::swap(at(next, j), at(p, j));
  std::swap(order_[to(next)], order_[to(p)]);
}

void SmallSymmetric::eliminate_one(Index k) {
  if (std::abs(at(k, k)) < std::numeric_limits<double>::min()) return;  // its inverse overflows
  const double inverse = 1 / at(k, k);
  const double* const l = column(k);
  for (Index j = k + 1; j < n_; ++j) {
    const double factor = inverse * at(j, k);
    if (factor == 0) continue;
    double* const c = column(j);
    for (Index i = j / part * part; i < n_; i += part) Part(c + i) -= factor * GivenPart(l + i);
  }
  for (Index i = k + 1; i < n_; ++i) at(i, k) *= inverse;
}

void SmallSymmetric::eliminate_two(Index k) {
  const double a = at(k, k), b = at(k + 1, k), c = at(k + 1, k + 1);
  const double d11 = c / b, d22 = a / b, factor = 1 / (d11 * d22 - 1) / b;
  const double *const l = column(k), *const m = column(k + 1);
  for (Index j = k + 2; j < n_; ++j) {
    const double first = factor * (d11 * at(j, k) - at(j, k + 1));
    const double second = factor * (d22 * at(j, k + 1) - at(j, k));
    double* const to_change = column(j);
    for (Index i = j / part * part; i < n_; i += part)
      Part(to_change + i) -= GivenPart(l + i) * first + GivenPart(m + i) * second;
    at(j, k) = first;
    at(j, k + 1) = second;
  }
}

void SmallSymmetric::set_least(const DelayedPivots& delayed) {
  for (Index i = 0; i < n_; ++i) {
    const double border = delayed.border ? std::abs(delayed.border[i]) : 0;
    least_[to(i)] = std::max({delayed.share * sizes_[to(i)],
                              delayed.share_of_border * (scaled_ ? scale_[to(i)] : 1) * border,
                              std::numeric_limits<double>::min()});
  }
}

/// A pivot that is too small goes to the end, where those are that were too small before.
void SmallSymmetric::eliminate(bool may_delay) {
  Index end = n_;
  for (done_ = 0; done_ < end;) {
    const Index k = done_;
    const Pivot pivot = pivot_at(k);
    if (may_delay && !is_large(k, pivot)) {
      exchange(k, k, --end);
      continue;
    }
    exchange(k, pivot.two ? k + 1 : k, pivot.row);
    is_two_[to(k)] = pivot.two;
    if (pivot.two) is_two_[to(k + 1)] = false;
    pivot.two ? eliminate_two(k) : eliminate_one(k);
    done_ += pivot.two ? 2 : 1;
  }
}

void SmallSymmetric::pivot_values(double* values) const {
  for (Index k = 0; k < done_; ++k) {
    if (!is_two_[to(k)]) {
      values[k] = at(k, k);
      continue;
    }
    const double a = at(k, k), b = at(k + 1, k), c = at(k + 1, k + 1);
    const double mean = a / 2 + c / 2, radius = std::hypot(a / 2 - c / 2, b);
    const double large = mean >= 0 ? mean + radius : mean - radius;
    values[k] = large;  // the smaller one from the determinant, without cancellation
    values[++k] = large == 0 ? 0 : (a / large) * c - (b / large) * b;
  }
  if (n_ - done_ == 1) values[done_] = at(done_, done_);
  if (n_ - done_ > 1) rest_values(values + done_);
}

/// Values of R, which stays as it is; apart, so that only this needs the storage of a second one.
[[gnu::noinline]] void SmallSymmetric::rest_values(double* values) const {
  const Index rows = n_ - done_;
  SmallSymmetric rest;
  rest.begin(rows);
  for (Index j = 0; j < rows; ++j) {
    std::fill_n(rest.column(j), rest.length_, 0.0);
    std::copy_n(column(done_ + j) + done_ + j, rows - j, rest.column(j) + j);
  }
  rest.eliminate(false);
  rest.pivot_values(values);
}

void SmallSymmetric::begin(Index n) {
  n_ = n;
  length_ = (n + part - 1) / part * part;
  if (entries_.size() < n * length_) entries_.resize(n * length_);
  for (Index i = 0; i < n; ++i) order_[to(i)] = i;
}

bool SmallSymmetric::factorise(const Eigen::Ref<const Matrix>& A, const DelayedPivots* delayed) {
  assert(A.rows() == A.cols() && A.rows() <= largest);
  begin(A.rows());
  Four zero = Four::Zero();  // NaN where an entry is not finite
  std::fill_n(sizes_.begin(), length_, 0.0);
  for (Index j = 0; j < n_; ++j) {
    double* const c = column(j);
    const Index first = j / part * part;
    std::copy_n(A.col(j).data(), n_, c);  // further above the diagonal nothing is looked at
    clear(c, first, j);
    clear(c, n_, length_);
    Four most = Four::Zero();
    for (Index i = first; i < n_; i += part) {
      const Four four = GivenPart(c + i);
      zero += 0 * four;
      note_sizes(four, sizes_.data() + i, most);
    }
    sizes_[to(j)] = std::max(sizes_[to(j)], most.maxCoeff());
  }
  if (zero.sum() != 0) return false;
  if (n_ > 0) equilibrate();
  if (delayed) set_least(*delayed);
  eliminate(delayed != nullptr);
  return true;
}

namespace {

template <int width>
using Row = Eigen::Map<Eigen::Array<double, 1, width>>;
template <int width>
using GivenRow = Eigen::Map<const Eigen::Array<double, 1, width>>;

/// Rows begin...n of y less those of l times a row.
template <int width>
void subtract(const double* l, const Eigen::Array<double, 1, width>& row, Index begin, Index n,
              double* y) {
  if constexpr (width == 1) {
    const Index whole = std::min((begin + part - 1) / part * part, n);
    for (Index i = begin; i < whole; ++i) y[i] -= l[i] * row[0];
    for (Index i = whole; i < n; i += part) Part(y + i) -= GivenPart(l + i) * row[0];
  } else {
    for (Index i = begin; i < n; ++i) Row<width>(y + i * width) -= l[i] * row;
  }
}

/// Sum of the rows begin...n of y times those of l.
template <int width>
[[gnu::always_inline]] inline Eigen::Array<double, 1, width> sum(const double* l, const double* y,
                                                                 Index begin, Index n) {
  Eigen::Array<double, 1, width> result = Eigen::Array<double, 1, width>::Zero();
  if constexpr (width == 1) {
    const Index whole = std::min((begin + part - 1) / part * part, n);
    Eigen::Array<double, part, 1> parts = Eigen::Array<double, part, 1>::Zero();
    for (Index i = whole; i < n; i += part) parts += GivenPart(l + i) * GivenPart(y + i);
    result[0] = parts.sum();
    for (Index i = begin; i < whole; ++i) result[0] += l[i] * y[i];
  } else {
    for (Index i = begin; i < n; ++i) result += l[i] * GivenRow<width>(y + i * width);
  }
  return result;
}

}  // namespace

template <int width>
void SmallSymmetric::forward(const double* x, double* y) const {
  for (Index i = 0; i < n_; ++i)
    Row<width>(y + i * width) = GivenRow<width>(x + order_[to(i)] * width);
  if (scaled_)
    for (Index i = 0; i < n_; ++i) Row<width>(y + i * width) *= scale_[to(order_[to(i)])];
  if constexpr (width == 1) Eigen::Map<Four>(y + n_).setZero();  // columns of L go on like that
  for (Index k = 0; k < done_;) {
    const Index begin = is_two_[to(k)] ? k + 2 : k + 1;
    for (; k < begin; ++k) {
      const Eigen::Array<double, 1, width> row = Row<width>(y + k * width);
      subtract<width>(column(k), row, begin, n_, y);
    }
  }
}

template <int width>
void SmallSymmetric::divide(double* y) const {
  for (Index k = 0; k < done_; ++k) {
    if (!is_two_[to(k)]) {
      Row<width>(y + k * width) /= at(k, k);
      continue;
    }
    const double b = at(k + 1, k), a = at(k, k) / b, c = at(k + 1, k + 1) / b;
    const double determinant = a * c - 1;
    const Eigen::Array<double, 1, width> first = Row<width>(y + k * width) / b,
                                         second = Row<width>(y + (k + 1) * width) / b;
    Row<width>(y + k * width) = (c * first - second) / determinant;
    Row<width>(y + (k + 1) * width) = (a * second - first) / determinant;
    ++k;
  }
}

template <int width>
void SmallSymmetric::backward(double* y, double* x) const {
  for (Index k = done_; k-- > 0;) {
    const Index begin = k + 1;
    Row<width>(y + k * width) -= sum<width>(column(k), y, begin, n_);
    if (k == 0 || !is_two_[to(k - 1)]) continue;
    --k;
    Row<width>(y + k * width) -= sum<width>(column(k), y, begin, n_);
  }
  for (Index i = 0; i < n_; ++i)
    Row<width>(x + order_[to(i)] * width) = GivenRow<width>(y + i * width);
  if (scaled_)
    for (Index i = 0; i < n_; ++i) Row<width>(x + i * width) *= scale_[to(i)];
}

template void SmallSymmetric::forward<2>(const double*, double*) const;
template void SmallSymmetric::forward<1>(const double*, double*) const;
template void SmallSymmetric::forward<4>(const double*, double*) const;
template void SmallSymmetric::divide<1>(double*) const;
template void SmallSymmetric::divide<4>(double*) const;
template void SmallSymmetric::backward<1>(double*, double*) const;
template void SmallSymmetric::backward<4>(double*, double*) const;

void SmallSymmetric::solve(Matrix& X) const {
  assert(X.rows() == n_ && done_ == n_);
  constexpr int width = 4;
  alignas(64) std::array<double, static_cast<std::size_t>(width * padded)> x, y;
  for (Index first = 0; first < X.cols(); first += width) {
    const Index count = std::min<Index>(width, X.cols() - first);
    for (Index i = 0; i < n_; ++i)
      for (Index j = 0; j < width; ++j) x[to(i * width + j)] = j < count ? X(i, first + j) : 0;
    forward<width>(x.data(), y.data());
    divide<width>(y.data());
    backward<width>(y.data(), x.data());
    for (Index i = 0; i < n_; ++i)
      for (Index j = 0; j < count; ++j) X(i, first + j) = x[to(i * width + j)];
  }
}

}  // namespace springfold
