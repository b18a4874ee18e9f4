#include "curve_chord.hpp"

#include <cmath>
#include <utility>

namespace springfold::analysis {
namespace {

using continuation::Direction;

/// Rounding of points: the direction of a chord so short says nothing.
constexpr double no_way = 1e-13;
/// Of the chord's length.
constexpr double farthest_aside = 0.5;

double size_of(const Vector& weights, const Direction& d) {
  return std::sqrt(continuation::metric_product(weights, d, d));
}

}  // namespace

CurveChord::CurveChord(const PathProblem& of, PathState begin, const PathState& end)
    : problem{of},
      from{std::move(begin)},
      weights{of.metric()},
      chord{end.x - from.x, end.lambda - from.lambda},
      length{size_of(weights, chord)} {
  border = {chord.dx / length, chord.dlambda / length};
}

bool CurveChord::is_a_way() const { return length > no_way; }

std::optional<PathState> CurveChord::at(double part, const Piece& piece) const {
  if (!(length > 0)) return std::nullopt;
  auto solved = continuation::correct(problem, weights, from.x + part * chord.dx,
                                      from.lambda + part * chord.dlambda, piece, border, {});
  if (!continuation::converged(solved) || !is_beside(solved.x, solved.lambda, part))
    return std::nullopt;
  return PathState{std::move(solved.x), solved.lambda};
}

bool CurveChord::is_beside(const Vector& x, double lambda, double part) const {
  const Direction aside{x - from.x - part * chord.dx, lambda - from.lambda - part * chord.dlambda};
  return size_of(weights, aside) <= farthest_aside * length;
}

}  // namespace springfold::analysis
