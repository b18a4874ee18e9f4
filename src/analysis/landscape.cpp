#include "landscape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "closings.hpp"
#include "springfold/core/decompositions.hpp"

namespace springfold::analysis {
namespace {

/// Closures that hold to this are closed: the residual tolerance of equilibria, with room for rounding.
constexpr double closed = 1e-13;
/// Derivatives that left so little of a gap are good for the next correction, too: Newton's own would leave the square.
constexpr double little_left = 1e-2;
/// Two states of one equilibrium, both polished to about 1e-12, are much nearer than this.
constexpr double same_state = 1e-7;
/// A switch nearer to zero than this rests at its threshold: both are solved to about 1e-12. As for special points.
constexpr double at_threshold = 1e-10;
/// Where more springs rest at once, their pieces are too many to be looked at.
constexpr std::size_t most_resting = 6;

/// The rows and columns of a matrix: entry by entry, as Eigen copies lists of indices for every block that they name.
Matrix block_of(const Matrix& A, const std::vector<Index>& rows,
                const std::vector<Index>& columns) {
  Matrix block(static_cast<Index>(rows.size()), static_cast<Index>(columns.size()));
  for (std::size_t j = 0; j < columns.size(); ++j)
    for (std::size_t i = 0; i < rows.size(); ++i)
      block(static_cast<Index>(i), static_cast<Index>(j)) = A(rows[i], columns[j]);
  return block;
}

Vector entries_of(const Vector& v, const std::vector<Index>& list) {
  Vector entries(static_cast<Index>(list.size()));
  for (std::size_t i = 0; i < list.size(); ++i) entries[static_cast<Index>(i)] = v[list[i]];
  return entries;
}

void add_to_entries(Vector& v, const std::vector<Index>& list, const Vector& step) {
  for (std::size_t i = 0; i < list.size(); ++i) v[list[i]] += step[static_cast<Index>(i)];
}

/// The largest magnitude, 1 at least.
double size_of_entries(const Vector& v, const std::vector<Index>& list) {
  double size = 1;
  for (const Index i : list) size = std::max(size, std::abs(v[i]));
  return size;
}

}  // namespace

Landscape::Landscape(Terrain terrain) : terrain_{std::move(terrain)} {
  for (std::size_t i = 0; i < terrain_.is_multiplier.size(); ++i)
    (terrain_.is_multiplier[i] ? multipliers_ : moving_).push_back(static_cast<Index>(i));
  periods_ = terrain_.problem.periods();
}

std::optional<Piece> Landscape::piece_at(const Vector& x) const {
  Vector g;
  if (!terrain_.problem.switches(x, terrain_.lambda, g)) return std::nullopt;
  Piece piece(static_cast<std::size_t>(g.size()), std::int8_t{1});
  for (Index j = 0; j < g.size(); ++j)
    if (g[j] < 0) piece[static_cast<std::size_t>(j)] = -1;
  return piece;
}

std::vector<Piece> Landscape::pieces_beside(const Vector& x) const {
  Vector g;
  if (!terrain_.problem.switches(x, terrain_.lambda, g)) return {};
  Piece own(static_cast<std::size_t>(g.size()), std::int8_t{1});
  std::vector<std::size_t> resting;
  for (Index j = 0; j < g.size(); ++j) {
    if (g[j] < 0) own[static_cast<std::size_t>(j)] = -1;
    if (std::abs(g[j]) <= at_threshold) resting.push_back(static_cast<std::size_t>(j));
  }
  std::vector<Piece> pieces{own};
  if (resting.empty() || resting.size() > most_resting) return pieces;
  for (std::size_t sides = 0; sides < (std::size_t{1} << resting.size()); ++sides) {
    Piece piece = own;
    for (std::size_t k = 0; k < resting.size(); ++k)
      piece[resting[k]] = static_cast<std::int8_t>((sides >> k & 1U) != 0 ? 1 : -1);
    if (piece != own) pieces.push_back(std::move(piece));
  }
  return pieces;
}

/// Where closures depend on each other their residuals are gaps only without multipliers.
bool Landscape::close(Vector& x) const {
  if (multipliers_.empty()) return true;
  if (terrain_.redundant == 0) return close_gaps(x);
  const Vector multipliers = entries_of(x, multipliers_);
  x(multipliers_).setZero();
  const bool is_closed = close_gaps(x);
  x(multipliers_) = multipliers;
  return is_closed;
}

bool Landscape::close_gaps(Vector& x) const {
  constexpr int rounds = 25;
  constexpr double longest = 0.5;
  const auto piece = piece_at(x);
  if (!piece) return false;
  Matrix A;
  Vector r, b;
  Closings closings;
  bool known = false;  // they are good for further corrections
  double last = std::numeric_limits<double>::infinity();
  for (int k = 0; k < rounds; ++k) {
    const bool first = k == 0;  // seldom closed: both at once are cheaper than one after the other
    if (!(first ? terrain_.problem.equations(x, terrain_.lambda, *piece, r, A, b)
                : terrain_.problem.residual(x, terrain_.lambda, *piece, r)))
      return false;
    const Vector gap = entries_of(r, multipliers_);
    const double size = gap.lpNorm<Eigen::Infinity>();
    if (size <= closed * size_of_entries(x, moving_)) return true;
    // Rounding is reached where a small gap does not shrink any more.
    if (size < 1e3 * closed && size > last / 2) return true;
    const bool again = known && size <= little_left * last;
    last = size;
    if (!again) {
      if (!first && !terrain_.problem.derivatives(x, terrain_.lambda, *piece, A, b)) return false;
      closings.compute(block_of(A, multipliers_, moving_), terrain_.redundant);
      known = closings.independent();
    }
    Vector step = -closings.least_norm(gap);
    const double length = step.lpNorm<Eigen::Infinity>();
    if (length > longest) step *= longest / length;
    add_to_entries(x, moving_, step);
  }
  return false;
}

std::optional<Ground> Landscape::ground(const Vector& x) const {
  const auto piece = piece_at(x);
  return piece ? ground_on(x, *piece) : std::nullopt;
}

std::optional<Ground> Landscape::ground_on(const Vector& x, const Piece& piece) const {
  Ground at;
  at.piece = piece;
  at.x = x;
  at.x(multipliers_).setZero();
  Matrix A;
  Vector r, b;
  const auto evaluate = [&] {
    return terrain_.problem.equations(at.x, terrain_.lambda, piece, r, A, b);
  };
  if (!evaluate()) return std::nullopt;
  at.gradient = entries_of(r, moving_);
  at.closing = block_of(A, multipliers_, moving_);
  const Closings closings(at.closing, terrain_.redundant);
  at.motions = closings.motions();
  at.slope = at.motions.transpose() * at.gradient;
  if (!multipliers_.empty()) {
    at.x(multipliers_) = -closings.multipliers(at.gradient);
    if (!evaluate()) return std::nullopt;
  }
  const Matrix H = block_of(A, moving_, moving_);
  at.hessian = at.motions.transpose() * H * at.motions;
  at.hessian = (at.hessian + at.hessian.transpose()).eval() / 2;
  return at;
}

std::optional<Ground> Landscape::softest_ground(const Vector& x) const {
  std::optional<Ground> softest;
  double least = std::numeric_limits<double>::infinity();
  for (const Piece& piece : pieces_beside(x)) {
    auto at = ground_on(x, piece);
    if (!at) continue;
    const double stiffness = at->hessian.size() > 0 ? symmetric_eigenvalues(at->hessian)[0] : least;
    // Pieces that differ by rounding are alike: the first one stands.
    if (softest && !(stiffness < least - at_threshold * std::max(1.0, std::abs(least)))) continue;
    least = stiffness;
    softest = std::move(at);
  }
  return softest;
}

bool Landscape::same(const Vector& a, const Vector& b) const {
  if (terrain_.same) return terrain_.same(a, b);
  for (const Index i : moving_) {
    const double d = a[i] - b[i];
    if (std::abs(periods_[i] > 0 ? std::remainder(d, periods_[i]) : d) > same_state) return false;
  }
  return true;
}

std::optional<Vector> Landscape::moved(const Ground& at, const Vector& step) const {
  Vector x = at.x;
  add_to_entries(x, moving_, at.motions * step);
  if (!close(x)) return std::nullopt;
  return x;
}

Matrix Landscape::damping(const Ground& at) const {
  if (terrain_.damping.size() == 0) return Matrix::Identity(at.motions.cols(), at.motions.cols());
  return at.motions.transpose() * terrain_.damping * at.motions;
}

}  // namespace springfold::analysis
