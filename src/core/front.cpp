#include "front.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace springfold {
namespace {

/// A 2x2 block whose determinant is smaller than this against its terms has lost its digits.
constexpr double cancelled = 1e-4;

struct Choice {
  Index first = -1, second = -1;
};

/// Largest entries of column j: among the candidates t, ..., and among all rows from t on; the
/// diagonal and row `without` do not count.
struct ColumnSize {
  double candidates = 0, all = 0;
  Index row = -1;  ///< of the largest candidate
};

ColumnSize column_size(const Front& front, Index t, Index j, Index without) {
  const double* column = front.values.data() + j * front.size;
  ColumnSize size;
  for (Index i = t; i < front.candidates; ++i) {
    const double v = std::abs(column[i]);
    if (i == j || i == without || !(v > size.candidates)) continue;
    size.candidates = v;
    size.row = i;
  }
  size.all = size.candidates;
  for (Index i = front.candidates; i < front.size; ++i)
    size.all = std::max(size.all, std::abs(column[i]));
  return size;
}

/// The tests of one choice of pivots.
class Test {
 public:
  Test(const Front& front, const BorderRows& borders, Index t, double threshold,
       double border_threshold, double smallest)
      : front_{front},
        borders_{borders},
        t_{t},
        threshold_{threshold},
        smallest_{smallest},
        border_weight_{border_threshold / threshold} {}

  Choice of(Index j) const {
    const ColumnSize column = column_size(front_, t_, j, -1);
    const double a = at(j, j), border = border_of(j);
    const double others = std::max(column.all, border);
    if (std::abs(a) >= threshold_ * others && std::abs(a) >= smallest_) return {j, -1};
    const Index r = column.row;
    if (r < 0) return {};
    return two_fit(j, r, border) ? Choice{j, r} : Choice{};
  }

 private:
  double at(Index i, Index j) const {
    return front_.values[static_cast<std::size_t>(i + j * front_.size)];
  }
  double border_of(Index j) const {
    if (borders_.count == 0 || border_weight_ == 0) return 0;
    return border_weight_ * borders_.size_of(front_.ids[static_cast<std::size_t>(j)]);
  }
  /// Multipliers | x  y | D^-1 with | x | <= others_j, | y | <= others_r.
  bool two_fit(Index j, Index r, double border) const {
    const double a = at(j, j), b = at(r, j), c = at(r, r), det = a * c - b * b;
    const double terms = std::abs(a * c) + b * b;
    const double limit = std::abs(det) / threshold_;
    if (!(std::abs(det) >= cancelled * terms)) return false;
    if (!(std::abs(det) >= smallest_ * (std::abs(a) + std::abs(b) + std::abs(c)))) return false;
    const double x = std::max(column_size(front_, t_, j, r).all, border);
    const double y = std::max(column_size(front_, t_, r, j).all, border_of(r));
    return std::abs(c) * x + std::abs(b) * y <= limit && std::abs(b) * x + std::abs(a) * y <= limit;
  }

  const Front& front_;
  const BorderRows& borders_;
  Index t_;
  double threshold_, smallest_, border_weight_;
};

void swap_variables(Front& front, Index i, Index j) {
  if (i == j) return;
  const Index n = front.size;
  double* a = front.values.data();
  std::swap_ranges(a + i * n, a + (i + 1) * n, a + j * n);
  for (Index c = 0; c < n; ++c) std::swap(a[i + c * n], a[j + c * n]);  // rows of L as well
  std::swap(front.ids[static_cast<std::size_t>(i)], front.ids[static_cast<std::size_t>(j)]);
}

void pivot_one(Front& front, Index t, BorderRows& borders) {
  const Index n = front.size;
  double* a = front.values.data();
  double* l = a + t * n;
  const double d = l[t];
  for (Index k = t + 1; k < n; ++k) {
    double* column = a + k * n;
    const double factor = column[t] / d;
    for (Index i = t + 1; i < n; ++i) column[i] -= factor * l[i];
  }
  for (Index i = t + 1; i < n; ++i) l[i] /= d;
  front.two.push_back(0);
  if (borders.count == 0) return;
  const double* pivot = borders.of(front.ids[static_cast<std::size_t>(t)]);
  for (Index i = t + 1; i < n; ++i) {
    double* row = borders.of(front.ids[static_cast<std::size_t>(i)]);
    for (Index c = 0; c < 2 * borders.count; ++c) row[c] -= l[i] * pivot[c];
  }
}

void pivot_two(Front& front, Index t, BorderRows& borders) {
  const Index n = front.size;
  double* values = front.values.data();
  double *x = values + t * n, *y = x + n;
  // D^-1 through the larger off-diagonal entry: no square of it is formed.
  const double b = x[t + 1], a = x[t] / b, c = y[t + 1] / b, scale = 1 / (b * (a * c - 1));
  for (Index k = t + 2; k < n; ++k) {
    double* column = values + k * n;
    const double u = scale * (c * column[t] - column[t + 1]);
    const double v = scale * (a * column[t + 1] - column[t]);
    for (Index i = t + 2; i < n; ++i) column[i] -= u * x[i] + v * y[i];
  }
  for (Index i = t + 2; i < n; ++i) {
    const double u = scale * (c * x[i] - y[i]), v = scale * (a * y[i] - x[i]);
    x[i] = u;
    y[i] = v;
  }
  front.two.push_back(1);
  front.two.push_back(2);
  if (borders.count == 0) return;
  const double* first = borders.of(front.ids[static_cast<std::size_t>(t)]);
  const double* second = borders.of(front.ids[static_cast<std::size_t>(t + 1)]);
  for (Index i = t + 2; i < n; ++i) {
    double* row = borders.of(front.ids[static_cast<std::size_t>(i)]);
    for (Index k = 0; k < 2 * borders.count; ++k) row[k] -= x[i] * first[k] + y[i] * second[k];
  }
}

/// The first candidate from t on that will do; nothing if none does.
Choice first_of(const Front& front, Index t, const Test& test) {
  for (Index j = t; j < front.candidates; ++j)
    if (const Choice choice = test.of(j); choice.first >= 0) return choice;
  return {};
}

/// The tests get milder the more variables would have to wait.
Choice choose(const Front& front, const BorderRows& borders, const FrontalOptions& options,
              Index t) {
  const auto with = [&](double threshold, double border_threshold) {
    return first_of(front, t,
                    {front, borders, t, threshold, border_threshold, options.smallest_pivot});
  };
  Choice choice = with(options.threshold, options.border_threshold);
  const Index waiting = front.candidates - t;
  if (choice.first < 0 && waiting > options.few)
    choice = with(options.relaxed, options.border_threshold);
  if (choice.first < 0 && waiting > options.many) choice = with(options.relaxed, 0);
  return choice;
}

}  // namespace

double BorderRows::size_of(Index id) const {
  const double* row = of(id);
  double size = 0;
  for (Index c = 0; c < 2 * count; ++c)
    size = std::max(size, std::abs(row[c]) * scale[static_cast<std::size_t>(c)]);
  return size;
}

void FrontFactors::clear() {
  fronts.clear();
  ids.clear();
  L.clear();
  D.clear();
  two.clear();
}

Index eliminate(Front& front, BorderRows& borders, const FrontalOptions& options) {
  front.two.clear();
  Index t = 0;
  while (t < front.candidates) {
    const Choice choice = choose(front, borders, options, t);
    if (choice.first < 0) break;
    if (choice.second < 0) {
      swap_variables(front, t, choice.first);
      pivot_one(front, t, borders);
      t += 1;
      continue;
    }
    // first < second or second < first: neither is lost by the first exchange.
    swap_variables(front, t, choice.first);
    const Index second = choice.second == t ? choice.first : choice.second;
    swap_variables(front, t + 1, second);
    pivot_two(front, t, borders);
    t += 2;
  }
  return t;
}

void keep(const Front& front, Index pivots, FrontFactors& factors) {
  const Index n = front.size;
  factors.fronts.push_back({n, pivots, factors.ids.size(), factors.L.size(), factors.D.size() / 2});
  factors.ids.insert(factors.ids.end(), front.ids.begin(), front.ids.begin() + n);
  factors.L.insert(factors.L.end(), front.values.begin(), front.values.begin() + n * pivots);
  factors.two.insert(factors.two.end(), front.two.begin(), front.two.end());
  for (Index t = 0; t < pivots; ++t) {
    const double* column = front.values.data() + t * n;
    factors.D.push_back(column[t]);
    factors.D.push_back(front.two[static_cast<std::size_t>(t)] == 1 ? column[t + 1] : 0.0);
  }
}

namespace {

/// `width` columns side by side, or, if it is zero, as many as there are.
template <Index width>
void forward_in(const FrontFactors& factors, std::size_t f, double* right, Index stride,
                Index columns) {
  if (width > 0) stride = columns = width;
  const FrontFactors::Front& front = factors.fronts[f];
  const Index* ids = factors.ids.data() + front.ids;
  for (Index t = 0; t < front.pivots; ++t) {
    const double* l = factors.L.data() + front.L + t * front.size;
    const bool first_of_two = factors.two[front.D + static_cast<std::size_t>(t)] == 1;
    const double* pivot = right + ids[t] * stride;
    for (Index i = t + (first_of_two ? 2 : 1); i < front.size; ++i) {
      double* row = right + ids[i] * stride;
      for (Index c = 0; c < columns; ++c) row[c] -= l[i] * pivot[c];
    }
  }
}

template <Index width>
void backward_in(const FrontFactors& factors, std::size_t f, double* right, Index stride,
                 Index columns) {
  if (width > 0) stride = columns = width;
  const FrontFactors::Front& front = factors.fronts[f];
  const Index* ids = factors.ids.data() + front.ids;
  for (Index t = front.pivots; t-- > 0;) {
    const double* l = factors.L.data() + front.L + t * front.size;
    const bool first_of_two = factors.two[front.D + static_cast<std::size_t>(t)] == 1;
    double* pivot = right + ids[t] * stride;
    std::array<double, width> sum;
    std::copy_n(pivot, width, sum.begin());
    double* to = width > 0 ? sum.data() : pivot;
    for (Index i = t + (first_of_two ? 2 : 1); i < front.size; ++i) {
      const double* row = right + ids[i] * stride;
      for (Index c = 0; c < columns; ++c) to[c] -= l[i] * row[c];
    }
    std::copy_n(sum.begin(), width, pivot);
  }
}

}  // namespace

void forward(const FrontFactors& factors, std::size_t f, double* right, Index stride,
             Index columns) {
  if (stride == 1 && columns == 1) return forward_in<1>(factors, f, right, stride, columns);
  if (stride == 2 && columns == 2) return forward_in<2>(factors, f, right, stride, columns);
  forward_in<0>(factors, f, right, stride, columns);
}

void backward(const FrontFactors& factors, std::size_t f, double* right, Index stride,
              Index columns) {
  if (stride == 1 && columns == 1) return backward_in<1>(factors, f, right, stride, columns);
  backward_in<0>(factors, f, right, stride, columns);
}

void divide(const FrontFactors& factors, std::size_t f, double* right, Index stride,
            Index columns) {
  const FrontFactors::Front& front = factors.fronts[f];
  const Index* ids = factors.ids.data() + front.ids;
  for (Index t = 0; t < front.pivots; ++t) {
    const double* D = factors.D.data() + 2 * (front.D + static_cast<std::size_t>(t));
    double* x = right + ids[t] * stride;
    if (factors.two[front.D + static_cast<std::size_t>(t)] == 0) {
      for (Index c = 0; c < columns; ++c) x[c] /= D[0];
      continue;
    }
    double* y = right + ids[++t] * stride;
    const double b = D[1], p = D[0] / b, q = D[2] / b, scale = 1 / (b * (p * q - 1));
    for (Index c = 0; c < columns; ++c) {
      const double u = x[c], v = y[c];
      x[c] = scale * (q * u - v);
      y[c] = scale * (p * v - u);
    }
  }
}

void add_to_corner(const FrontFactors& factors, std::size_t f, BorderRows& borders) {
  const Index k = borders.count;
  if (k == 0) return;
  const FrontFactors::Front& front = factors.fronts[f];
  const Index* ids = factors.ids.data() + front.ids;
  const auto add = [&](const double* B, const double* C, double weight) {
    for (Index c = 0; c < k; ++c)
      for (Index r = 0; r < k; ++r) borders.corner(r, c) -= weight * C[k + r] * B[c];
  };
  for (Index t = 0; t < front.pivots; ++t) {
    const double* D = factors.D.data() + 2 * (front.D + static_cast<std::size_t>(t));
    const double* x = borders.of(ids[t]);
    if (factors.two[front.D + static_cast<std::size_t>(t)] == 0) {
      add(x, x, 1 / D[0]);
      continue;
    }
    const double* y = borders.of(ids[++t]);
    const double b = D[1], p = D[0] / b, q = D[2] / b, scale = 1 / (b * (p * q - 1));
    add(x, x, scale * q);
    add(y, y, scale * p);
    add(x, y, -scale);
    add(y, x, -scale);
  }
}

}  // namespace springfold
