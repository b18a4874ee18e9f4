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
using Part = Eigen::Map<Eigen::Array<double, part, 1>, Eigen::Aligned16>;
using GivenPart = Eigen::Map<const Eigen::Array<double, part, 1>, Eigen::Aligned16>;

/// The inverse of the power of two next to sqrt(value).
double inverse_root(double value) { return std::ldexp(1.0, -((std::ilogb(value) + 1) >> 1)); }

}  // namespace

/// Largest entry of every row of the matrix, into `sizes`.
void SmallSymmetric::measure(Column& sizes) const {
  std::fill_n(sizes.begin(), n_, 0.0);
  for (Index j = 0; j < n_; ++j)
    for (Index i = j; i < n_; ++i) {
      const double size = std::abs(at(i, j));
      sizes[to(i)] = std::max(sizes[to(i)], size);
      sizes[to(j)] = std::max(sizes[to(j)], size);
    }
}

/// What equilibrate() in equilibration.hpp does, for a symmetric matrix; in place, the factors in scale_.
void SmallSymmetric::equilibrate() {
  Column sizes, sorted;
  measure(sizes);
  const auto end = static_cast<std::ptrdiff_t>(n_);
  const auto [least, most] = std::minmax_element(sizes.begin(), sizes.begin() + end);
  scaled_ = !(*least * equal_sizes::alike >= *most && *least > 0);
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
    measure(sizes);
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

/// Are the eigenvalues of a pivot of this size at least? @param least  0: any will do
bool SmallSymmetric::is_large(Index k, const Pivot& pivot, double least) const {
  if (least == 0) return true;
  const Index p = pivot.row;
  if (!pivot.two) return std::abs(at(p, p)) >= least;
  const double a = at(k, k), b = at(p, k), c = at(p, p);
  const double radius = std::hypot(a / 2 - c / 2, b), large = std::abs(a / 2 + c / 2) + radius;
  return std::abs(a * c - b * b) >= least * large;
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
  values_[to(k)] = at(k, k);
  if (at(k, k) == 0) return;
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
  const double mean = a / 2 + c / 2, radius = std::hypot(a / 2 - c / 2, b);
  const double large = mean >= 0 ? mean + radius : mean - radius;
  values_[to(k)] = large;  // the smaller one from the determinant, without cancellation
  values_[to(k + 1)] = large == 0 ? 0 : (a / large) * c - (b / large) * b;
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

/// The smallest pivot that is not put off; greater than zero.
double SmallSymmetric::least_of(const PutOff& put_off) const {
  double entry = 0, border = 0;
  for (Index j = 0; j < n_; ++j) {
    for (Index i = j; i < n_; ++i) entry = std::max(entry, std::abs(at(i, j)));
    if (put_off.border)
      border = std::max(border, (scaled_ ? scale_[to(j)] : 1) * std::abs(put_off.border[j]));
  }
  return std::max({put_off.share * entry, put_off.share_of_border * border,
                   std::numeric_limits<double>::min()});
}

/// A pivot that is too small goes to the end, where those are that were too small before.
void SmallSymmetric::eliminate(double least) {
  Index end = n_;
  for (done_ = 0; done_ < end;) {
    const Index k = done_;
    const Pivot pivot = pivot_at(k);
    if (!is_large(k, pivot, least)) {
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

/// Values of R, which stays as it is.
void SmallSymmetric::count_rest() {
  const Index rows = n_ - done_;
  if (rows == 0) return;
  if (rows == 1) {
    values_[to(done_)] = at(done_, done_);
    return;
  }
  SmallSymmetric rest;
  rest.n_ = rows;
  rest.length_ = (rows + part - 1) / part * part;
  for (Index j = 0; j < rows; ++j) {
    std::fill_n(rest.column(j), rest.length_, 0.0);
    for (Index i = j; i < rows; ++i) rest.at(i, j) = at(done_ + i, done_ + j);
  }
  std::fill_n(rest.order_.begin(), rows, Index{0});
  rest.eliminate(0);
  std::copy_n(rest.values_.data(), rows, values_.data() + done_);
}

bool SmallSymmetric::factorise(const Eigen::Ref<const Matrix>& A, const PutOff* put_off) {
  assert(A.rows() == A.cols() && A.rows() <= largest);
  n_ = A.rows();
  length_ = (n_ + part - 1) / part * part;
  done_ = n_;
  double zero = 0;  // NaN where an entry is not finite
  for (Index j = 0; j < n_; ++j) {
    std::fill_n(column(j), length_, 0.0);
    for (Index i = j; i < n_; ++i) {
      at(i, j) = A(i, j);
      zero += 0 * A(i, j);
    }
    order_[to(j)] = j;
  }
  if (zero != 0) return false;
  if (n_ > 0) equilibrate();
  eliminate(put_off ? least_of(*put_off) : 0);
  count_rest();
  return true;
}

template <int width>
void SmallSymmetric::forward(const double* x, double* y) const {
  using Row = Eigen::Map<Eigen::Array<double, 1, width>>;
  using GivenRow = Eigen::Map<const Eigen::Array<double, 1, width>>;
  for (Index i = 0; i < n_; ++i) {
    const Index from = order_[to(i)];
    Row(y + i * width) = (scaled_ ? scale_[to(from)] : 1.0) * GivenRow(x + from * width);
  }
  for (Index k = 0; k < done_;) {
    const bool two = is_two_[to(k)];
    const Row first(y + k * width);
    const double* const l = column(k);
    const Index begin = two ? k + 2 : k + 1;
    for (Index i = begin; i < n_; ++i) Row(y + i * width) -= l[i] * first;
    if (two) {
      const Row second(y + (k + 1) * width);
      const double* const m = column(k + 1);
      for (Index i = begin; i < n_; ++i) Row(y + i * width) -= m[i] * second;
    }
    k = begin;
  }
}

template <int width>
void SmallSymmetric::divide(double* y) const {
  using Row = Eigen::Map<Eigen::Array<double, 1, width>>;
  for (Index k = 0; k < done_; ++k) {
    if (!is_two_[to(k)]) {
      Row(y + k * width) /= at(k, k);
      continue;
    }
    const double b = at(k + 1, k), a = at(k, k) / b, c = at(k + 1, k + 1) / b;
    const double determinant = a * c - 1;
    const Eigen::Array<double, 1, width> first = Row(y + k * width) / b,
                                         second = Row(y + (k + 1) * width) / b;
    Row(y + k * width) = (c * first - second) / determinant;
    Row(y + (k + 1) * width) = (a * second - first) / determinant;
    ++k;
  }
}

template <int width>
void SmallSymmetric::backward(double* y, double* x) const {
  using Row = Eigen::Map<Eigen::Array<double, 1, width>>;
  for (Index k = done_; k-- > 0;) {
    const bool two = k > 0 && is_two_[to(k - 1)];
    Eigen::Array<double, 1, width> last = Row(y + k * width);
    const double* const l = column(k);
    for (Index i = k + 1; i < n_; ++i) last -= l[i] * Row(y + i * width);
    Row(y + k * width) = last;
    if (!two) continue;
    Eigen::Array<double, 1, width> first = Row(y + (k - 1) * width);
    const double* const m = column(k - 1);
    for (Index i = k + 1; i < n_; ++i) first -= m[i] * Row(y + i * width);
    Row(y + (k - 1) * width) = first;
    --k;
  }
  for (Index i = 0; i < n_; ++i) {
    const Index to_row = order_[to(i)];
    Row(x + to_row * width) = (scaled_ ? scale_[to(to_row)] : 1.0) * Row(y + i * width);
  }
}

template void SmallSymmetric::forward<1>(const double*, double*) const;
template void SmallSymmetric::forward<4>(const double*, double*) const;
template void SmallSymmetric::divide<1>(double*) const;
template void SmallSymmetric::divide<4>(double*) const;
template void SmallSymmetric::backward<1>(double*, double*) const;
template void SmallSymmetric::backward<4>(double*, double*) const;

void SmallSymmetric::solve(Matrix& X) const {
  assert(X.rows() == n_ && done_ == n_);
  constexpr int width = 4;
  std::array<double, width * capacity> x, y;
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
