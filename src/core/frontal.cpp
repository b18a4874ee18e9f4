#include "springfold/core/frontal.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "dense_root.hpp"
#include "front.hpp"
#include "frontal_plan.hpp"
#include "springfold/core/scaling.hpp"

namespace springfold {
namespace {

/// Smallest over largest pivot of the root below this counts as singular.
constexpr double singular_pivot = 1e-15;

double* data_of(Matrix& X, Index column) { return X.data() + column * X.rows(); }

}  // namespace

void add_front(FrontalPattern& pattern, std::span<const Index> variables, bool ends_string) {
  pattern.variables.insert(pattern.variables.end(), variables.begin(), variables.end());
  pattern.first_variable.push_back(pattern.variables.size());
  pattern.first_value.push_back(pattern.first_value.back() + variables.size() * variables.size());
  pattern.ends_string.push_back(ends_string ? 1 : 0);
}

struct Frontal::State {
  FrontalPattern pattern;
  FrontalOptions options;
  Plans plans{};
  FrontFactors factors{};
  BorderRows borders{};
  Vector row_scale{}, column_scale{};  ///< of the borders
  Front front{};
  std::vector<double> carried{};  ///< what the last front left, square
  std::vector<Index> waiting_ids{}, places{};

  /// What the strings leave for the root: variables, and a square matrix for each string.
  std::vector<Index> left_ids{};
  std::vector<double> left_values{};
  std::vector<Index> left_sizes{};

  std::vector<Index> root_ids{}, slots{};
  Index rest = 0;                               ///< variables in the root
  std::vector<double> schur{};                  ///< of A, square
  DenseRoot root{};                             ///< with borders
  std::vector<double> right{}, inertia_work{};  ///< scratch
  bool regular = false;
  Index largest_front = 0;
  double growth = 0;

  void scale_borders(const FrontalBorders& given);
  bool start_borders(const FrontalBorders& given);
  void assemble(std::size_t f, const std::vector<double>& values);
  bool front_is_finite() const {
    return std::all_of(front.values.begin(), front.values.end(),
                       [](double value) { return std::isfinite(value); });
  }
  void leave(std::size_t f, Index pivots);
  void build_schur(const Matrix& given);
  void factorise_root();
  bool solve(Matrix& X, bool transposed);
};

/// Powers of two that make the largest entry of each border about one, corner included: what of a border
/// is nothing but rounding must not be blown up.
void Frontal::State::scale_borders(const FrontalBorders& given) {
  const Index k = given.B.cols(), n = pattern.size;
  const auto largest = [n](const auto& border) {
    return n > 0 ? border.cwiseAbs().maxCoeff() : 0.0;
  };
  column_scale.setOnes(k);
  row_scale.setOnes(k);
  const auto rows = [&] {
    for (Index r = 0; r < k; ++r) {
      double size = largest(given.C.col(r));
      for (Index c = 0; c < k; ++c)
        size = std::max(size, std::abs(given.D(r, c)) * column_scale[c]);
      row_scale[r] = 1 / power_of_two_near(size);
    }
  };
  rows();
  for (Index c = 0; c < k; ++c) {
    double size = largest(given.B.col(c));
    for (Index r = 0; r < k; ++r) size = std::max(size, std::abs(given.D(r, c)) * row_scale[r]);
    column_scale[c] = 1 / power_of_two_near(size);
  }
  rows();
}

/// Borders with their corner, scaled.
bool Frontal::State::start_borders(const FrontalBorders& given) {
  const Index k = given.B.cols(), n = pattern.size;
  assert(given.C.cols() == k && (k == 0 || (given.B.rows() == n && given.C.rows() == n)));
  assert(given.D.rows() == k && given.D.cols() == k);
  if (!given.B.allFinite() || !given.C.allFinite() || !given.D.allFinite()) return false;
  borders.count = k;
  borders.scale.assign(static_cast<std::size_t>(2 * k), 1.0);
  scale_borders(given);
  borders.rows.resize(static_cast<std::size_t>(2 * k * n));
  for (Index c = 0; c < k; ++c) {
    for (Index i = 0; i < n; ++i) {
      borders.of(i)[c] = given.B(i, c) * column_scale[c];
      borders.of(i)[k + c] = given.C(i, c) * row_scale[c];
    }
  }
  borders.corner = row_scale.asDiagonal() * given.D * column_scale.asDiagonal();
  return true;
}

/// The front's own matrix and what the front before it left: waiting variables, staying ones.
void Frontal::State::assemble(std::size_t f, const std::vector<double>& values) {
  const Plan& plan = plans.fronts[f];
  const auto waiting = static_cast<Index>(waiting_ids.size());
  front.size = plan.ending + waiting + plan.staying;
  front.candidates = plan.ending + waiting;
  largest_front = std::max(largest_front, front.size);
  const Index n = front.size;
  front.values.assign(static_cast<std::size_t>(n * n), 0.0);
  const Index* ids = plans.ids.data() + plan.ids;
  front.ids.assign(ids, ids + plan.ending);
  front.ids.insert(front.ids.end(), waiting_ids.begin(), waiting_ids.end());
  front.ids.insert(front.ids.end(), ids + plan.ending, ids + plan.ending + plan.staying);

  const auto shifted = [&](Index place) { return place < plan.ending ? place : place + waiting; };
  places.clear();
  for (Index i = 0; i < waiting; ++i) places.push_back(plan.ending + i);
  const std::size_t first = plans.first_carried[f];
  const std::size_t end =
      f + 1 < plans.fronts.size() ? plans.first_carried[f + 1] : plans.carried_places.size();
  for (std::size_t i = first; i < end; ++i) places.push_back(shifted(plans.carried_places[i]));
  const auto m = static_cast<Index>(places.size());
  for (Index c = 0; c < m; ++c) {
    double* column = front.values.data() + places[static_cast<std::size_t>(c)] * n;
    for (Index r = 0; r < m; ++r)
      column[places[static_cast<std::size_t>(r)]] = carried[static_cast<std::size_t>(c * m + r)];
  }
  const std::size_t at = pattern.first_variable[f];
  const auto size = static_cast<Index>(pattern.first_variable[f + 1] - at);
  const double* element = values.data() + pattern.first_value[f];
  places.clear();
  for (Index i = 0; i < size; ++i)
    places.push_back(shifted(plans.element_places[at + static_cast<std::size_t>(i)]));
  for (Index c = 0; c < size; ++c) {
    const Index to = places[static_cast<std::size_t>(c)];
    front.values[static_cast<std::size_t>(to * n + to)] += element[c * size + c];
    for (Index r = c + 1; r < size; ++r) {
      const Index row = places[static_cast<std::size_t>(r)];
      const double value = element[c * size + r];
      front.values[static_cast<std::size_t>(to * n + row)] += value;
      front.values[static_cast<std::size_t>(row * n + to)] += value;
    }
  }
}

/// Hands what is not eliminated to the next front, or to the root.
void Frontal::State::leave(std::size_t f, Index pivots) {
  const Index n = front.size, left = n - pivots;
  const bool ends = pattern.ends_string[f] != 0;
  std::vector<double>& to = ends ? left_values : carried;
  if (!ends) carried.clear();
  for (Index c = pivots; c < n; ++c) {
    const double* column = front.values.data() + c * n;
    to.insert(to.end(), column + pivots, column + n);
  }
  waiting_ids.clear();
  if (ends) {
    left_ids.insert(left_ids.end(), front.ids.begin() + pivots, front.ids.end());
    left_sizes.push_back(left);
  } else {
    waiting_ids.assign(front.ids.begin() + pivots, front.ids.begin() + front.candidates);
  }
}

void Frontal::State::build_schur(const Matrix& given) {
  const Index first = pattern.root_first, count = pattern.root_count;
  root_ids = plans.loose;
  for (const Index id : left_ids)
    if (id < first || id >= first + count) root_ids.push_back(id);
  for (Index i = 0; i < count; ++i) root_ids.push_back(first + i);
  for (std::size_t i = 0; i < root_ids.size(); ++i)
    slots[static_cast<std::size_t>(root_ids[i])] = static_cast<Index>(i);
  rest = static_cast<Index>(root_ids.size());
  schur.assign(static_cast<std::size_t>(rest * rest), 0.0);
  const auto entry = [&](Index row, Index column) -> double& {
    return schur[static_cast<std::size_t>(column * rest + row)];
  };
  for (Index c = 0; c < count; ++c)
    for (Index r = 0; r < count; ++r) entry(rest - count + r, rest - count + c) = given(r, c);
  const Index* ids = left_ids.data();
  const double* values = left_values.data();
  for (const Index n : left_sizes) {
    for (Index c = 0; c < n; ++c)
      for (Index r = 0; r < n; ++r)
        entry(slots[static_cast<std::size_t>(ids[r])], slots[static_cast<std::size_t>(ids[c])]) +=
            values[c * n + r];
    ids += n;
    values += n * n;
  }
}

void Frontal::State::factorise_root() {
  const Index n = rest, k = borders.count;
  root.resize(n + k);
  for (Index c = 0; c < n; ++c)
    for (Index r = 0; r < n; ++r) root.at(r, c) = schur[static_cast<std::size_t>(c * n + r)];
  for (Index i = 0; i < n; ++i) {
    const double* row = borders.of(root_ids[static_cast<std::size_t>(i)]);
    for (Index c = 0; c < k; ++c) {
      root.at(i, n + c) = row[c];
      root.at(n + c, i) = row[k + c];
    }
  }
  for (Index c = 0; c < k; ++c)
    for (Index r = 0; r < k; ++r) root.at(n + r, n + c) = borders.corner(r, c);
  growth = 0;
  for (const double entry : borders.rows) growth = std::max(growth, std::abs(entry));
  for (std::size_t f = 0; k > 0 && f < factors.fronts.size(); ++f)
    divide(factors, f, borders.rows.data(), 2 * k, 2 * k);
  regular = root.factorise() > singular_pivot;
}

bool Frontal::State::solve(Matrix& X, bool transposed) {
  const Index k = borders.count, n = rest;
  assert(X.rows() == pattern.size + k);
  if (!regular) return false;
  const Index B = transposed ? k : 0, C = transposed ? 0 : k;  // where they begin in a border row
  const Vector& before = transposed ? column_scale : row_scale;
  const Vector& after = transposed ? row_scale : column_scale;
  right.resize(static_cast<std::size_t>(n + k));
  for (Index column = 0; column < X.cols(); ++column) {
    double* x = data_of(X, column);
    double* corner = x + pattern.size;
    for (Index c = 0; c < k; ++c) corner[c] *= before[c];
    for (std::size_t f = 0; f < factors.fronts.size(); ++f) {
      forward(factors, f, x, 1, 1);
      const FrontFactors::Front& front_of = factors.fronts[f];
      for (Index t = 0; k > 0 && t < front_of.pivots; ++t) {
        const Index id = factors.ids[front_of.ids + static_cast<std::size_t>(t)];
        for (Index c = 0; c < k; ++c) corner[c] -= borders.of(id)[C + c] * x[id];
      }
      divide(factors, f, x, 1, 1);
    }
    double* rhs = right.data();
    for (Index i = 0; i < n; ++i) rhs[i] = x[root_ids[static_cast<std::size_t>(i)]];
    for (Index c = 0; c < k; ++c) rhs[n + c] = corner[c];
    root.solve(rhs, transposed);
    for (Index i = 0; i < n; ++i) x[root_ids[static_cast<std::size_t>(i)]] = rhs[i];
    for (std::size_t f = factors.fronts.size(); f-- > 0;) {
      const FrontFactors::Front& front_of = factors.fronts[f];
      for (Index t = 0; k > 0 && t < front_of.pivots; ++t) {
        const Index id = factors.ids[front_of.ids + static_cast<std::size_t>(t)];
        for (Index c = 0; c < k; ++c) x[id] -= borders.of(id)[B + c] * rhs[n + c];
      }
      backward(factors, f, x, 1, 1);
    }
    for (Index c = 0; c < k; ++c) corner[c] = rhs[n + c] * after[c];
  }
  return X.allFinite();
}

Frontal::Frontal(FrontalPattern pattern, FrontalOptions options)
    : state_{std::make_unique<State>(State{.pattern = std::move(pattern), .options = options})} {
  assert(state_->pattern.ends_string.empty() || state_->pattern.ends_string.back() != 0);
  state_->plans = plan_fronts(state_->pattern);
  state_->slots.assign(static_cast<std::size_t>(state_->pattern.size), -1);
}
Frontal::~Frontal() = default;
Frontal::Frontal(Frontal&&) noexcept = default;
Frontal& Frontal::operator=(Frontal&&) noexcept = default;

bool Frontal::factorise(const std::vector<double>& values, const Matrix& root,
                        const FrontalBorders& borders) {
  State& s = *state_;
  assert(values.size() == s.pattern.first_value.back());
  assert(root.rows() == s.pattern.root_count && root.cols() == s.pattern.root_count);
  s.regular = false;
  s.factors.clear();
  s.waiting_ids.clear();
  s.carried.clear();
  s.left_ids.clear();
  s.left_values.clear();
  s.left_sizes.clear();
  s.largest_front = 0;
  if (!s.start_borders(borders) || !root.allFinite()) return false;
  for (std::size_t f = 0; f < s.plans.fronts.size(); ++f) {
    s.assemble(f, values);
    const Index pivots = eliminate(s.front, s.borders, s.options);
    const Index waiting = s.front.candidates - pivots;
    if (waiting > s.options.many && !s.front_is_finite()) return false;  // no pivot among NaN
    keep(s.front, pivots, s.factors);
    add_to_corner(s.factors, f, s.borders);
    s.leave(f, pivots);
  }
  s.build_schur(root);
  for (const double entry : s.schur)
    if (!std::isfinite(entry)) return false;
  s.factorise_root();
  return true;
}

bool Frontal::set_borders(const FrontalBorders& borders) {
  State& s = *state_;
  if (!s.start_borders(borders)) return false;
  const Index width = 2 * s.borders.count;
  for (std::size_t f = 0; width > 0 && f < s.factors.fronts.size(); ++f) {
    forward(s.factors, f, s.borders.rows.data(), width, width);
    add_to_corner(s.factors, f, s.borders);
  }
  s.factorise_root();
  return true;
}

bool Frontal::solve(Matrix& X) { return state_->solve(X, false); }
bool Frontal::solve_transposed(Matrix& X) { return state_->solve(X, true); }

Inertia Frontal::inertia(double zero_tolerance) {
  State& s = *state_;
  Inertia inertia;
  const FrontFactors& factors = s.factors;
  for (std::size_t t = 0; t < factors.two.size(); ++t) {
    const double a = factors.D[2 * t];
    if (factors.two[t] == 0) {
      ++(a < 0 ? inertia.negative : inertia.positive);
      continue;
    }
    const double b = factors.D[2 * t + 1], c = factors.D[2 * t + 2];
    ++t;
    const bool one_of_each = (a / b) * (c / b) < 1;
    inertia.negative += one_of_each ? 1 : a < 0 ? 2 : 0;
    inertia.positive += one_of_each ? 1 : a < 0 ? 0 : 2;
  }
  const Index n = s.rest;
  double largest = 1;
  s.inertia_work.resize(s.schur.size());
  for (Index c = 0; c < n; ++c)
    for (Index r = 0; r < n; ++r) {
      const double entry = 0.5 * (s.schur[static_cast<std::size_t>(c * n + r)] +
                                  s.schur[static_cast<std::size_t>(r * n + c)]);
      s.inertia_work[static_cast<std::size_t>(c * n + r)] = entry;
      largest = std::max(largest, std::abs(entry));
    }
  const Inertia in_root = inertia_by_pivots(s.inertia_work, n, zero_tolerance * largest);
  inertia.negative += in_root.negative;
  inertia.zero += in_root.zero;
  inertia.positive += in_root.positive;
  return inertia;
}

const FrontalPattern& Frontal::pattern() const { return state_->pattern; }
Index Frontal::waiting() const { return state_->rest - state_->pattern.root_count; }
Index Frontal::largest_front() const { return state_->largest_front; }
double Frontal::border_growth() const { return state_->growth; }

Matrix product(const FrontalPattern& pattern, const std::vector<double>& values, const Matrix& root,
               const FrontalBorders& borders, const Matrix& X) {
  const Index n = pattern.size, k = borders.B.cols();
  assert(X.rows() == n + k);
  Matrix Y = Matrix::Zero(X.rows(), X.cols());
  for (std::size_t f = 0; f < pattern.front_count(); ++f) {
    const Index* ids = pattern.variables.data() + pattern.first_variable[f];
    const auto m = static_cast<Index>(pattern.first_variable[f + 1] - pattern.first_variable[f]);
    const Eigen::Map<const Matrix> element(values.data() + pattern.first_value[f], m, m);
    for (Index c = 0; c < m; ++c)
      for (Index r = c; r < m; ++r) {
        Y.row(ids[r]) += element(r, c) * X.row(ids[c]);
        if (r != c) Y.row(ids[c]) += element(r, c) * X.row(ids[r]);
      }
  }
  if (pattern.root_count > 0)
    Y.middleRows(pattern.root_first, pattern.root_count) +=
        root * X.middleRows(pattern.root_first, pattern.root_count);
  if (k == 0) return Y;
  Y.topRows(n) += borders.B * X.bottomRows(k);
  Y.bottomRows(k) = borders.C.transpose() * X.topRows(n) + borders.D * X.bottomRows(k);
  return Y;
}

}  // namespace springfold
