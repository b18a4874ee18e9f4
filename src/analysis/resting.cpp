#include "resting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "springfold/continuation/newton.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/inertia.hpp"

namespace springfold::analysis {
namespace {

/// Compliance of the springs' directions in a piece that is regular.
struct Base {
  Matrix G{};
  Index negative = 0;
  Piece piece{};
};

Piece with_sides(Piece piece, const std::vector<std::size_t>& resting, std::size_t sides) {
  for (std::size_t k = 0; k < resting.size(); ++k)
    piece[resting[k]] = (sides >> k & 1) != 0 ? 1 : -1;
  return piece;
}

std::optional<Base> base_of(const Matrix& M, const Matrix& E, Piece piece) {
  const auto solution = solve_and_count(M, E);
  if (!solution || solution->inertia.zero > 0 || !solution->X.allFinite()) return std::nullopt;
  const Matrix G = E.transpose() * solution->X;
  return Base{0.5 * (G + G.transpose()), solution->inertia.negative, std::move(piece)};
}

/// The first piece that is regular, the given one first.
std::optional<Base> regular_piece(const MatrixOfPiece& matrix, const Piece& piece,
                                  const std::vector<std::size_t>& resting, const Matrix& E) {
  const std::size_t all = std::size_t{1} << resting.size();
  for (std::size_t sides = 0; sides <= all; ++sides) {
    const Piece tried = sides == 0 ? piece : with_sides(piece, resting, all - sides);
    const auto M = matrix(tried);
    if (!M) return std::nullopt;
    if (auto base = base_of(*M, E, tried)) return base;
  }
  return std::nullopt;
}

/// What a spring's stiffness gains where it begins to act: the matrix gains jump e e^T.
std::optional<Vector> jumps_of(const MatrixOfPiece& matrix, const Piece& piece,
                               const std::vector<std::size_t>& resting, const Matrix& E) {
  Vector jumps(static_cast<Index>(resting.size()));
  const Piece none = with_sides(piece, resting, 0);
  const auto M = matrix(none);
  for (std::size_t k = 0; M && k < resting.size(); ++k) {
    Piece one = none;
    one[resting[k]] = 1;
    const auto N = matrix(one);
    if (!N) return std::nullopt;
    const auto j = static_cast<Index>(k);
    const double square = E.col(j).squaredNorm();
    jumps[j] = E.col(j).dot((*N - *M) * E.col(j)) / (square * square);
  }
  return M ? std::optional<Vector>(jumps) : std::nullopt;
}

/// What switches that are zero within rounding are within, and rates that are none.
constexpr double zero_switch = continuation::promised_place,
                 zero_switch_rate = continuation::flat_rate;

/// The switches at the point of the curve that is so far ahead that it can be told from this one. Beside a singular point the
/// tangent is as uncertain as the state: a state that is off by e, at a distance d from it, has a tangent that is off by e/d.
std::optional<Vector> switches_ahead(const PathProblem& problem,
                                     const continuation::CurvePoint& point) {
  const double ds = continuation::told_apart;
  const auto ahead = continuation::correct(
      problem, problem.metric(), point.x + ds * point.tangent.dx,
      point.lambda + ds * point.tangent.dlambda, point.piece, point.tangent, {});
  Vector g;
  if (!converged(ahead) || !problem.switches(ahead.x, ahead.lambda, g)) return std::nullopt;
  return g;
}

}  // namespace

std::vector<std::size_t> resting_switches(const PathProblem& problem,
                                          const continuation::CurvePoint& point) {
  Vector g;
  if (problem.switch_count() == 0 || !problem.switches(point.x, point.lambda, g)) return {};
  if (!(g.cwiseAbs().minCoeff() <= zero_switch)) return {};
  Matrix dg;
  Vector dg_dlambda;
  const bool has_tangent = point.tangent.dx.size() == point.x.size();
  if (has_tangent && !problem.switch_gradients(point.x, point.lambda, dg, dg_dlambda)) return {};
  std::vector<std::size_t> list, moving;
  for (Index j = 0; j < g.size(); ++j) {
    if (std::abs(g[j]) > zero_switch) continue;
    const double rate =
        has_tangent ? dg.row(j).dot(point.tangent.dx) + dg_dlambda[j] * point.tangent.dlambda : 0;
    (std::abs(rate) <= zero_switch_rate ? list : moving).push_back(static_cast<std::size_t>(j));
  }
  if (moving.empty()) return list;
  if (const auto ahead = switches_ahead(problem, point))
    for (const std::size_t j : moving) {
      const auto i = static_cast<Index>(j);
      if (std::abs((*ahead)[i] - g[i]) <= zero_switch_rate * continuation::told_apart)
        list.push_back(j);
    }
  std::sort(list.begin(), list.end());
  return list;
}

std::vector<Piece> pieces_around(const Piece& piece, const std::vector<std::size_t>& resting) {
  constexpr std::size_t most = 6;
  if (resting.empty() || resting.size() > most) return {};
  std::vector<Piece> pieces;
  for (std::size_t sides = 0; sides < (std::size_t{1} << resting.size()); ++sides)
    pieces.push_back(with_sides(piece, resting, sides));
  return pieces;
}

double RestingIndex::index() const {
  switch (verdict) {
    case Definiteness::positive:
      return 0;
    case Definiteness::not_positive:
      return static_cast<double>(std::max<Index>(1, fewest));
    case Definiteness::undecided:
      break;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::optional<RestingIndex> resting_index(const MatrixOfPiece& matrix, const Piece& piece,
                                          const std::vector<std::size_t>& resting,
                                          const Matrix& directions, Index closures) {
  const auto k = static_cast<Index>(resting.size());
  if (k == 0 || k > most_cones) return std::nullopt;
  const auto base = regular_piece(matrix, piece, resting, directions);
  if (!base) return std::nullopt;
  const auto jumps = jumps_of(matrix, piece, resting, directions);
  if (!jumps) return std::nullopt;
  Vector sides(k);
  for (Index j = 0; j < k; ++j) sides[j] = base->piece[resting[static_cast<std::size_t>(j)]];
  const auto condensed = condensed_form(base->G, base->negative, *jumps, sides);
  if (!condensed || condensed->across < closures) return std::nullopt;
  const FormJudgement judged = judge(condensed->form);
  const Index across = condensed->across - closures;
  return RestingIndex{across > 0 ? Definiteness::not_positive : judged.verdict,
                      across + judged.fewest, across + judged.most};
}

}  // namespace springfold::analysis
