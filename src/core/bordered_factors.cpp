#include "springfold/core/bordered_factors.hpp"

#include <algorithm>
#include <cmath>

#include "equal_sizes.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/equilibration.hpp"
#include "springfold/core/inertia.hpp"
#include "springfold/core/rounding.hpp"
#include "springfold/core/scaling.hpp"

namespace springfold {

/// Columns side by side, row by row.
template <int width>
struct SideBySide {
  alignas(64) std::array<double, static_cast<std::size_t>(width* SmallSymmetric::padded)> numbers;
  double* data() { return numbers.data(); }
};

namespace {

/// Smallest over largest pivot below this counts as singular.
constexpr double least_pivot = few_roundings;

/// Of its largest pivot: eigenvalues of dF/dx below this are zero.
constexpr double zero_eigenvalue = 500 * rounding_unit;

using BorderedRest =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, SmallLu::largest, SmallLu::largest>;

/// The inverse of a power of two next to a size; 1 where that is no number above zero.
double brought_to_one(double size) {
  return size > 0 && std::isfinite(size) ? 1 / power_of_two_near(size) : 1;
}

/// Is this size near enough to that of rows which were brought to one size?
bool is_alike(double size) {
  return size == 0 || (size * equal_sizes::alike >= 1 && size <= equal_sizes::alike);
}

}  // namespace

void BorderedFactors::begin(const Linearisation& at, bool symmetric) {
  at_ = &at;
  n_ = at.dF_dlambda.size();
  factorised_ = finite_ = bordered_ = regular_ = false;
  way_ = at.structured                                ? Way::structured
         : symmetric && n_ <= SmallSymmetric::largest ? Way::symmetric
         : SmallLu::fits(n_ + 1)                      ? Way::small
                                                      : Way::large;
}

bool BorderedFactors::factorise_symmetric() {
  if (factorised_) return finite_;
  factorised_ = true;
  const SmallSymmetric::DelayedPivots delayed{.border = at_->dF_dlambda.data()};
  finite_ = K_.factorise(at_->dF_dx, &delayed);
  if (!finite_) return false;
  if (K_.delayed() >= SmallLu::largest)  // hardly any of its pivots can be used
    way_ = Way::large;
  return true;
}

/// With K = dF/dx, y = L^-1 P S dF/dlambda, z = L^-1 P S row, each in the parts of D_1 and of R, what is left is
///
///     | R      y_2                      |
///     | z_2^T  corner - z_1^T D_1^-1 y_1 |
///
/// The rows of S K S are of one size. Where that looks singular y and z are brought to one size as wholes: stiff
/// members beside soft ones make nothing singular by that alone, and what rounding leaves of R stays small.
bool BorderedFactors::border_symmetric() {
  SideBySide<2> borders, carried;
  for (Index i = 0; i < n_; ++i) {
    borders.data()[2 * i] = at_->dF_dlambda[i];
    borders.data()[2 * i + 1] = row_[i];
  }
  K_.forward<2>(borders.data(), carried.data());
  for (Index i = 0; i < n_; ++i) {
    b_[static_cast<std::size_t>(i)] = carried.data()[2 * i];
    z_[static_cast<std::size_t>(i)] = carried.data()[2 * i + 1];
  }
  const auto largest = [this](const auto& all) {
    double size = 0;
    for (Index i = 0; i < n_; ++i)
      size = std::max(size, std::abs(all[static_cast<std::size_t>(i)]));
    return size;
  };
  const double y_size = largest(b_), z_size = largest(z_);
  K_.divide<1>(b_.data());
  const Index rest = K_.delayed(), done = n_ - rest;
  double corner = corner_, size = std::abs(corner_);
  for (Index i = 0; i < done; ++i) {
    const double part = z_[static_cast<std::size_t>(i)] * b_[static_cast<std::size_t>(i)];
    corner -= part;
    size += std::abs(part);
  }
  if (rest == 0) {
    last_ = corner;
    return std::abs(corner) > least_pivot * size;
  }
  const auto factorise_front = [&](double z_factor, double y_factor) {
    BorderedRest front(rest + 1, rest + 1);
    for (Index j = 0; j < rest; ++j) {
      for (Index i = 0; i < rest; ++i) front(i, j) = K_.rest(i, j);
      front(rest, j) = z_factor * z_[static_cast<std::size_t>(done + j)];
      front(j, rest) = y_factor * b_[static_cast<std::size_t>(done + j)];
    }
    front(rest, rest) = z_factor * y_factor * corner;
    front_factors_ = {z_factor, y_factor};
    front_.emplace(front);
    return front_->smallest_pivot() >
           least_pivot * std::max(front_->largest_pivot(), z_factor * y_factor * size);
  };
  if (factorise_front(1, 1)) return true;
  if (is_alike(y_size) && is_alike(z_size)) return false;
  // The corner's own size counts in its row: it may be what is left of far larger parts.
  const double y_factor = brought_to_one(y_size);
  return factorise_front(brought_to_one(std::max(z_size, y_factor * size)), y_factor);
}

bool BorderedFactors::border_general() {
  storage_.resize(n_ + 1, n_ + 1);
  storage_ << at_->dF_dx, at_->dF_dlambda, row_.transpose(), corner_;
  row_factors_ = Vector::Ones(n_ + 1);
  if (factorise_whole()) return true;
  const Vector sizes = row_sizes_of(storage_);
  if (sizes.minCoeff() * equal_sizes::alike >= sizes.maxCoeff()) return false;
  row_factors_ = sizes.unaryExpr(&brought_to_one);
  storage_.array().colwise() *= row_factors_.array();
  return factorise_whole();
}

bool BorderedFactors::factorise_whole() {
  if (way_ == Way::small) {
    front_.emplace(storage_);
    return front_->smallest_pivot() > least_pivot * front_->largest_pivot();
  }
  large_.compute(storage_);
  return large_.smallest_pivot() > least_pivot * large_.largest_pivot();
}

bool BorderedFactors::set_border(const Vector& weights, const Direction& border) {
  if (way_ == Way::symmetric && !factorise_symmetric()) return false;
  const bool same =
      bordered_ && corner_ == border.dlambda && row_ == weights.cwiseProduct(border.dx);
  if (same) return regular_;
  row_ = weights.cwiseProduct(border.dx);
  corner_ = border.dlambda;
  bordered_ = true;
  if (way_ == Way::symmetric) return regular_ = border_symmetric();
  if (way_ == Way::structured) {
    borders_.B = at_->dF_dlambda;
    borders_.C = row_;
    borders_.D.setConstant(1, 1, corner_);
    return regular_ = true;
  }
  return regular_ = border_general();
}

/// @param only_last  x is zero but for its last row
template <int width>
void BorderedFactors::solve_symmetric(double* x, bool only_last) const {
  using Row = Eigen::Map<Eigen::Array<double, 1, width>>;
  SideBySide<width> y;
  const Index rest = K_.delayed(), done = n_ - rest;
  const auto row = [&](Index i) { return Row(y.data() + i * width); };
  Row last(x + n_ * width);
  if (only_last) {
    Eigen::Map<Eigen::ArrayXd>(y.data(), n_ * width).setZero();
  } else {
    K_.forward<width>(x, y.data());
    K_.divide<width>(y.data());
    for (Index i = 0; i < done; ++i) last -= z_[static_cast<std::size_t>(i)] * row(i);
  }
  if (rest == 0) {
    last /= last_;
  } else {
    std::array<double, static_cast<std::size_t>(SmallLu::largest)> right;
    for (Index c = 0; c < width; ++c) {
      for (Index i = 0; i < rest; ++i) right[static_cast<std::size_t>(i)] = row(done + i)[c];
      right[static_cast<std::size_t>(rest)] = front_factors_[0] * last[c];
      front_->solve(right.data());
      for (Index i = 0; i < rest; ++i) row(done + i)[c] = right[static_cast<std::size_t>(i)];
      last[c] = front_factors_[1] * right[static_cast<std::size_t>(rest)];
    }
  }
  for (Index i = 0; i < done; ++i) row(i) -= b_[static_cast<std::size_t>(i)] * last;
  Eigen::Map<Eigen::Array<double, 4 * width, 1>>(y.data() + n_ * width).setZero();
  K_.backward<width>(y.data(), x);
}

bool BorderedFactors::solve_for_tangent(double* x) {
  std::fill_n(x, n_, 0.0);
  x[n_] = 1;
  if (way_ != Way::symmetric) return solve(x);
  solve_symmetric<1>(x, true);
  return true;
}

bool BorderedFactors::solve(double* x) {
  switch (way_) {
    case Way::symmetric:
      solve_symmetric<1>(x, false);
      return true;
    case Way::small:
      for (Index i = 0; i <= n_; ++i) x[i] *= row_factors_[i];
      front_->solve(x);
      return true;
    case Way::large: {
      Eigen::Map<Vector> solution(x, n_ + 1);
      right_ = solution.cwiseProduct(row_factors_);
      large_.solve(right_, solution);
      return true;
    }
    case Way::structured:
      storage_ = Eigen::Map<const Vector>(x, n_ + 1);
      if (!at_->structured->solve(borders_, storage_, false)) return false;
      std::copy_n(storage_.data(), n_ + 1, x);
      return true;
  }
  return false;
}

void BorderedFactors::invert(std::span<const Index> rows, Matrix& columns) {
  const Index size = n_ + 1, count = static_cast<Index>(rows.size());
  columns.setZero(size, count);
  if (way_ != Way::symmetric) {
    for (Index j = 0; j < count; ++j) {
      const Index row = rows[static_cast<std::size_t>(j)];
      columns(row, j) = row_factors_[row];
    }
    if (way_ == Way::small)
      front_->solve(columns);
    else
      columns = large_.solve(columns);
    return;
  }
  constexpr int width = 4;
  SideBySide<width> x;
  for (Index first = 0; first < count; first += width) {
    std::fill_n(x.data(), width * size, 0.0);
    const Index used = std::min<Index>(width, count - first);
    for (Index j = 0; j < used; ++j)
      x.data()[rows[static_cast<std::size_t>(first + j)] * width + j] = 1;
    solve_symmetric<width>(x.data(), false);
    for (Index j = 0; j < used; ++j)
      for (Index i = 0; i < size; ++i) columns(i, first + j) = x.data()[i * width + j];
  }
}

std::optional<Index> BorderedFactors::negative() {
  if (way_ == Way::symmetric && !factorise_symmetric()) return std::nullopt;
  if (way_ != Way::symmetric) return negative_eigenvalues(*at_);
  std::array<double, capacity> values;
  K_.pivot_values(values.data());
  double largest = 0;
  for (Index i = 0; i < n_; ++i)
    largest = std::max(largest, std::abs(values[static_cast<std::size_t>(i)]));
  Index count = 0;
  for (Index i = 0; i < n_; ++i) {
    const double value = values[static_cast<std::size_t>(i)];
    if (std::abs(value) <= zero_eigenvalue * largest) return std::nullopt;
    count += value < 0;
  }
  return count;
}

}  // namespace springfold
