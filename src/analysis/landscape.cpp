#include "landscape.hpp"

#include <cmath>

#include "springfold/core/decompositions.hpp"

namespace springfold::analysis {
namespace {

/// Closures that hold to this are closed: the residual tolerance of equilibria, with room for rounding.
constexpr double closed = 1e-13;
/// Two states of one equilibrium, both polished to about 1e-12, are much nearer than this.
constexpr double near = 1e-7;

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

bool Landscape::close(Vector& x) const {
  if (multipliers_.empty()) return true;
  constexpr int rounds = 25;
  constexpr double longest = 0.5;
  const auto piece = piece_at(x);
  if (!piece) return false;
  Matrix A;
  Vector r, b;
  double last = std::numeric_limits<double>::infinity();
  for (int k = 0; k < rounds; ++k) {
    if (!terrain_.problem.residual(x, terrain_.lambda, *piece, r)) return false;
    const Vector gap = r(multipliers_);
    const double size = gap.lpNorm<Eigen::Infinity>();
    if (size <= closed * std::max(1.0, x(moving_).lpNorm<Eigen::Infinity>())) return true;
    // Rounding is reached where a small gap does not shrink any more.
    if (size < 1e3 * closed && size > last / 2) return true;
    last = size;
    if (!terrain_.problem.derivatives(x, terrain_.lambda, *piece, A, b)) return false;
    const Matrix J = A(multipliers_, moving_);
    Vector step = -least_squares(J, gap);
    const double length = step.lpNorm<Eigen::Infinity>();
    if (length > longest) step *= longest / length;
    x(moving_) += step;
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
    return terrain_.problem.residual(at.x, terrain_.lambda, piece, r) &&
           terrain_.problem.derivatives(at.x, terrain_.lambda, piece, A, b);
  };
  if (!evaluate()) return std::nullopt;
  at.gradient = r(moving_);
  at.closing = A(multipliers_, moving_);
  at.motions = kernel_of(at.closing);
  at.slope = at.motions.transpose() * at.gradient;
  if (!multipliers_.empty()) {
    const Matrix G = A(moving_, multipliers_);
    at.x(multipliers_) = -least_squares(G, at.gradient);
    if (!evaluate()) return std::nullopt;
  }
  const Matrix H = A(moving_, moving_);
  at.hessian = at.motions.transpose() * H * at.motions;
  at.hessian = (at.hessian + at.hessian.transpose()).eval() / 2;
  return at;
}

bool Landscape::same(const Vector& a, const Vector& b) const {
  if (terrain_.same) return terrain_.same(a, b);
  for (const Index i : moving_) {
    const double d = a[i] - b[i];
    if (std::abs(periods_[i] > 0 ? std::remainder(d, periods_[i]) : d) > near) return false;
  }
  return true;
}

std::optional<Vector> Landscape::moved(const Ground& at, const Vector& step) const {
  Vector x = at.x;
  x(moving_) += at.motions * step;
  if (!close(x)) return std::nullopt;
  return x;
}

Matrix Landscape::damping(const Ground& at) const {
  if (terrain_.damping.size() == 0) return Matrix::Identity(at.motions.cols(), at.motions.cols());
  return at.motions.transpose() * terrain_.damping * at.motions;
}

}  // namespace springfold::analysis
