#include "degenerate_state.hpp"

#include "null_modes.hpp"
#include "start.hpp"

namespace springfold::analysis {

bool is_degenerate(const PathProblem& problem, const continuation::CurvePoint& point) {
  if (!problem.symmetric()) return false;
  if (!point.negative) return true;
  const std::vector<Vector> weakest = null_modes(problem, point, 1);
  Vector at, beside;
  if (weakest.empty() || !problem.residual(point.x, point.lambda, point.piece, at)) return false;
  constexpr double farthest = 1e-3, nearest = 1e-12;  // of the mechanism's size
  const auto is_other = [&](double way) {
    continuation::CurvePoint moved = point;
    moved.x += way * weakest.front();
    if (!problem.residual(moved.x, point.lambda, point.piece, beside)) return false;
    if ((beside - at).norm() > tangent_rounding) return false;
    count_negative(problem, moved);
    return moved.negative != point.negative;
  };
  // A residual that grows with the way, or with a power of it: where it is one of rounding no other state is farther
  // away.
  for (double way = farthest; way > nearest; way /= 2)
    if (is_other(way) || is_other(-way)) return true;
  return false;
}

bool is_index_untold(const Evaluator& evaluator, const continuation::CurvePoint& point) {
  return !evaluator.resting_index_of(QuantityDefinition::Kind::index, point) &&
         is_degenerate(evaluator.problem(), point);
}

}  // namespace springfold::analysis
