#include "springfold/core/sparse_matrices.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "elimination_order.hpp"
#include "springfold/core/scaling.hpp"

namespace springfold {
namespace {

/// Unknowns that are eliminated together: fewer are copied too often, more make the fronts wider.
constexpr std::size_t block = 12;

/// Borders that grow more in the elimination take part in it themselves.
constexpr double largest_growth = 1e4;

/// How often rows are brought to one size: each time their differences go with the square root.
constexpr int scalings = 3;

std::vector<std::vector<Index>> rows_of(Index size,
                                        const std::vector<std::vector<Index>>& couplings) {
  std::vector<std::vector<Index>> rows(static_cast<std::size_t>(size));
  for (const auto& members : couplings)
    for (const Index i : members) {
      auto& row = rows[static_cast<std::size_t>(i)];
      row.insert(row.end(), members.begin(), members.end());
    }
  for (auto& row : rows) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
  }
  return rows;
}

Graph without_diagonal(const std::vector<std::vector<Index>>& rows) {
  Graph graph = rows;
  for (std::size_t i = 0; i < graph.size(); ++i) std::erase(graph[i], static_cast<Index>(i));
  return graph;
}

}  // namespace

struct SparseLayout::State {
  Index size = 0, largest = 0;
  std::vector<std::vector<Index>> rows{};
  FrontalPattern pattern{};
  std::vector<Index> sources{};

  /// A front for every block of unknowns: these, and the later ones that they meet.
  void add_fronts() {
    const std::vector<Index> order = order_by_breadth(without_diagonal(rows));
    std::vector<std::size_t> place(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) place[static_cast<std::size_t>(order[k])] = k;
    pattern.size = pattern.root_first = size;
    std::vector<char> waits(order.size(),
                            0);  // met by one that is eliminated, and not yet so itself
    std::size_t held = 0;
    for (std::size_t first = 0; first < order.size(); first += block) {
      const std::size_t end = std::min(first + block, order.size());
      std::vector<Index> members(order.begin() + static_cast<std::ptrdiff_t>(first),
                                 order.begin() + static_cast<std::ptrdiff_t>(end));
      std::vector<Index> later;
      for (std::size_t k = first; k < end; ++k)
        for (const Index j : rows[static_cast<std::size_t>(order[k])])
          if (place[static_cast<std::size_t>(j)] >= end) later.push_back(j);
      std::sort(later.begin(), later.end(), [&place](Index a, Index b) {
        return place[static_cast<std::size_t>(a)] < place[static_cast<std::size_t>(b)];
      });
      later.erase(std::unique(later.begin(), later.end()), later.end());
      members.insert(members.end(), later.begin(), later.end());
      for (const Index i : members)
        if (!waits[static_cast<std::size_t>(i)]) {
          waits[static_cast<std::size_t>(i)] = 1;
          ++held;
        }
      largest = std::max(largest, static_cast<Index>(held));
      add_sources(members, end - first, place);
      add_front(pattern, members, end == order.size());
      held -= end - first;
    }
  }

  /// Columns of the unknowns that end here; all other entries stand in later fronts.
  void add_sources(const std::vector<Index>& members, std::size_t ending,
                   const std::vector<std::size_t>& place) {
    for (std::size_t c = 0; c < members.size(); ++c)
      for (const Index i : members) {
        const auto& row = rows[static_cast<std::size_t>(members[c])];
        const bool own =
            c < ending &&
            place[static_cast<std::size_t>(i)] >= place[static_cast<std::size_t>(members[c])] &&
            std::binary_search(row.begin(), row.end(), i);
        sources.push_back(own ? i + members[c] * size : -1);
      }
  }
};

SparseLayout::SparseLayout(Index size, const std::vector<std::vector<Index>>& couplings) {
  auto state = std::make_shared<State>();
  state->size = size;
  state->rows = rows_of(size, couplings);
  assert(std::none_of(state->rows.begin(), state->rows.end(),
                      [](const auto& row) { return row.empty(); }));
  state->add_fronts();
  state_ = std::move(state);
}

Index SparseLayout::size() const { return state_->size; }
Index SparseLayout::largest_front() const { return state_->largest; }
const FrontalPattern& SparseLayout::pattern() const { return state_->pattern; }
const std::vector<Index>& SparseLayout::sources() const { return state_->sources; }
const std::vector<std::vector<Index>>& SparseLayout::rows() const { return state_->rows; }

/// One matrix, and its factorisation once it is asked for.
struct SparseMatrices::Slot {
  explicit Slot(const SparseLayout& of) : layout{of}, frontal{of.pattern()} {}

  SparseLayout layout;
  std::vector<double> entries{};  ///< row by row, as the layout has them
  std::vector<double> values{};   ///< of the fronts, scaled
  Vector scale{};
  double largest = 0;
  Frontal frontal;
  FrontalBorders borders{}, given{};  ///< that it has now, scaled and as they were asked for
  bool factorised = false;

  void put(const Matrix& A);
  void put_scale();
  bool factorise(const FrontalBorders& wanted);
  bool take(const FrontalBorders& wanted);
  bool solve(const FrontalBorders& wanted, Matrix& X, bool transposed);
  std::optional<Inertia> inertia();
  void multiply(const Vector& v, Vector& result, bool sizes) const;
};

/// Powers of two that bring the largest entries of rows and columns near 1 (Ruiz 2001).
void SparseMatrices::Slot::put_scale() {
  const auto& rows = layout.rows();
  scale.setOnes(layout.size());
  Vector next = scale;
  for (int sweep = 0; sweep < scalings; ++sweep) {
    std::size_t k = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      double size = 0;
      const double own = scale[static_cast<Index>(i)];
      for (const Index j : rows[i]) size = std::max(size, std::abs(own * entries[k++] * scale[j]));
      next[static_cast<Index>(i)] = own / std::sqrt(size > 0 && std::isfinite(size) ? size : 1);
    }
    scale = next;
  }
  for (double& s : scale) s = power_of_two_near(s);
}

void SparseMatrices::Slot::put(const Matrix& A) {
  assert(A.rows() == layout.size() && A.cols() == layout.size());
  factorised = false;
  entries.clear();
  largest = 0;
  for (std::size_t i = 0; i < layout.rows().size(); ++i)
    for (const Index j : layout.rows()[i]) {
      entries.push_back(A(j, static_cast<Index>(i)));
      largest = std::max(largest, std::abs(entries.back()));
    }
  put_scale();
  const auto& sources = layout.sources();
  const Index n = layout.size();
  values.resize(sources.size());
  for (std::size_t k = 0; k < sources.size(); ++k) {
    const Index at = sources[k];
    values[k] = at < 0 ? 0 : scale[at % n] * A.data()[at] * scale[at / n];
  }
}

bool SparseMatrices::Slot::factorise(const FrontalBorders& wanted) {
  given = wanted;
  borders.B = scale.asDiagonal() * wanted.B;
  borders.C = scale.asDiagonal() * wanted.C;
  borders.D = wanted.D;
  return factorised = frontal.factorise(values, Matrix(0, 0), borders);
}

/// M for these borders; the factors of J stay where they are good enough for them.
bool SparseMatrices::Slot::take(const FrontalBorders& wanted) {
  if (!factorised) return factorise(wanted);
  if (given.B.cols() == wanted.B.cols() && given.B == wanted.B && given.C == wanted.C &&
      given.D == wanted.D)
    return true;
  given = wanted;
  borders.B = scale.asDiagonal() * wanted.B;
  borders.C = scale.asDiagonal() * wanted.C;
  borders.D = wanted.D;
  if (!frontal.set_borders(borders)) return factorised = false;
  return frontal.border_growth() <= largest_growth || factorise(wanted);
}

/// | J   B |   | S^-1   | | S J S      S B | | S^-1   |
/// | C^T D | = |      1 | | (S C)^T    D   | |      1 |
bool SparseMatrices::Slot::solve(const FrontalBorders& wanted, Matrix& X, bool transposed) {
  if (!take(wanted)) return false;
  const Index n = layout.size();
  X.topRows(n).array().colwise() *= scale.array();
  if (!(transposed ? frontal.solve_transposed(X) : frontal.solve(X))) return false;
  X.topRows(n).array().colwise() *= scale.array();
  return true;
}

std::optional<Inertia> SparseMatrices::Slot::inertia() {
  const Index n = layout.size();
  if (!factorised && !factorise({Matrix(n, 0), Matrix(n, 0), Matrix(0, 0)})) return std::nullopt;
  return frontal.inertia();
}

void SparseMatrices::Slot::multiply(const Vector& v, Vector& result, bool sizes) const {
  result.resize(layout.size());
  std::size_t k = 0;
  for (std::size_t i = 0; i < layout.rows().size(); ++i) {
    double sum = 0;
    for (const Index j : layout.rows()[i]) {
      const double term = entries[k++] * v[j];
      sum += sizes ? std::abs(term) : term;
    }
    result[static_cast<Index>(i)] = sum;
  }
}

SparseMatrices::SparseMatrices(SparseLayout layout) : layout_{std::move(layout)} {}

void SparseMatrices::take(const Matrix& A, StructuredMatrix& result) {
  result = {};  // what it held may be used again
  std::shared_ptr<Slot> free;
  for (const auto& slot : slots_)
    if (!free && slot.use_count() == 1) free = slot;
  if (!free) free = slots_.emplace_back(std::make_shared<Slot>(layout_));
  Slot* const slot = free.get();
  slot->put(A);
  result.largest = slot->largest;
  result.product = [slot](const Vector& v, Vector& Jv) { slot->multiply(v, Jv, false); };
  result.magnitudes = [slot](const Vector& v, Vector& sizes) { slot->multiply(v, sizes, true); };
  result.solve = [slot](const FrontalBorders& borders, Matrix& X, bool transposed) {
    return slot->solve(borders, X, transposed);
  };
  result.inertia = [slot] { return slot->inertia(); };
  result.owner = std::move(free);
}

}  // namespace springfold
