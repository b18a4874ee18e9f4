#include "neutral_motions.hpp"

#include <algorithm>
#include <vector>

#include "springfold/continuation/newton.hpp"
#include "springfold/core/equilibration.hpp"

namespace springfold::analysis {
namespace {

using continuation::CurvePoint;
using continuation::Linearisation;

/// The point's own piece, and those beyond the surfaces that it lies on or stopped before.
std::vector<Piece> pieces_around(const PathProblem& problem, const CurvePoint& end) {
  constexpr double near = 1e-3;
  constexpr std::size_t most = 4;
  std::vector<Piece> pieces{end.piece};
  Vector g;
  if (problem.switch_count() == 0 || !problem.switches(end.x, end.lambda, g)) return pieces;
  std::vector<std::size_t> resting;
  for (Index j = 0; j < g.size(); ++j)
    if (std::abs(g[j]) <= near) resting.push_back(static_cast<std::size_t>(j));
  if (resting.size() > most) return pieces;
  for (std::size_t sides = 1; sides < (std::size_t{1} << resting.size()); ++sides) {
    Piece piece = end.piece;
    for (std::size_t k = 0; k < resting.size(); ++k)
      if ((sides >> k & 1U) != 0) piece[resting[k]] = static_cast<std::int8_t>(-piece[resting[k]]);
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

/// Does dF/dx v stay zero along v?
bool is_neutral(const PathProblem& problem, const CurvePoint& end, const Piece& piece,
                const Vector& v) {
  constexpr double way = 1e-2, zero = 1e-10;
  for (const double h : {0.0, -way, way}) {
    Linearisation at;
    if (!continuation::linearise(problem, end.x + h * v, end.lambda, piece, at) || at.structured)
      return false;
    const Vector left = at.dF_dx * v, sizes = at.dF_dx.cwiseAbs() * v.cwiseAbs();
    if (!(left.lpNorm<Eigen::Infinity>() <= zero * std::max(1.0, sizes.lpNorm<Eigen::Infinity>())))
      return false;
  }
  return true;
}

std::string moving_names(const PathProblem& problem, const CurvePoint& end, const Vector& v) {
  constexpr double visible = 0.3, step = 1e-6;
  constexpr std::size_t most = 4;
  const statics::System& system = problem.system(end.lambda);
  const Vector dz =
      problem.expand(end.x + step * v, end.lambda) - problem.expand(end.x - step * v, end.lambda);
  std::vector<Index> order;
  for (Index i = 0; i < system.size; ++i)
    if (!system.is_wrench[static_cast<std::size_t>(i)]) order.push_back(i);
  if (order.empty()) return "";
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    return std::abs(dz[a]) > std::abs(dz[b]) * (1 + 1e-9);
  });
  std::string names;
  for (std::size_t i = 0; i < std::min(most, order.size()); ++i) {
    if (std::abs(dz[order[i]]) < visible * std::abs(dz[order.front()])) break;
    names += (i == 0 ? "" : ", ") + system.coordinate_names[static_cast<std::size_t>(order[i])];
  }
  return names;
}

}  // namespace

std::optional<std::string> neutral_motion(const PathProblem& problem, const CurvePoint& end) {
  if (problem.structured()) return std::nullopt;
  for (const Piece& piece : pieces_around(problem, end)) {
    Linearisation at;
    if (!continuation::linearise(problem, end.x, end.lambda, piece, at) || at.structured) continue;
    const Vector units = equilibrate(at.dF_dx).columns;
    const Matrix N = null_directions(at.dF_dx);
    for (Index k = 0; k < N.cols(); ++k) {
      Vector v = units.cwiseProduct(N.col(k));
      const double size = v.lpNorm<Eigen::Infinity>();
      if (!(size > 0)) continue;
      v /= size;
      if (is_neutral(problem, end, piece, v)) return moving_names(problem, end, v);
    }
  }
  return std::nullopt;
}

}  // namespace springfold::analysis
