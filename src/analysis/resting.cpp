#include "resting.hpp"

#include <cmath>

namespace springfold::analysis {
namespace {

/// Numbers of the switches that rest.
std::vector<std::size_t> resting(const PathProblem& problem,
                                 const continuation::CurvePoint& point) {
  constexpr double at_zero = 1e-10, moving = 1e-8;
  Vector g;
  if (problem.switch_count() == 0 || !problem.switches(point.x, point.lambda, g)) return {};
  if (!(g.cwiseAbs().minCoeff() <= at_zero)) return {};
  Matrix dg;
  Vector dg_dlambda;
  const bool has_tangent = point.tangent.dx.size() == point.x.size();
  if (has_tangent && !problem.switch_gradients(point.x, point.lambda, dg, dg_dlambda)) return {};
  std::vector<std::size_t> list;
  for (Index j = 0; j < g.size(); ++j) {
    if (std::abs(g[j]) > at_zero) continue;
    const double rate =
        has_tangent ? dg.row(j).dot(point.tangent.dx) + dg_dlambda[j] * point.tangent.dlambda : 0;
    if (std::abs(rate) <= moving) list.push_back(static_cast<std::size_t>(j));
  }
  return list;
}

}  // namespace

std::vector<Piece> pieces_around(const PathProblem& problem,
                                 const continuation::CurvePoint& point) {
  constexpr std::size_t most = 6;
  const std::vector<std::size_t> list = resting(problem, point);
  if (list.empty() || list.size() > most) return {};
  std::vector<Piece> pieces;
  for (std::size_t sides = 0; sides < (std::size_t{1} << list.size()); ++sides) {
    Piece piece = point.piece;
    for (std::size_t k = 0; k < list.size(); ++k) piece[list[k]] = (sides >> k & 1) != 0 ? 1 : -1;
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

}  // namespace springfold::analysis
