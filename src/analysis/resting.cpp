#include "resting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "springfold/continuation/newton.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/decompositions.hpp"
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

/// What no spring that rests is farther from its threshold than.
constexpr double zero_switch = continuation::promised_place;

/// What touches zero is farther from it where the place can be told from that of the touch.
constexpr double touched = continuation::told_apart * continuation::told_apart;

/// Switches at a point of the curve, their rates along it, and what rounding does to them.
struct SwitchPlaces {
  Vector g{}, rates{}, rounding{};
  bool is_zero(Index j) const { return std::abs(g[j]) <= rounding[j]; }
  /// Does it seem to stay zero as far as points of a curve need not be told apart?
  bool seems_to_stay(Index j) const {
    return std::abs(g[j] + continuation::told_apart * rates[j]) <= rounding[j];
  }
};

/// A corrected point is off by the last correction that is not made, and by what is left of the equations, terms that
/// round, times the inverse of the bordered matrix: beside a singular point that is as large as their distance is
/// small, across a stiff spring as small as the spring is stiff.
std::optional<SwitchPlaces> places_at(const PathProblem& problem,
                                      const continuation::CurvePoint& point) {
  SwitchPlaces at;
  Matrix dg;
  Vector dg_dlambda;
  continuation::Linearisation linear;
  if (!problem.switches(point.x, point.lambda, at.g) ||
      !problem.switch_gradients(point.x, point.lambda, dg, dg_dlambda) ||
      !continuation::linearise_densely(problem, point.x, point.lambda, point.piece, linear))
    return std::nullopt;
  const Index n = point.x.size();
  const bool has_tangent = point.tangent.dx.size() == n;
  Matrix bordered = Matrix::Zero(n + 1, n + 1), gradients(n + 1, at.g.size());
  bordered.topLeftCorner(n, n) = linear.dF_dx;
  bordered.topRightCorner(n, 1) = linear.dF_dlambda;
  bordered(n, n) = has_tangent ? point.tangent.dlambda : 1;
  if (has_tangent)
    bordered.bottomLeftCorner(1, n) = problem.metric().cwiseProduct(point.tangent.dx).transpose();
  gradients << dg.transpose(), dg_dlambda.transpose();
  const double terms = (linear.dF_dx.cwiseAbs() * point.x.cwiseAbs() +
                        std::abs(point.lambda) * linear.dF_dlambda.cwiseAbs())
                           .lpNorm<Eigen::Infinity>();
  const double size = std::max({1.0, point.x.lpNorm<Eigen::Infinity>(), std::abs(point.lambda)});
  const Matrix answers = Lu(bordered.transpose()).solve(gradients);
  at.rates = has_tangent ? Vector(dg * point.tangent.dx + point.tangent.dlambda * dg_dlambda)
                         : Vector(Vector::Zero(at.g.size()));
  at.rounding.resize(at.g.size());
  for (Index j = 0; j < at.g.size(); ++j) {
    const double own =
        continuation::refined_step * (size * gradients.col(j).lpNorm<1>() +
                                      std::max(1.0, terms) * answers.col(j).head(n).lpNorm<1>());
    at.rounding[j] = own < zero_switch ? own : zero_switch;
  }
  return at;
}

/// The point of the curve that is so far ahead that it can be told from this one. Beside a singular point the tangent
/// is as uncertain as the state: a state that is off by e, at a distance d from it, has a tangent that is off by e/d.
std::optional<SwitchPlaces> places_ahead(const PathProblem& problem,
                                         const continuation::CurvePoint& point) {
  const double ds = continuation::told_apart;
  const auto ahead = continuation::correct(
      problem, problem.metric(), point.x + ds * point.tangent.dx,
      point.lambda + ds * point.tangent.dlambda, point.piece, point.tangent, {});
  if (!converged(ahead)) return std::nullopt;
  continuation::CurvePoint there = point;
  there.x = ahead.x;
  there.lambda = ahead.lambda;
  return places_at(problem, there);
}

bool has_zero_switch(const PathProblem& problem, const continuation::CurvePoint& point) {
  Vector g;
  return problem.switch_count() > 0 && problem.switches(point.x, point.lambda, g) &&
         g.cwiseAbs().minCoeff() <= zero_switch;
}

}  // namespace

Switches resting_switches(const PathProblem& problem, const continuation::CurvePoint& point) {
  if (!has_zero_switch(problem, point)) return {};
  const auto here = places_at(problem, point);
  if (!here) return {};
  Switches list, moving;
  for (Index j = 0; j < here->g.size(); ++j)
    if (here->is_zero(j))
      (here->seems_to_stay(j) ? list : moving).push_back(static_cast<std::size_t>(j));
  if (moving.empty()) return list;
  if (const auto ahead = places_ahead(problem, point))
    for (const std::size_t j : moving)
      if (ahead->is_zero(static_cast<Index>(j))) list.push_back(j);
  std::sort(list.begin(), list.end());
  return list;
}

std::vector<KnownSwitches> known_switches(
    const PathProblem& problem, const std::vector<const continuation::CurvePoint*>& points) {
  std::vector<KnownSwitches> list(points.size());
  const auto is_near = [&](const auto* p) { return has_zero_switch(problem, *p); };
  if (points.empty() || !std::any_of(points.begin(), points.end(), is_near)) return list;
  // Beside the ends rounding may be that of a singular point.
  const double begin = points.front()->s + continuation::told_apart,
               end = points.back()->s - continuation::told_apart;
  const auto count = static_cast<std::size_t>(problem.switch_count());
  std::vector<bool> leaves(count, false), stays(count, false), only_touches(count, false);
  Vector g;
  for (const auto* point : points) {
    if (!problem.switches(point->x, point->lambda, g)) continue;
    if (point->s < begin || point->s > end) {
      for (std::size_t j = 0; j < count; ++j)
        if (std::abs(g[static_cast<Index>(j)]) > touched) only_touches[j] = true;
      continue;
    }
    const bool near = g.cwiseAbs().minCoeff() <= zero_switch;
    const auto at = near ? places_at(problem, *point) : std::nullopt;
    for (std::size_t j = 0; j < count; ++j) {
      const auto k = static_cast<Index>(j);
      if (std::abs(g[k]) > (at ? at->rounding[k] : zero_switch)) leaves[j] = true;
      if (at && at->is_zero(k) && at->seems_to_stay(k)) stays[j] = true;
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!problem.switches(points[i]->x, points[i]->lambda, g)) continue;
    for (std::size_t j = 0; j < count; ++j) {
      if (leaves[j] && std::abs(g[static_cast<Index>(j)]) <= zero_switch)
        list[i].leaving.push_back(j);
      if (stays[j] && !leaves[j] && !only_touches[j]) list[i].staying.push_back(j);
    }
  }
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
