#include "dense_root.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace springfold {
namespace {

/// A symmetric matrix from row and column t on.
class Rest {
 public:
  Rest(std::vector<double>& values, Index n) : a_{values.data()}, n_{n} {}
  double& at(Index i, Index j) { return a_[j * n_ + i]; }

  void swap(Index i, Index j) {
    if (i == j) return;
    for (Index k = 0; k < n_; ++k) std::swap(at(k, i), at(k, j));
    for (Index k = 0; k < n_; ++k) std::swap(at(i, k), at(j, k));
  }
  void eliminate_one(Index t) {
    for (Index k = t + 1; k < n_; ++k) {
      const double factor = at(t, k) / at(t, t);
      for (Index i = t + 1; i < n_; ++i) at(i, k) -= factor * at(i, t);
    }
  }
  void eliminate_two(Index t) {
    const double b = at(t + 1, t), p = at(t, t) / b, q = at(t + 1, t + 1) / b;
    const double scale = 1 / (b * (p * q - 1));
    for (Index k = t + 2; k < n_; ++k) {
      const double u = scale * (q * at(t, k) - at(t + 1, k));
      const double v = scale * (p * at(t + 1, k) - at(t, k));
      for (Index i = t + 2; i < n_; ++i) at(i, k) -= u * at(i, t) + v * at(i, t + 1);
    }
  }

 private:
  double* a_;
  Index n_;
};

/// Bunch and Parlett's bound on diagonal over off-diagonal pivots.
constexpr double one_or_two = 0.6403882032022076;  // (1 + sqrt 17) / 8

}  // namespace

void DenseRoot::resize(Index n) {
  size = n;
  values.assign(static_cast<std::size_t>(n * n), 0.0);
  rows.resize(static_cast<std::size_t>(n));
  columns.resize(static_cast<std::size_t>(n));
  work.resize(static_cast<std::size_t>(n));
}

double DenseRoot::factorise() {
  std::iota(rows.begin(), rows.end(), Index{0});
  std::iota(columns.begin(), columns.end(), Index{0});
  double largest = 0, smallest = 0;
  for (Index t = 0; t < size; ++t) {
    Index r = t, c = t;
    for (Index j = t; j < size; ++j)
      for (Index i = t; i < size; ++i)
        if (std::abs(at(i, j)) > std::abs(at(r, c))) {
          r = i;
          c = j;
        }
    for (Index j = 0; r != t && j < size; ++j) std::swap(at(r, j), at(t, j));
    for (Index i = 0; c != t && i < size; ++i) std::swap(at(i, c), at(i, t));
    std::swap(rows[static_cast<std::size_t>(r)], rows[static_cast<std::size_t>(t)]);
    std::swap(columns[static_cast<std::size_t>(c)], columns[static_cast<std::size_t>(t)]);
    const double pivot = at(t, t);
    if (!(std::abs(pivot) > 0)) return 0;  // zero or not a number
    if (t == 0) largest = smallest = std::abs(pivot);
    largest = std::max(largest, std::abs(pivot));
    smallest = std::min(smallest, std::abs(pivot));
    for (Index i = t + 1; i < size; ++i) at(i, t) /= pivot;
    for (Index j = t + 1; j < size; ++j)
      for (Index i = t + 1; i < size; ++i) at(i, j) -= at(i, t) * at(t, j);
  }
  return size == 0 ? 1 : smallest / largest;
}

void DenseRoot::solve(double* x, bool transposed) {
  // A = P^T L U Q^T: first what stands left of it, then the rest.
  const std::vector<Index>& before = transposed ? columns : rows;
  const std::vector<Index>& after = transposed ? rows : columns;
  for (std::size_t i = 0; i < before.size(); ++i) work[i] = x[before[i]];
  double* y = work.data();
  for (Index t = 0; t < size; ++t) {
    if (transposed) y[t] /= at(t, t);
    for (Index i = t + 1; i < size; ++i) y[i] -= (transposed ? at(t, i) : at(i, t)) * y[t];
  }
  for (Index t = size; t-- > 0;) {
    if (!transposed) y[t] /= at(t, t);
    for (Index i = 0; i < t; ++i) y[i] -= (transposed ? at(t, i) : at(i, t)) * y[t];
  }
  for (std::size_t i = 0; i < after.size(); ++i) x[after[i]] = work[i];
}

Inertia inertia_by_pivots(std::vector<double>& values, Index n, double small) {
  Rest rest(values, n);
  Inertia inertia;
  for (Index t = 0; t < n;) {
    Index d = t, r = t, c = t;  // largest diagonal entry, largest other
    double off = 0;
    for (Index j = t; j < n; ++j) {
      if (std::abs(rest.at(j, j)) > std::abs(rest.at(d, d))) d = j;
      for (Index i = j + 1; i < n; ++i)
        if (std::abs(rest.at(i, j)) > off) {
          off = std::abs(rest.at(i, j));
          r = i;
          c = j;
        }
    }
    const double diagonal = std::abs(rest.at(d, d));
    if (std::max(diagonal, off) <= small) {
      inertia.zero += n - t;
      break;
    }
    if (diagonal >= one_or_two * off) {
      rest.swap(t, d);
      ++(rest.at(t, t) < 0 ? inertia.negative : inertia.positive);
      rest.eliminate_one(t);
      t += 1;
    } else {            // its determinant is negative: both diagonal entries are smaller
      rest.swap(t, c);  // c < r: r stays in its place unless it is t, which it is not
      rest.swap(t + 1, r);
      ++inertia.negative;
      ++inertia.positive;
      rest.eliminate_two(t);
      t += 2;
    }
  }
  return inertia;
}

}  // namespace springfold
